#include "simulator/integrate/bridge.h"

#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace plumbline::integrate {

namespace {

Eigen::Map<Eigen::VectorXd> map(N_Vector v) {
  return {NV_DATA_S(v), static_cast<Eigen::Index>(NV_LENGTH_S(v))};
}

bool same(const double* a, const Eigen::VectorXd& b) {
  return std::memcmp(a, b.data(), static_cast<std::size_t>(b.size()) * sizeof(double)) == 0;
}

}  // namespace

// A rate that is not finite makes the Newton iterations try a smaller step. The explicit method cannot
// recover from a failed stage, but the error estimate of the step is then not finite either, and rejects the
// step.
Bridge::Bridge(Ode& ode, Method method)
    : ode_(ode),
      remember_rate_(method != Method::bdf),
      not_finite_code_(method == Method::explicit_rk ? 0 : 1),
      last_x_(Eigen::VectorXd::Zero(ode.size())),
      last_xdot_(last_x_),
      reach_(last_x_) {
  message_.reserve(512);
}

void Bridge::evaluate(double t, const double* x, double* xdot) {
  const Eigen::Index n = last_x_.size();
  if (remembered_ && t == last_t_ && same(x, last_x_)) {
    Eigen::Map<Eigen::VectorXd>(xdot, n) = last_xdot_;
    return;
  }
  ode_.rate(t, x, xdot);
  ++rate_evaluations;
  if (!remember_rate_) return;
  last_t_ = t;
  last_x_ = Eigen::Map<const Eigen::VectorXd>(x, n);
  last_xdot_ = Eigen::Map<const Eigen::VectorXd>(xdot, n);
  remembered_ = true;
}

void Bridge::rate_at(double t, const Eigen::VectorXd& x, Eigen::VectorXd& xdot) {
  evaluate(t, x.data(), xdot.data());
}

int Bridge::rate(realtype t, N_Vector x, N_Vector xdot, void* self) {
  auto& bridge = *static_cast<Bridge*>(self);
  try {
    bridge.evaluate(t, NV_DATA_S(x), NV_DATA_S(xdot));
    if (map(xdot).allFinite()) return 0;
    bridge.not_finite_ = true;
    return bridge.not_finite_code_;
  } catch (...) {
    bridge.thrown_ = std::current_exception();
    return -1;
  }
}

int Bridge::jacobian(realtype t, N_Vector x, N_Vector /*xdot*/, SUNMatrix J, void* self, N_Vector /*unused*/,
                     N_Vector /*unused*/, N_Vector /*unused*/) {
  auto& bridge = *static_cast<Bridge*>(self);
  const auto n = static_cast<Eigen::Index>(NV_LENGTH_S(x));
  try {
    bridge.ode_.jacobian(t, NV_DATA_S(x), Eigen::Map<Eigen::MatrixXd>(SM_DATA_D(J), n, n));
    ++bridge.jacobian_evaluations;
    return 0;
  } catch (...) {
    bridge.thrown_ = std::current_exception();
    return -1;
  }
}

int Bridge::switches(realtype t, N_Vector x, realtype* g, void* self) {
  auto& bridge = *static_cast<Bridge*>(self);
  try {
    bridge.ode_.switches(t, NV_DATA_S(x), g);
    return 0;
  } catch (...) {
    bridge.thrown_ = std::current_exception();
    return -1;
  }
}

int Bridge::project_state(realtype t, N_Vector x, void* self) {
  auto& bridge = *static_cast<Bridge*>(self);
  try {
    bridge.largest_projection = std::max(bridge.largest_projection, bridge.ode_.project(t, NV_DATA_S(x)));
    return 0;
  } catch (...) {
    bridge.thrown_ = std::current_exception();
    return -1;
  }
}

int Bridge::project_correction(realtype t, N_Vector x, N_Vector correction, realtype /*epsilon*/,
                               N_Vector /*error*/, void* self) {
  auto moved = map(correction);
  moved = map(x);
  const int flag = project_state(t, correction, self);
  moved -= map(x);
  return flag;
}

int Bridge::weights(N_Vector x, N_Vector weight, void* self) {
  auto& bridge = *static_cast<Bridge*>(self);
  try {
    bridge.ode_.reach(NV_DATA_S(x), bridge.reach_.data());
    map(weight) = (bridge.relative_ * bridge.reach_ + bridge.absolute_).cwiseInverse();
    return 0;
  } catch (...) {
    bridge.thrown_ = std::current_exception();
    return -1;
  }
}

void Bridge::message(int /*code*/, const char* /*module*/, const char* /*function*/, char* text, void* self) {
  static_cast<Bridge*>(self)->message_ = text;
}

void Bridge::forget() { remembered_ = false; }

void Bridge::reset() {
  forget();
  not_finite_ = false;
  thrown_ = nullptr;
  message_.clear();
  reach_.setZero();
  rate_evaluations = 0;
  jacobian_evaluations = 0;
  largest_projection = 0.0;
}

std::string Bridge::reason(const std::string& flag) const {
  std::string text = message_.empty() ? flag : flag + ": " + message_;
  if (not_finite_) text += " Some rates were not finite.";
  return text;
}

void Bridge::fail(const std::string& method, double t, const Eigen::VectorXd& x, const std::string& reason) {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  std::ostringstream text;
  text.precision(12);
  text << method << " failed after t = " << t << " s: " << reason;
  const std::string stiffest = x.allFinite() ? ode_.stiffest(t, x.data()) : "";
  if (!stiffest.empty()) text << " Stiffest: " << stiffest << '.';
  throw std::runtime_error(text.str());
}

}  // namespace plumbline::integrate
