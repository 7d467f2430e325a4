#include "validation/identify/diagnose/unexplained.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/identify/inverse_model/inverse_model.h"

namespace plumbline::validation {
namespace {

void describe(const ForceSamples& samples, const Eigen::VectorXd& recorded, UnexplainedForce& out) {
  const Eigen::VectorXd& left = samples.force;
  out.rms = std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
  out.relative = left.norm() / std::max(recorded.norm(), 1e-300);
  out.dependences = dependences_of(samples);
  out.words = in_words(out.dependences, samples.of);
}

UnexplainedForce analyse(const NeededForce& force, const Trial& trial, bool angular) {
  UnexplainedForce out;
  out.trial = trial.name;
  out.at = force.motor;
  out.unit = force.unit;
  out.role = trial.role;
  const Eigen::VectorXd left = force.recorded - force.needed;
  const Eigen::VectorXd time =
      Eigen::VectorXd::LinSpaced(left.size(), 0.0, static_cast<double>(left.size()) * trial.period);
  ForceSamples samples;
  samples.force = left;
  samples.position = force.position;
  samples.velocity = force.velocity;
  samples.load = force.recorded;
  samples.time = time;
  samples.force_unit = force.unit;
  samples.angular = angular;
  describe(samples, force.recorded, out);
  return out;
}

/// The stage's prediction of a whole trial: its forces and its states, NaN where no window predicts.
struct Motion {
  Eigen::MatrixXd channels, states;  // samples x channels, states x samples
};

Motion motion_of(const Stage& stage, const Data& data, PredictorPool& pool, int trial) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Trial& recorded = data.trials[static_cast<std::size_t>(trial)];
  Motion motion;
  motion.channels.setConstant(recorded.samples(), static_cast<Eigen::Index>(recorded.measured.size()), kNone);
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    const Window& window = data.windows[w];
    if (window.trial != trial) {
      continue;
    }
    pool.with(static_cast<int>(w), stage.parameters, stage.estimate.theta, [&](Predictor& predictor) {
      motion.channels.middleRows(window.first, window.count) =
          predictor.predict(window, stage.estimate.x0[w]);
      motion.states.conservativeResize(predictor.plant().states(), recorded.samples());
      motion.states.middleCols(window.first, window.count) = predictor.predicted_states();
    });
  }
  return motion;
}

/// Which samples of a trial are looked at, and how much of their stance has passed.
struct Selection {
  std::vector<Eigen::Index> samples;
  std::vector<double> stance;  // empty: not known
};

Selection on_the_ground(const Trial& trial, const Eigen::MatrixXd& predicted) {
  Selection selection;
  const auto add = [&](Eigen::Index k) {
    const bool is_predicted = std::isfinite(predicted(k, 0));
    if (is_predicted) {
      selection.samples.push_back(k);
    }
    return is_predicted;
  };
  if (trial.switches.empty()) {
    for (Eigen::Index k = 0; k < trial.samples(); ++k) {
      add(k);
    }
  }
  for (const Stance& stance : stances_of(trial)) {
    for (Eigen::Index k = stance.first; k < stance.end; ++k) {
      if (add(k)) {
        selection.stance.push_back(static_cast<double>(k - stance.first) /
                                   static_cast<double>(stance.end - stance.first));
      }
    }
  }
  return selection;
}

Eigen::VectorXd taken(const Eigen::VectorXd& all, const std::vector<Eigen::Index>& samples) {
  Eigen::VectorXd some(static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    some[static_cast<Eigen::Index>(i)] = all[samples[i]];
  }
  return some;
}

