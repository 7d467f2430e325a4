#include "validation/identify/standard/torque_problem.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/trace/error.h"
#include "validation/identify/standard/bounded_minimum.h"

namespace plumbline::validation {
namespace {

constexpr int kWeightings = 4;
constexpr double kDifference = 1e-3;  // of a spread
constexpr double kUnseen = 1e-6;      // of the rms torque, for one spread
constexpr double kUnknown = 1e-9;     // information on a value of which nothing is known, for the solver

/// Sums over the samples of one motor, the values in spreads.
struct NormalEquations {
  Eigen::MatrixXd H;  ///< J' J
  Eigen::VectorXd g;  ///< J' e
  double square = 0.0, count = 0.0;

  double rms(const Eigen::VectorXd& step) const {
    const double sum = square + 2.0 * g.dot(step) + step.dot(H * step);
    return std::sqrt(std::max(sum, 0.0) / std::max(count, 1.0));
  }
};

using ByMotor = std::map<int, NormalEquations>;

std::vector<MotionSamples> samples_of(const model::Model& model, const Data& data, const Cutoffs& cutoffs,
                                      Role role) {
  std::vector<MotionSamples> all;
  bool any = false;
  for (const Trial& trial : data.trials) {
    if (trial.role == role) {
      any = true;
      MotionSamples samples = motion_samples(model, trial, cutoffs.motion, cutoffs.force);
      if (!samples.used.empty()) {
        all.push_back(std::move(samples));
      }
    }
  }
  if (any && all.empty()) {
    throw InputError(
        "found only records with role: " + to_string(role) +
        " that are shorter than the ends of a filter, expected a longer one or a higher --cutoff");
  }
  if (all.empty()) {
    throw InputError("found no trial with role: " + to_string(role) + ", expected at least one");
  }
  return all;
}

/// Inertia that each moving place feels, mean over a few samples: 1 / (W M^-1 W')_mm.
Eigen::VectorXd felt_inertia(const model::Model& model, const MotionSamples& samples) {
  const Eigen::MatrixXd W = samples.to_places.inverse().transpose();
  return mean_over_motion(model, samples, [&](const Eigen::MatrixXd& M) {
    return Eigen::VectorXd((W * M.ldlt().solve(W.transpose())).diagonal().cwiseInverse());
  });
}

std::map<std::string, MotorScales> scales_of(const model::Model& model,
                                             const std::vector<MotionSamples>& all) {
  std::map<std::string, MotorScales> scales;
  std::map<std::string, double> counts;
  for (const MotionSamples& samples : all) {
    const Eigen::MatrixXd torques = recorded_torques(model, samples);
    const Eigen::MatrixXd W = samples.to_places.inverse().transpose();
    const Eigen::MatrixXd speeds = W * samples.motion.v(Eigen::all, samples.used);
    const Eigen::MatrixXd rates = W * samples.motion.a(Eigen::all, samples.used);
    const Eigen::VectorXd inertia = felt_inertia(model, samples);
    for (Eigen::Index i = 0; i < torques.rows(); ++i) {
      const int place = samples.moving[static_cast<std::size_t>(i)];
      const std::string& name = place_name(model, place);
      const auto count = static_cast<double>(torques.cols());
      // Where no motor acts: what moves the joint's own inertia as it was moved.
      scales[name].torque +=
          is_passive(model, place) ? (inertia[i] * rates.row(i)).squaredNorm() : torques.row(i).squaredNorm();
      scales[name].velocity += speeds.row(i).squaredNorm();
      scales[name].inertia += count * inertia[i];
      counts[name] += count;
    }
  }
  for (auto& [name, one] : scales) {
    const double count = counts[name];
    one = {std::sqrt(one.torque / count), std::sqrt(one.velocity / count), one.inertia / count};
    if (!(one.torque > 0.0) || !(one.velocity > 0.0)) {
      throw InputError("found " + name + " without torque or motion in the train trials, expected both");
    }
  }
  return scales;
}

/// Slope of the torque errors by one value, for one spread.
Eigen::MatrixXd slope(const model::Model& model, const FreeValue& value, const MotionSamples& samples,
                      const Eigen::MatrixXd& errors) {
  // Away from the nearer limit: a step must not leave what is physical.
  const double room = value.upper - value.value < value.value - value.lower ? -1.0 : 1.0;
  const double step = room * kDifference * value.spread;
  model::Model moved = model;
  set_value(moved, value.id, value.value + step);
  return (torque_errors(moved, samples) - errors) / (room * kDifference);
}

/// Normal equations of each motor, over all trials.
ByMotor normal_equations(const std::vector<MotionSamples>& all, const TorqueErrors& errors,
                         const TorqueSlopes& slopes) {
  const auto count = static_cast<Eigen::Index>(slopes.size());
  ByMotor equations;
  for (std::size_t t = 0; t < all.size(); ++t) {
    for (Eigen::Index m = 0; m < errors[t].rows(); ++m) {
      Eigen::MatrixXd J(errors[t].cols(), count);
      for (Eigen::Index i = 0; i < count; ++i) {
        J.col(i) = slopes[static_cast<std::size_t>(i)][t].row(m).transpose();
      }
      NormalEquations& sum = equations[all[t].moving[static_cast<std::size_t>(m)]];
      if (sum.count == 0.0) {
        sum.H = Eigen::MatrixXd::Zero(count, count);
        sum.g = Eigen::VectorXd::Zero(count);
      }
      sum.H += J.transpose() * J;
      sum.g += J.transpose() * errors[t].row(m).transpose();
      sum.square += errors[t].row(m).squaredNorm();
      sum.count += static_cast<double>(errors[t].cols());
    }
  }
  return equations;
}

void look_for_unseen(const ByMotor& equations, const model::Model& model,
                     const std::map<std::string, MotorScales>& scales, std::vector<FreeValue>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    double most = 0.0;
    for (const auto& [motor, sum] : equations) {
      const double torque = scales.at(place_name(model, motor)).torque;
      most = std::max(most, std::sqrt(sum.H(k, k) / sum.count) / torque);
    }
    values[i].seen = most > kUnseen;
  }
}

/// All motors weighted, with what is stated: H d = g, in spreads from the present values.
struct Weighted {
  Eigen::MatrixXd H;
  Eigen::VectorXd g, lower, upper;
};

Weighted weighted(const ByMotor& equations, const FreeModel& free, double independent,
                  const Eigen::VectorXd& step, const std::map<int, double>& least) {
  const std::vector<FreeValue>& values = free.values;
  const auto count = static_cast<Eigen::Index>(values.size());
  Weighted all{stated_information(free), Eigen::VectorXd::Zero(count), Eigen::VectorXd(count),
               Eigen::VectorXd(count)};
  Eigen::VectorXd off = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const FreeValue& value = values[static_cast<std::size_t>(i)];
    if (value.known) {
      off[i] = (value.stated - value.value) / value.spread;
    } else {
      all.H(i, i) = kUnknown;
    }
    all.lower[i] = value.seen ? std::min(0.0, (value.lower - value.value) / value.spread) : 0.0;
    all.upper[i] = value.seen ? std::max(0.0, (value.upper - value.value) / value.spread) : 0.0;
  }
  all.g = all.H * off;
  for (const auto& [motor, sum] : equations) {
    const double error = std::max(sum.rms(step), least.at(motor));
    all.H += independent / (error * error) * sum.H;
    all.g -= independent / (error * error) * sum.g;
  }
  return all;
}

