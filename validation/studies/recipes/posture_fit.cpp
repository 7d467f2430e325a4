#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>

#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/fit/fit.h"
#include "validation/studies/recipes/information.h"
#include "validation/studies/recipes/linked.h"
#include "validation/studies/recipes/methods.h"

namespace plumbline::validation {
namespace {

constexpr double kHandStep = 1e-3;  // of the balanced coordinate, for the readings' slope
constexpr double kPostureSettled =
    1e-5;  // step in units of the parameters; equilibria are exact to about 1e-8

/// All postures of one fit: predictions for any parameters, and residuals with unit covariance.
class PostureProblem {
 public:
  PostureProblem(const model::Model& model, const Postures& postures, const PostureReadings& readings,
                 const std::vector<FreeParameter>& parameters)
      : model_(model), postures_(postures), readings_(readings), parameters_(parameters) {
    for (std::size_t s = 0; s < model.sensors.size(); ++s) {
      const auto& locked = postures.locked;
      if (std::find(locked.begin(), locked.end(), model.sensors[s].measures) == locked.end()) {
        watched_.push_back(static_cast<Eigen::Index>(s));
      }
    }
    for (Eigen::Index i = 0; i < readings.sensors.cols(); ++i) {
      const std::vector<double> held = held_by_readings(model, postures, readings.sensors.col(i));
      all_.push_back(
          std::make_unique<Posture>(model_, postures_, postures_.poses[static_cast<std::size_t>(i)], held));
      whiteners_.push_back(covariance(*all_.back()).llt());
    }
  }

  Eigen::Index poses() const { return readings_.sensors.cols(); }

  /// Measured minus predicted in standard deviations, pose by pose; the scale last.
  Eigen::VectorXd residual(const Eigen::VectorXd& theta) {
    const auto n = static_cast<Eigen::Index>(watched_.size());
    const bool scale = readings_.weight.size() > 0;
    Eigen::VectorXd r(poses() * n + (scale ? 1 : 0));
    for (Eigen::Index i = 0; i < poses(); ++i) {
      Posture& posture = *all_[static_cast<std::size_t>(i)];
      set(posture.plant(), theta);
      const Eigen::VectorXd off = watched(readings_.sensors.col(i) - posture.readings());
      r.segment(i * n, n) = whiteners_[static_cast<std::size_t>(i)].matrixL().solve(off);
    }
    if (scale) {  // one robot on one scale: the same rounding every time
      const double floor = postures_.scale_resolution / std::sqrt(12.0);
      r[r.size() - 1] =
          (readings_.weight.mean() - total_weight(with_values(model_, parameters_, theta))) / floor;
    }
    return r;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta, const Eigen::VectorXd& r) {
    Eigen::MatrixXd J(r.size(), theta.size());
    for (Eigen::Index p = 0; p < theta.size(); ++p) {
      const double typical = parameters_[static_cast<std::size_t>(p)].typical;
      const double step = 1e-4 * typical;
      Eigen::VectorXd moved = theta;
      moved[p] += step;
      J.col(p) = (residual(moved) - r) / step;
    }
    return J;
  }

 private:
  void set(model::Plant& plant, const Eigen::VectorXd& theta) const {
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      parameters_[p].set(plant, theta[static_cast<Eigen::Index>(p)]);
    }
  }

  Eigen::VectorXd watched(const Eigen::VectorXd& all) const {
    Eigen::VectorXd some(static_cast<Eigen::Index>(watched_.size()));
    for (std::size_t k = 0; k < watched_.size(); ++k) {
      some[static_cast<Eigen::Index>(k)] = all[watched_[k]];
    }
    return some;
  }

  /// Of the watched readings: each sensor's floor, and the hand's error, which moves them together.
  Eigen::MatrixXd covariance(Posture& posture) const {
    Eigen::VectorXd floors(static_cast<Eigen::Index>(watched_.size()));
    for (std::size_t k = 0; k < watched_.size(); ++k) {
      floors[static_cast<Eigen::Index>(k)] = model_.sensors[static_cast<std::size_t>(watched_[k])].floor();
    }
    Eigen::MatrixXd C = floors.cwiseAbs2().asDiagonal();
    if (!postures_.balanced.empty()) {
      const Eigen::VectorXd slope = watched(posture.readings(kHandStep) - posture.readings()) / kHandStep;
      C += postures_.hand * postures_.hand * slope * slope.transpose();
    }
    return C;
  }

  model::Model model_;
  const Postures& postures_;
  const PostureReadings& readings_;
  const std::vector<FreeParameter>& parameters_;
  std::vector<Eigen::Index> watched_;
  std::vector<std::unique_ptr<Posture>> all_;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> whiteners_;
};

/// Magnitudes for differences: the value, or what is known of it, or a thousandth of a metre, kilogram, or
/// the like.
void set_sizes(const Eigen::VectorXd& theta, std::vector<FreeParameter>& parameters) {
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double here = std::abs(theta[static_cast<Eigen::Index>(p)]);
    const double known = parameters[p].deviation;
    parameters[p].typical = here > 0.0 ? here : (std::isfinite(known) ? known : 1e-2);
  }
}

