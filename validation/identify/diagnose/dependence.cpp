#include "validation/identify/diagnose/dependence.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::validation {
namespace {

constexpr Eigen::Index kBins = 12;
constexpr int kMostRepeats = 60;

double variance_sum(const Eigen::VectorXd& y) { return (y.array() - y.mean()).square().sum(); }

Dependence depend(const std::string& variable, const std::string& unit, const Eigen::VectorXd& x,
                  const Eigen::VectorXd& y, Eigen::Index bins) {
  Dependence dependence;
  dependence.variable = variable;
  dependence.unit = unit;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return x[a] < x[b]; });
  const double mean = y.mean();
  double between = 0.0;
  for (Eigen::Index b = 0; b < bins; ++b) {
    const Eigen::Index from = x.size() * b / bins;
    const Eigen::Index to = x.size() * (b + 1) / bins;
    double sx = 0.0;
    double sy = 0.0;
    for (Eigen::Index i = from; i < to; ++i) {
      sx += x[order[static_cast<std::size_t>(i)]];
      sy += y[order[static_cast<std::size_t>(i)]];
    }
    const auto n = static_cast<double>(std::max<Eigen::Index>(1, to - from));
    dependence.center.push_back(sx / n);
    dependence.mean.push_back(sy / n);
    between += n * (sy / n - mean) * (sy / n - mean);
  }
  const double total = variance_sum(y);
  dependence.share = total > 0.0 ? between / total : 0.0;
  return dependence;
}

/// Share of y's variance that a cos(n x) + b sin(n x) + c explains, by least squares.
double harmonic_share(const Eigen::VectorXd& x, const Eigen::VectorXd& y, int n) {
  Eigen::MatrixXd columns(x.size(), 3);
  columns.col(0) = (n * x.array()).cos();
  columns.col(1) = (n * x.array()).sin();
  columns.col(2).setOnes();
  const Eigen::Matrix3d H = columns.transpose() * columns;
  const Eigen::Vector3d fit = H.completeOrthogonalDecomposition().solve(columns.transpose() * y);
  const double total = variance_sum(y);
  return total > 0.0 ? 1.0 - (y - columns * fit).squaredNorm() / total : 0.0;
}

/// Against the angle within a turn, drawn finely enough for many repeats. A motion over less than a turn of a
/// harmonic cannot tell it from a slope, so that such harmonics are left out.
Dependence depend_on_turn(const ForceSamples& s) {
  const double turn = 2.0 * std::acos(-1.0);
  const Eigen::VectorXd angle =
      s.position.unaryExpr([&](double q) { return q - turn * std::floor(q / turn); });
  Dependence dependence = depend("motor angle", "rad", angle, s.force, 4 * kBins);
  dependence.share = 0.0;
  const double range = s.position.maxCoeff() - s.position.minCoeff();
  for (int n = 1; n <= kMostRepeats; ++n) {
    const double share = n * range > 2.0 * turn ? harmonic_share(s.position, s.force, n) : 0.0;
    if (share > dependence.share) {
      dependence.share = share;
      dependence.repeats = n;
    }
  }
  return dependence;
}

Dependence of_size(Dependence dependence) {
  dependence.of_size = true;
  return dependence;
}

std::string size_in_words(const Dependence& d, const std::string& whose) {
  constexpr double kOnly = 5.0;
  const double first = d.mean.front();
  const double last = d.mean.back();
  const bool rises = last > first;
  if (d.variable == "time") {
    return rises ? "grows over the trial" : "fades over the trial";
  }
  if (d.variable == "load") {
    return last > kOnly * first ? "is there only under load"
           : rises              ? "grows with the load"
                                : "is largest without load";
  }
  if (d.variable == "velocity") {
    return (last > kOnly * first ? "is there only in motion"
            : rises              ? "grows with the speed"
                                 : "is largest at rest") +
           whose;
  }
  return d.variable == "stance" ? "is stronger in some parts of the stance than in others"
                                : "is stronger at some positions" + whose + " than at others";
}

}  // namespace

std::vector<Dependence> dependences_of(const ForceSamples& s) {
  const std::string x = s.angular ? "rad" : "m";
  const Eigen::VectorXd size = (s.force.array() - s.force.mean()).abs();
  std::vector<Dependence> all{depend("position", x, s.position, s.force, kBins),
                              depend("velocity", x + "/s", s.velocity, s.force, kBins),
                              depend("direction", "1", s.velocity.array().sign().matrix(), s.force, 2),
                              depend("load", s.force_unit, s.load, s.force, kBins),
                              depend("time", "s", s.time, s.force, kBins),
                              of_size(depend("position", x, s.position, size, kBins)),
                              of_size(depend("velocity", x + "/s", s.velocity.cwiseAbs(), size, kBins)),
                              of_size(depend("load", s.force_unit, s.load.cwiseAbs(), size, kBins)),
                              of_size(depend("time", "s", s.time, size, kBins))};
  if (s.angular && s.of.empty()) {
    all.push_back(depend_on_turn(s));
  }
  if (s.stance.size() > 0) {
    all.push_back(depend("stance", "1", s.stance, s.force, kBins));
    all.push_back(of_size(depend("stance", "1", s.stance, size, kBins)));
  }
  // A force that follows the variable itself also changes its size with it: that is the lesser statement. And
  // what two bins say as well as twelve is said by two.
  const auto weight = [](const Dependence& d) {
    return d.of_size ? 0.5 * d.share : d.variable == "direction" ? 1.05 * d.share : d.share;
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Dependence& a, const Dependence& b) { return weight(a) > weight(b); });
  return all;
}

std::string in_words(const std::vector<Dependence>& strongest_first, const std::string& of) {
  const Dependence& d = strongest_first.front();
  const std::string whose = of.empty() ? "" : " of " + of;
  if (d.share < 0.1) {
    return of.empty() ? "follows none of position, velocity, load, time and motor angle"
                      : "follows none of position and velocity" + whose + ", load, time and stance";
  }
  if (d.of_size) {
    return size_in_words(d, whose);
  }
  if (d.variable == "time") {
    return d.mean.back() > d.mean.front() ? "rises over the trial" : "falls over the trial";
  }
  if (d.variable == "motor angle") {
    return "repeats " + std::to_string(d.repeats) + " times in a turn of the motor";
  }
  if (d.variable == "stance") {
    return "depends on the phase of the stance";
  }
  const bool moves = d.variable == "position" || d.variable == "velocity";
  return d.variable == "direction" ? "depends on the direction of motion" + whose
                                   : "depends on the " + d.variable + (moves ? whose : "");
}

}  // namespace plumbline::validation
