#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>

#include "simulator/model/kinds.h"
#include "simulator/model/plant.h"
#include "simulator/model/positions_from.h"
#include "validation/cli/describe.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using model::Model;
using validation::Trial;

using api::rms;
using model::reading_unit;

/// Coordinates that the measured positions do not determine.
std::vector<std::string> unseen_coordinates(const Model& model, const Trial& trial) {
  model::Plant plant(model, trial.locks);
  std::vector<Eigen::RowVectorXd> rows;
  if (plant.closure() != nullptr) {  // as the loops are closed first; a rod is stretched by next to nothing
    const Eigen::MatrixXd& J = plant.closure()->jacobian(plant.home());
    for (Eigen::Index r = 0; r < J.rows(); ++r) {
      rows.emplace_back(J.row(r));
    }
  }
  for (const validation::Measured& channel : trial.measured) {
    const int sensor = model.sensor_index(channel.sensor);
    const model::Sensor& of = model.sensors[static_cast<std::size_t>(sensor)];
    if (of.shows_position() || of.shows_pose()) {
      rows.emplace_back(model::observe_sensor(plant, sensor).row);
    }
  }
  const auto rank_with = [&](const Eigen::RowVectorXd& last) {
    Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()) + 1, plant.positions());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      all.row(static_cast<Eigen::Index>(i)) = rows[i];
    }
    all.bottomRows(1) = last;
    return Eigen::FullPivLU<Eigen::MatrixXd>(all).rank();
  };
  std::vector<std::string> unseen;
  const Eigen::Index seen = rank_with(Eigen::RowVectorXd::Zero(plant.positions()));
  for (const model::Coordinate& coordinate : model.coordinates) {
    if (rank_with(model::observe_place(plant, coordinate.name, 1.0).row) > seen) {
      unseen.push_back(coordinate.name);
    }
  }
  return unseen;
}

}  // namespace

void print(const Trial& trial, const Model& model, const Freedom& freedom) {
  fmt::print("Trial {}: {}\n", trial.file, trial.title);
  fmt::print("  model {}\n  data {}\n", model.file, trial.data_file);
  fmt::print("  role {}; {} samples every {:g} s, {:g} s in all; {} independent coordinates\n",
             to_string(trial.role), trial.samples(), trial.period,
             trial.time[trial.samples() - 1] - trial.time[0], freedom.coordinates);
  std::vector<std::vector<std::string>> rows;
  for (const validation::Measured& channel : trial.measured) {
    const std::string unit = reading_unit(model, channel.sensor);
    rows.push_back({"sensor " + channel.sensor, channel.column, channel.unit,
                    fmt::format("{:.4g} {}", rms(channel.values), unit),
                    fmt::format("{:.3g} {}", sensor_of(model, channel).floor(), unit)});
  }
  for (std::size_t r = 0; r < trial.switches.size(); ++r) {
    const auto events = std::count_if(
        trial.contact_events.begin(), trial.contact_events.end(),
        [&](const validation::ContactEvent& event) { return event.record == static_cast<int>(r); });
    rows.push_back({"contact switch " + trial.switches[r].name, trial.switches[r].column, "1",
                    fmt::format("{} events", events),
                    fmt::format("{:.3g} s", timing_floor(trial, static_cast<int>(r)))});
  }
  for (const validation::Command& command : trial.commands) {
    rows.push_back(
        {"command of " + command.motor, command.column, command.unit,
         fmt::format("{:.4g} {}", rms(command.values), model.find_motor(command.motor)->command_unit), ""});
  }
  fmt::print("\n");
  print_table({"channel", "column", "unit", "rms", "floor"}, rows);
  fmt::print("\n");
  for (const validation::Lock& lock : trial.locks) {
    fmt::print("Locked: {} at {:g} {}\n", lock.at, lock.value,
               model::position_unit(model::is_angular(model, lock.at)));
  }
  for (const contact::Platform& platform : trial.terrain.platforms()) {
    fmt::print("Platform: {:g} to {:g} m, {:g} m high\n", platform.from, platform.to, platform.height);
  }
  for (const validation::Controller& controller : trial.controllers) {
    fmt::print("Controller: {} on {}, from {}\n", controller.kind, controller.motor, controller.sensor);
  }
  for (const double event : trial.events) {
    fmt::print("Event: {:g} s\n", event);
  }
  for (const model::EffectUse& use : trial.configuration) {
    fmt::print("In this trial alone: {}\n", use.label());
  }
  if (trial.stretches.size() > 1) {
    fmt::print("Used: {} stretches; no window crosses from one to the next.\n", trial.stretches.size());
  }
  for (const std::string& remark : trial.remarks) {
    fmt::print("{}\n", remark);
  }
  for (const std::string& name : unseen_coordinates(model, trial)) {
    fmt::print("No sensor of this trial shows {}: how it moved is known only through the model.\n", name);
  }
}

}  // namespace plumbline::cli