void take(const BoundedMinimum& minimum, const Weighted& all, FreeModel& free) {
  std::vector<FreeValue>& values = free.values;
  const Eigen::MatrixXd covariance =
      free_part(all.H, minimum.held)
          .ldlt()
          .solve(Eigen::MatrixXd::Identity(std::count(minimum.held.begin(), minimum.held.end(), false),
                                           std::count(minimum.held.begin(), minimum.held.end(), false)));
  std::vector<Eigen::Index> found;
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    FreeValue& value = values[i];
    value.at_limit = value.seen && minimum.held[i];
    const double moved = value.value + minimum.at[static_cast<Eigen::Index>(i)] * value.spread;
    value.value = std::clamp(moved, value.lower, value.upper);
    value.deviation = value.spread;
    if (!minimum.held[i]) {
      value.deviation = value.spread * std::sqrt(covariance(next, next));
      found.push_back(static_cast<Eigen::Index>(i));
      ++next;
    }
  }
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const auto count = static_cast<Eigen::Index>(values.size());
  free.correlation = Eigen::MatrixXd::Identity(count, count);
  free.correlation(found, found) = scale.asDiagonal() * covariance * scale.asDiagonal();
}

/// Below a small share of the torque no error is held for noise.
std::map<int, double> least_errors(const model::Model& model,
                                   const std::map<std::string, MotorScales>& scales) {
  constexpr double kLeast = 1e-6;
  std::map<int, double> least;
  for (const auto& [name, one] : scales) {
    least[place_index(model, name)] = kLeast * one.torque;
  }
  return least;
}

