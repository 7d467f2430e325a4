#include "simulator/render/motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulator/model/positions_from.h"
#include "simulator/trace/error.h"

namespace plumbline::render {
namespace {

// Deviation of a position that was simulated, rad or m: about that of encoders, so that neither hides the
// other.
constexpr double kComputed = 1e-4;

struct Channels {
  std::vector<model::Observation> observations;
  std::vector<const Column*> columns;
};

bool is_place(const model::Model& model, const std::string& name) {
  return model.find_coordinate(name) != nullptr || model.find_motor(name) != nullptr ||
         model.find_pulley(name) != nullptr;
}

Channels channels_of(const Table& trace, const model::Plant& plant) {
  Channels channels;
  for (const Column& column : trace.columns) {
    const std::string kind = column.name.substr(0, 2);
    const std::string name = column.name.size() > 2 ? column.name.substr(2) : "";
    const int sensor = kind == "q_" ? plant.model().sensor_index(name) : -1;
    if (sensor >= 0) {
      channels.observations.push_back(model::observe_sensor(plant, sensor));
    } else if (kind == "x_" && is_place(plant.model(), name)) {
      channels.observations.push_back(model::observe_place(plant, name, kComputed));
    } else {
      continue;
    }
    require_finite(trace, column.name);
    channels.columns.push_back(&column);
  }
  return channels;
}

Eigen::VectorXd time_of(const Table& trace) {
  require_finite(trace, "t");
  const Eigen::VectorXd& time = trace.find("t")->values;
  for (Eigen::Index k = 1; k < time.size(); ++k) {
    if (!(time[k] > time[k - 1])) {
      throw InputError({trace.file, static_cast<int>(k) + 2, "t"}, "a time that is not after the one before",
                       "ascending times");
    }
  }
  return time;
}

std::vector<Eigen::Matrix3Xd> forces_of(const Table& trace, const model::Model& model) {
  std::vector<Eigen::Matrix3Xd> forces;
  for (const model::Foot& foot : model.feet) {
    Eigen::Matrix3Xd force(3, trace.rows());
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name = "F_" + foot.name + "_" + "xyz"[axis];
      if (trace.find(name) == nullptr) {
        return {};
      }
      require_finite(trace, name);
      force.row(axis) = trace.find(name)->values.transpose();
    }
    forces.push_back(force);
  }
  return forces;
}

}  // namespace

std::vector<std::string> phases_by_contact(const model::Model& model, Motion& motion) {
  std::vector<std::string> names;
  motion.phase.clear();
  for (Eigen::Index k = 0; !motion.foot_forces.empty() && k < motion.time.size(); ++k) {
    std::string feet;
    for (std::size_t f = 0; f < motion.foot_forces.size(); ++f) {
      if (motion.foot_forces[f].col(k).norm() > 0.0) {
        feet += (feet.empty() ? "" : " + ") + model.feet[f].name;
      }
    }
    const std::string name = feet.empty()             ? "flight"
                             : model.feet.size() == 1 ? "stance"
                                                      : "stance on " + feet;
    const auto known = std::find(names.begin(), names.end(), name);
    motion.phase.push_back(static_cast<int>(known - names.begin()) + 1);
    if (known == names.end()) {
      names.push_back(name);
    }
  }
  return names;
}

Motion motion_from(const Table& trace, const model::Plant& plant) {
  Motion motion;
  motion.time = time_of(trace);
  const Channels channels = channels_of(trace, plant);
  const model::PositionsFrom from(plant, channels.observations);
  if (channels.columns.empty() || !from.determined()) {
    throw InputError({trace.file, 0, "q_SENSOR, x_NAME"},
                     std::to_string(channels.columns.size()) + " columns that leave a position open",
                     "columns that determine all " + std::to_string(plant.positions()) + " positions of " +
                         plant.model().file);
  }
  Eigen::MatrixXd values(static_cast<Eigen::Index>(channels.columns.size()), trace.rows());
  for (std::size_t c = 0; c < channels.columns.size(); ++c) {
    values.row(static_cast<Eigen::Index>(c)) = channels.columns[c]->values.transpose();
  }
  motion.positions = from.positions(values);
  motion.foot_forces = forces_of(trace, plant.model());
  if (const Column* phase = trace.find("phase")) {
    for (const double value : phase->values) {
      motion.phase.push_back(static_cast<int>(std::lround(value)));
    }
  }
  return motion;
}

}  // namespace plumbline::render
