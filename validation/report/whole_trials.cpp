#include "validation/report/whole_trials.h"

#include <filesystem>

namespace plumbline::validation {
namespace {

using nlohmann::json;

json loop_json(const ClosedLoop& loop) {
  json out{{"not_available", loop.not_available}, {"loops", json::array()}};
  for (const LoopError& error : loop.loops) {
    out["loops"].push_back({{"motor", error.motor},
                            {"sensor", error.sensor},
                            {"position_percent", error.position_percent},
                            {"force_percent", error.force_percent},
                            {"equation_rms", error.equation_rms},
                            {"disturbance_factor", error.disturbance_factor}});
  }
  return out;
}

json inverse_json(const InverseModel& inverse) {
  json out{{"not_available", inverse.not_available}, {"motors", json::array()}};
  for (const NeededForce& force : inverse.motors) {
    out["motors"].push_back({{"motor", force.motor}, {"force_percent", force.error_percent()}});
  }
  return out;
}

}  // namespace

std::vector<WholeTrial> whole_trials(const model::Model& model, const Data& data) {
  std::vector<WholeTrial> list;
  for (const Trial& trial : data.trials) {
    if (data.stop != nullptr && data.stop->raised) {
      throw Stopped();
    }
    list.push_back({trial.name, std::filesystem::path(trial.data_file).filename().string(), trial.role,
                    closed_loop(model, trial, data.predict), inverse_model(model, trial, {})});
  }
  return list;
}

json to_json(const WholeTrial& trial) {
  return {{"trial", trial.trial},
          {"data", trial.data},
          {"role", to_string(trial.role)},
          {"closed_loop", loop_json(trial.loop)},
          {"inverse_model", inverse_json(trial.inverse)}};
}

json to_json(const ReferenceValue& value) {
  return {{"compares", to_string(value.quantity)},
          {"model", value.model},
          {"data", value.data},
          {"percent", value.percent},
          {"source", value.source}};
}

}  // namespace plumbline::validation