/// Between two sets of values.
FreeModel between(const FreeModel& from, FreeModel to, double share) {
  for (std::size_t i = 0; i < to.values.size(); ++i) {
    to.values[i].value = from.values[i].value + share * (to.values[i].value - from.values[i].value);
  }
  return to;
}

}  // namespace

TorqueProblem::TorqueProblem(const model::Model& model, const Data& data, const Cutoffs& cutoffs, Role role)
    : all_(samples_of(model, data, cutoffs, role)),
      scales_(scales_of(model, all_)),
      least_(least_errors(model, scales_)),
      threads_(data.threads),
      share_(std::min(1.0, 2.0 * all_.front().cutoff * all_.front().period)) {}

Eigen::Index TorqueProblem::samples() const {
  Eigen::Index sum = 0;
  for (const MotionSamples& samples : all_) {
    sum += static_cast<Eigen::Index>(samples.used.size());
  }
  return sum;
}

double TorqueProblem::independent_samples() const {
  return share_ * static_cast<double>(samples()) * static_cast<double>(least_.size());
}

TorqueErrors TorqueProblem::errors(const model::Model& model) const {
  TorqueErrors errors;
  for (const MotionSamples& samples : all_) {
    errors.push_back(torque_errors(model, samples));
  }
  return errors;
}

std::map<int, double> TorqueProblem::rms(const model::Model& model) const {
  std::map<int, NormalEquations> sums;
  const TorqueErrors errors = this->errors(model);
  for (std::size_t t = 0; t < all_.size(); ++t) {
    for (Eigen::Index m = 0; m < errors[t].rows(); ++m) {
      NormalEquations& sum = sums[all_[t].moving[static_cast<std::size_t>(m)]];
      sum.square += errors[t].row(m).squaredNorm();
      sum.count += static_cast<double>(errors[t].cols());
    }
  }
  std::map<int, double> rms;
  for (const auto& [motor, sum] : sums) {
    rms[motor] = std::sqrt(sum.square / sum.count);
  }
  return rms;
}

