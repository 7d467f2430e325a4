// A plan for tests: one joint with an encoder, a second sensor, a switch, one motor.
#pragma once

#include "controllers/driver/plan.h"

namespace plumbline::driver {

inline Plan small_plan() {
  Plan plan;
  plan.title = "test";
  plan.robot = "one joint";
  plan.model = "model.yaml";
  plan.channels.push_back({"joint", "rad", ChannelKind::count, 1e-3, 20.0, 0.05});
  plan.channels.push_back({"tilt", "rad", ChannelKind::value, 1.0, 50.0, kNone});
  plan.channels.push_back({"foot", "1", ChannelKind::contact, 1.0, kNone, kNone});
  CommandChannel motor;
  motor.name = "motor";
  motor.unit = "N m";
  motor.limit = 10.0;
  motor.slew = 3000.0;
  motor.hold = {0, 5.0, 0.1};
  plan.commands.push_back(motor);
  plan.library = "stub.so";
  plan.controller = "stub";
  plan.controller_version = "1";
  plan.constant_names = {"fault", "at"};
  plan.constants = {0.0, 0.0};
  plan.inputs = {{"joint", {0}, 1e-3, 0.0}, {"tilt", {1}, 1.0, 0.0}, {"foot", {2}, 1.0, 0.0}};
  plan.outputs = {{"motor", 0}};
  plan.log = {"step"};
  plan.workspace.push_back({"joint", {{0, 1.0}}, -1.0, 1.0, 50.0});
  plan.handover.push_back({"joint", {{0, 1.0}}, -0.5, 0.5, kNone});
  plan.packets.lost_in_succession = 2;
  plan.packets.lost = 5;
  plan.packets.duplicated = 1;
  plan.packets.reordered = 1;
  plan.packets.corrupt = 1;
  plan.silence = 0.5;
  plan.answer = 0.4;
  plan.late = 0;
  plan.controller_time = 0.3;
  return plan;
}

}  // namespace plumbline::driver
