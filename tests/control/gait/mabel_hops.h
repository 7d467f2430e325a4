// MABEL's hops for tests: its scenario with another robot, start or controller.
#pragma once

#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/run_scenario.h"
#include "validation/control/gait/gait_run.h"
#include "validation/identify/twin/recorded_run.h"

namespace plumbline::validation {

inline std::string mabel_file(const std::string& name) { return PLUMBLINE_ROOT "/robots/mabel/" + name; }

inline model::Model mabel(const std::string& name) {
  return model::read_model(mabel_file(name), model::known_effects());
}

struct HopStart {
  double clearance = 0.05, speed = -0.3, torso = 0.0;  // m, m/s, rad beyond the scenario's
};

/// `model` in place of the scenario's: in the plane, or at its boom.
inline run::LoadedScenario hopping(const model::Model& model, const HopStart& start = {},
                                   const std::string& controller = "hopping.yaml") {
  const bool boom = model.sensor_index("tower") >= 0;
  run::LoadedScenario loaded =
      run::read_scenario(mabel_file(boom ? "scenarios/hopping_boom.yaml" : "scenarios/hopping.yaml"),
                         {"", mabel_file("controllers/" + controller)});
  loaded.model = model;
  loaded.scenario.start.clearance = start.clearance;
  *loaded.scenario.start.position("torso") += start.torso;
  *loaded.scenario.start.velocity(boom ? "tower" : "hip_x") = start.speed / (boom ? 2.25 : 1.0);
  return loaded;
}

/// So many hops, with trace and record.
inline GaitRun hops_of(const run::LoadedScenario& loaded, long hops, double tolerance = 1e-5) {
  GaitView view;
  view.gait = *read_gait(loaded);
  GaitOptions options;
  options.enough = hops;
  options.run.trace = true;
  options.run.integrator.set_tolerance(tolerance);
  return run_gait(loaded, view, options);
}

inline Trial recorded_hops(const run::LoadedScenario& loaded, long hops, Role role = Role::train) {
  Trial trial = recorded_run(loaded.model, hops_of(loaded, hops).run.record, loaded.scenario);
  trial.role = role;
  return trial;
}

}  // namespace plumbline::validation