TorqueBlocks TorqueProblem::blocks(const model::Model& model, double length) const {
  const TorqueErrors errors = this->errors(model);
  Eigen::Index count = 0;
  std::vector<Eigen::Index> first;
  std::vector<Eigen::Index> of_trial;
  for (const MotionSamples& samples : all_) {
    const double seconds = static_cast<double>(samples.used.size()) * samples.period;
    first.push_back(count);
    of_trial.push_back(std::max<Eigen::Index>(1, std::lround(seconds / length)));
    count += of_trial.back();
  }
  const auto places = static_cast<Eigen::Index>(model.motors.size() + model.coordinates.size());
  TorqueBlocks blocks{Eigen::MatrixXd::Zero(places, count), Eigen::MatrixXd::Zero(places, count)};
  for (std::size_t t = 0; t < all_.size(); ++t) {
    for (Eigen::Index k = 0; k < errors[t].cols(); ++k) {
      const Eigen::Index block = first[t] + k * of_trial[t] / errors[t].cols();
      for (Eigen::Index m = 0; m < errors[t].rows(); ++m) {
        const int motor = all_[t].moving[static_cast<std::size_t>(m)];
        blocks.squares(motor, block) += errors[t](m, k) * errors[t](m, k);
        blocks.samples(motor, block) += 1.0;
      }
    }
  }
  return blocks;
}

double TorqueProblem::cost(const FreeModel& free) const {
  const double count = share_ * static_cast<double>(samples());
  double sum = 0.0;
  try {
    for (const auto& [motor, error] : rms(identified(free))) {
      sum += 2.0 * count * std::log(std::max(error, least_.at(motor)));
    }
  } catch (const InputError&) {  // a mass matrix without inertia somewhere: no physical values
    return std::numeric_limits<double>::infinity();
  }
  return sum + stated_misfit(free);
}

TorqueSlopes TorqueProblem::slopes(const FreeModel& free, std::size_t first,
                                   const TorqueErrors& errors) const {
  const model::Model model = identified(free);
  TorqueSlopes slopes(free.values.size() - first, TorqueErrors(all_.size()));
  for (std::size_t t = 0; t < all_.size(); ++t) {
    parallel_for(static_cast<int>(slopes.size()), threads_, [&](int i) {
      const auto index = static_cast<std::size_t>(i);
      slopes[index][t] = slope(model, free.values[first + index], all_[t], errors[t]);
    });
  }
  return slopes;
}

FreeModel TorqueProblem::aimed(FreeModel free, const TorqueErrors& errors, const TorqueSlopes& slopes) const {
  const ByMotor equations = normal_equations(all_, errors, slopes);
  look_for_unseen(equations, free.model, scales_, free.values);
  Weighted normal;
  BoundedMinimum minimum{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free.values.size())), {}};
  for (int i = 0; i < kWeightings; ++i) {
    normal = weighted(equations, free, share_, minimum.at, least_);
    minimum = bounded_minimum(normal.H, normal.g, normal.lower, normal.upper);
  }
  take(minimum, normal, free);
  return free;
}

double TorqueProblem::step(FreeModel& free, const TorqueErrors& errors, const TorqueSlopes& slopes) const {
  constexpr double kShortest = 0.01;
  const FreeModel aim = aimed(free, errors, slopes);
  const double before = cost(free);
  for (double share = 1.0; share > kShortest; share *= 0.5) {
    FreeModel candidate = between(free, aim, share);
    const double after = cost(candidate);
    if (after < before) {
      free = std::move(candidate);
      return before - after;
    }
  }
  return 0.0;
}

void TorqueProblem::search(FreeModel& free) const {
  constexpr int kMostSteps = 60;
  constexpr double kWorthwhile = 0.1;  // of the cost, where 1 is one standard deviation
  // Errors are affine in nearly all values, so slopes serve for several steps; none is the last without fresh
  // ones (the chord method: Ortega and Rheinboldt 1970, 7.1).
  TorqueSlopes held;
  for (int i = 0; i < kMostSteps; ++i) {
    const TorqueErrors errors = this->errors(identified(free));
    const bool is_fresh = held.empty();
    if (is_fresh) {
      held = slopes(free, 0, errors);
    }
    const double gain = step(free, errors, held);
    if (gain < kWorthwhile) {
      if (is_fresh) {
        return;
      }
      held.clear();
    }
  }
}

}  // namespace plumbline::validation