struct Normal {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double cost = 0.0;
};

Normal normal_equations(PostureProblem& problem, const std::vector<FreeParameter>& parameters,
                        const Eigen::VectorXd& theta) {
  const Eigen::VectorXd r = problem.residual(theta);
  const Eigen::MatrixXd J = problem.jacobian(theta, r);
  Normal normal{J.transpose() * J, -J.transpose() * r, r.squaredNorm()};
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    const double deviation = parameters[p].deviation;
    if (std::isfinite(deviation)) {
      const double off = (theta[i] - parameters[p].mean) / deviation;
      normal.H(i, i) += 1.0 / (deviation * deviation);
      normal.g[i] -= off / deviation;
      normal.cost += off * off;
    }
  }
  return normal;
}

/// Gauss-Newton in units of each parameter's size: the equations of statics are nearly linear in them.
Eigen::VectorXd solve(PostureProblem& problem, const std::vector<FreeParameter>& parameters,
                      Eigen::VectorXd theta, const Eigen::VectorXd& sizes, int iterations, bool* converged) {
  for (int k = 0; k < iterations; ++k) {
    const Normal normal = normal_equations(problem, parameters, theta);
    const Eigen::MatrixXd H = sizes.asDiagonal() * normal.H * sizes.asDiagonal();
    const Eigen::VectorXd step = H.ldlt().solve(sizes.cwiseProduct(normal.g));
    const double longest = step.cwiseAbs().maxCoeff();
    theta += sizes.cwiseProduct(step) * std::min(1.0, 0.7 / std::max(longest, 1e-300));
    if (longest < kPostureSettled) {
      *converged = true;
      break;
    }
  }
  return theta;
}

IdentifiedValue finding_of(const LinkedParameter& linked, double theta, double deviation, double quantile) {
  IdentifiedValue finding;
  finding.unknown = linked.link.unknown;
  finding.value = linked.link.unknown_of(theta);
  finding.deviation = deviation / std::abs(linked.link.slope(finding.value));
  finding.lower = finding.value - quantile * finding.deviation;
  finding.upper = finding.value + quantile * finding.deviation;
  return finding;
}

}  // namespace

StepResult posture_fit(const Recipe& recipe, const Step& step, const Postures& postures,
                       const PostureReadings& readings, const KnowledgeMap& knowledge,
                       const MethodOptions& options) {
  const LinkedModel& linked = recipe.model(step.model);
  const std::vector<LinkedParameter> list = linked_parameters(linked, step, knowledge);
  std::vector<FreeParameter> parameters = parameters_of(list);
  const model::Model model = with_unknowns(linked, known_values(step, knowledge));
  const Eigen::VectorXd start = values_of(model, parameters);
  set_sizes(start, parameters);
  Eigen::VectorXd sizes(start.size());
  for (Eigen::Index p = 0; p < sizes.size(); ++p) {
    sizes[p] = parameters[static_cast<std::size_t>(p)].typical;
  }
  PostureProblem problem(model, postures, readings, parameters);
  StepResult result;
  result.step = step.name;
  result.windows = static_cast<int>(problem.poses());
  const Eigen::VectorXd r = problem.residual(start);
  const auto rows = static_cast<double>(r.size());
  result.before = std::sqrt(r.squaredNorm() / rows);
  result.converged = false;
  const Eigen::VectorXd theta =
      solve(problem, parameters, start, sizes, options.iterations, &result.converged);
  result.after = std::sqrt(problem.residual(theta).squaredNorm() / rows);
  const Normal normal = normal_equations(problem, parameters, theta);
  const Eigen::MatrixXd H = sizes.asDiagonal() * normal.H * sizes.asDiagonal();
  const Eigen::MatrixXd inverse = H.ldlt().solve(Eigen::MatrixXd::Identity(H.rows(), H.cols()));
  // Never below what the residuals' own size would give.
  const int free = static_cast<int>(step.free.size());
  const int degrees = std::max(1, static_cast<int>(rows) - free);
  const double scatter = std::sqrt(std::max(1.0, problem.residual(theta).squaredNorm() / degrees));
  const double quantile = student_quantile(options.confidence, degrees);
  for (std::size_t p = 0; p < list.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    const double deviation = scatter * std::sqrt(std::max(inverse(i, i), 0.0)) * sizes[i];
    (list[p].free ? result.findings : result.updated)
        .push_back(finding_of(list[p], theta[i], deviation, quantile));
  }
  const Eigen::MatrixXd information = inverse.topLeftCorner(free, free).inverse();
  result.weak = weak_directions(information, step.free);
  result.correlations = strong_correlations(information, step.free);
  return result;
}

}  // namespace plumbline::validation