/// Against the motion of one coordinate.
UnexplainedForce analyse_plate(const Trial& trial, const Measured& plate, const std::string& coordinate,
                               const Motion& motion, Eigen::Index channel, const Selection& selection,
                               const model::Plant& plant) {
  Eigen::VectorXd position(trial.samples());
  Eigen::VectorXd velocity(trial.samples());
  for (const Eigen::Index k : selection.samples) {
    position[k] = plant.position_of(coordinate, motion.states.col(k).data());
    velocity[k] = plant.velocity_of(coordinate, motion.states.col(k).data());
  }
  const Eigen::VectorXd predicted = taken(motion.channels.col(channel), selection.samples);
  const Eigen::VectorXd recorded = taken(plate.values, selection.samples);
  ForceSamples samples;
  samples.force = recorded - predicted;
  samples.position = taken(position, selection.samples);
  samples.velocity = taken(velocity, selection.samples);
  samples.load = predicted;
  samples.time = taken(trial.time, selection.samples);
  samples.stance = Eigen::Map<const Eigen::VectorXd>(selection.stance.data(),
                                                     static_cast<Eigen::Index>(selection.stance.size()));
  samples.force_unit = "N";
  samples.of = coordinate;
  samples.angular = plant.model().place_is_angular(effects::Place::coordinate, coordinate);
  UnexplainedForce out;
  out.trial = trial.name;
  out.at = plate.sensor;
  out.unit = "N";
  out.of = coordinate;
  out.role = trial.role;
  describe(samples, recorded, out);
  return out;
}

void add_plates(const Stage& stage, const Data& data, PredictorPool& pool, int t,
                std::vector<UnexplainedForce>& all) {
  constexpr std::size_t kFewest = 50;  // samples: fewer say nothing about what a force follows
  const Trial& trial = data.trials[static_cast<std::size_t>(t)];
  const auto is_plate = [&](const Measured& channel) {
    return stage.model.find_sensor(channel.sensor)->is_force_plate();
  };
  if (std::none_of(trial.measured.begin(), trial.measured.end(), is_plate)) {
    return;
  }
  const Motion motion = motion_of(stage, data, pool, t);
  const Selection selection = on_the_ground(trial, motion.channels);
  if (selection.samples.size() < kFewest) {
    return;
  }
  const model::Plant plant(pool.model(), trial.locks, trial.terrain);
  for (std::size_t c = 0; c < trial.measured.size(); ++c) {
    if (!is_plate(trial.measured[c])) {
      continue;
    }
    std::vector<UnexplainedForce> each;
    for (const model::Coordinate& coordinate : stage.model.coordinates) {
      each.push_back(analyse_plate(trial, trial.measured[c], coordinate.name, motion,
                                   static_cast<Eigen::Index>(c), selection, plant));
    }
    const auto follows = [](const UnexplainedForce& a, const UnexplainedForce& b) {
      return a.dependences.front().share < b.dependences.front().share;
    };
    const auto best = std::max_element(each.begin(), each.end(), follows);
    if (best != each.end()) {
      all.push_back(*best);
    }
  }
}

}  // namespace

std::vector<UnexplainedForce> unexplained_forces(const Stage& stage, const Data& data) {
  constexpr double kMostly = 0.7;  // of the root mean square: half of the variance
  const model::Model fitted = fitted_model(stage);
  PredictorPool pool(fitted, data);
  std::vector<UnexplainedForce> all;
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    const Trial& trial = data.trials[t];
    const InverseModel inverse = inverse_model(fitted, trial, {});
    const std::vector<double> floors = force_floors(fitted, trial, inverse, {});
    for (std::size_t m = 0; m < inverse.motors.size(); ++m) {
      const NeededForce& force = inverse.motors[m];
      const model::Motor* motor = fitted.find_motor(force.motor);
      all.push_back(analyse(force, trial, motor == nullptr || motor->angular));
      all.back().below = inverse.cutoff;
      all.back().sensors = floors[m];
      if (floors[m] > kMostly * all.back().rms) {
        all.back().dependences.clear();
        all.back().words = "cannot be told from what the sensors alone make of it";
      }
    }
    add_plates(stage, data, pool, static_cast<int>(t), all);
  }
  return all;
}

}  // namespace plumbline::validation
