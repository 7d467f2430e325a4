// Where several switching functions first change sign between two times.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumbline::integrate {

/// Does a function change its sign between two times? Zero before: it has none to change; zero after: it
/// does.
bool any_changes_sign(const Eigen::VectorXd& before, const Eigen::VectorXd& after);

/// A bracket around the first sign change: at lo no function has changed its sign, at hi at least one has.
class SwitchBracket {
 public:
  SwitchBracket(double lo, Eigen::VectorXd g_lo, double hi, Eigen::VectorXd g_hi);

  /// A guess strictly inside: regula falsi with halved weights (Illinois; M. Dowell and P. Jarratt, BIT 11
  /// (1971) 168), for the function that would be the first to cross.
  double guess() const;
  /// The functions' values at t inside the bracket: moves lo or hi there.
  void narrow(double t, const Eigen::VectorXd& g);
  /// +1 rises, -1 falls, 0 does not change between lo and hi.
  void directions(std::vector<int>& direction) const;

  double lo() const { return lo_; }
  double hi() const { return hi_; }
  double width() const { return hi_ - lo_; }

 private:
  double lo_, hi_;
  Eigen::VectorXd g_lo_, g_hi_;
  double weight_lo_ = 1.0, weight_hi_ = 1.0;
};

/// Cubic Hermite interpolation of x from its values and rates at both ends; error O((t1 - t0)^4).
class CubicHermite {
 public:
  CubicHermite(double t0, const Eigen::VectorXd& x0, const Eigen::VectorXd& f0, double t1,
               const Eigen::VectorXd& x1, const Eigen::VectorXd& f1);
  void at(double t, Eigen::VectorXd& x) const;

 private:
  double t0_, h_;
  const Eigen::VectorXd &x0_, &f0_, &x1_, &f1_;
};

}  // namespace plumbline::integrate
