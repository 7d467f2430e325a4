#include "simulator/integrate/switch_search.h"

#include <algorithm>
#include <utility>

namespace plumbline::integrate {

namespace {
bool changes_sign(double before, double after) { return before != 0.0 && before * after <= 0.0; }
}  // namespace

bool any_changes_sign(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    if (changes_sign(before[i], after[i])) return true;
  }
  return false;
}

SwitchBracket::SwitchBracket(double lo, Eigen::VectorXd g_lo, double hi, Eigen::VectorXd g_hi)
    : lo_(lo), hi_(hi), g_lo_(std::move(g_lo)), g_hi_(std::move(g_hi)) {}

double SwitchBracket::guess() const {
  double first = 1.0;
  for (Eigen::Index i = 0; i < g_hi_.size(); ++i) {
    if (!changes_sign(g_lo_[i], g_hi_[i])) continue;
    const double a = weight_lo_ * g_lo_[i];
    const double b = weight_hi_ * g_hi_[i];
    first = std::min(first, a / (a - b));
  }
  // Away from the ends, where nothing would be learned; rounding may lead there in a narrow bracket.
  const double t = lo_ + std::clamp(first, 1e-3, 1.0 - 1e-3) * width();
  return t > lo_ && t < hi_ ? t : lo_ + 0.5 * width();
}

void SwitchBracket::narrow(double t, const Eigen::VectorXd& g) {
  if (any_changes_sign(g_lo_, g)) {
    hi_ = t;
    g_hi_ = g;
    weight_hi_ = 1.0;
    weight_lo_ *= 0.5;
  } else {
    lo_ = t;
    g_lo_ = g;
    weight_lo_ = 1.0;
    weight_hi_ *= 0.5;
  }
}

void SwitchBracket::directions(std::vector<int>& direction) const {
  for (Eigen::Index i = 0; i < g_hi_.size(); ++i) {
    const bool changed = changes_sign(g_lo_[i], g_hi_[i]);
    direction[static_cast<std::size_t>(i)] = !changed ? 0 : g_lo_[i] < 0.0 ? 1 : -1;
  }
}

CubicHermite::CubicHermite(double t0, const Eigen::VectorXd& x0, const Eigen::VectorXd& f0, double t1,
                           const Eigen::VectorXd& x1, const Eigen::VectorXd& f1)
    : t0_(t0), h_(t1 - t0), x0_(x0), f0_(f0), x1_(x1), f1_(f1) {}

void CubicHermite::at(double t, Eigen::VectorXd& x) const {
  const double s = (t - t0_) / h_;
  const double r = 1.0 - s;
  x = r * r * (1.0 + 2.0 * s) * x0_ + s * s * (3.0 - 2.0 * s) * x1_ + h_ * s * r * (r * f0_ - s * f1_);
}

}  // namespace plumbline::integrate
