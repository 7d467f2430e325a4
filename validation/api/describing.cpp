#include "validation/api/describing.h"

#include <cmath>

#include "simulator/model/kinds.h"
#include "simulator/model/plant.h"
#include "validation/report/model_json.h"

namespace plumbline::api {

using model::Model;
using model::reading_unit;
using nlohmann::json;
using validation::Trial;

double rms(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

Freedom freedom_of(const model::Model& model, const std::vector<validation::Lock>& locks) {
  std::vector<model::Lock> held;
  held.reserve(locks.size());
  for (const validation::Lock& lock : locks) {
    held.push_back({lock.at, lock.value});
  }
  model::Plant plant(model,
                     held);  // refuses contradictory ratios, singular mass matrices, loops that never close
  const int tied = plant.has_loops() ? plant.holding()->size() : 0;
  return {plant.positions() - tied, plant.states()};
}

json to_json(const Model& model, const Freedom& freedom) {
  json description = validation::model_json(model);
  description["independent_coordinates"] = freedom.coordinates;
  description["states"] = freedom.states;
  return description;
}

json to_json(const Trial& trial, const Model& model, const Freedom& freedom) {
  json out{{"kind", "trial"},
           {"file", trial.file},
           {"title", trial.title},
           {"model", model.file},
           {"data", trial.data_file},
           {"role", to_string(trial.role)},
           {"samples", trial.samples()},
           {"period", trial.period},
           {"duration", trial.time[trial.samples() - 1] - trial.time[0]},
           {"independent_coordinates", freedom.coordinates},
           {"events", trial.events}};
  for (const char* key : {"measured", "commands", "locked", "controllers"}) {
    out[key] = json::array();
  }
  for (const validation::Measured& channel : trial.measured) {
    out["measured"].push_back({{"sensor", channel.sensor},
                               {"column", channel.column},
                               {"column_unit", channel.unit},
                               {"unit", reading_unit(model, channel.sensor)},
                               {"rms", rms(channel.values)},
                               {"floor", sensor_of(model, channel).floor()}});
  }
  out["contact_events"] = json::array();
  for (const validation::ContactEvent& event : trial.contact_events) {
    out["contact_events"].push_back(
        {{"time", event.time},
         {"contact_switch", trial.switches[static_cast<std::size_t>(event.record)].name},
         {"kind", event.touchdown ? "touchdown" : "lift-off"}});
  }
  for (const validation::Command& command : trial.commands) {
    out["commands"].push_back({{"motor", command.motor},
                               {"column", command.column},
                               {"column_unit", command.unit},
                               {"unit", model.find_motor(command.motor)->command_unit},
                               {"rms", rms(command.values)}});
  }
  for (const validation::Lock& lock : trial.locks) {
    out["locked"].push_back({{"at", lock.at}, {"value", lock.value}});
  }
  for (const validation::Controller& controller : trial.controllers) {
    out["controllers"].push_back(
        {{"kind", controller.kind}, {"motor", controller.motor}, {"sensor", controller.sensor}});
  }
  return out;
}

}  // namespace plumbline::api
