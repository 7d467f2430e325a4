#include "validation/control/certify/drive_part.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>

namespace plumbline::validation {
namespace {

using driver::Json;
using driver::Plan;

Json or_none(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// To two digits, upward: 0.0123 becomes 0.013. By way of a text, so that it is the double nearest to the
/// decimal.
double round_up(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(value))) - 1;
  const double digits = std::ceil(value / std::pow(10.0, exponent) * (1.0 - 1e-12));
  return std::strtod(fmt::format("{:.0f}e{}", digits, exponent).c_str(), nullptr);
}

Json reach_json(const driver::Reach& reach, const Plan& plan, bool predicted) {
  Json json;
  json["name"] = reach.name;
  Json::Object of;
  for (const driver::Reach::Term& term : reach.of) {
    of[plan.channels[static_cast<std::size_t>(term.channel)].name] = Json(term.factor);
  }
  json["of"] = Json(of);
  json["from"] = or_none(reach.from);
  json["to"] = or_none(reach.to);
  if (predicted) {
    json["deceleration"] = or_none(reach.deceleration);
  }
  return json;
}

const char* kind_name(driver::ChannelKind kind) {
  switch (kind) {
    case driver::ChannelKind::count:
      return "count";
    case driver::ChannelKind::contact:
      return "switch";
    case driver::ChannelKind::value:
      break;
  }
  return "value";
}

}  // namespace

void take_limits(Plan& plan, const Extremes& largest, double speed_times, double rest_times,
                 double slew_times) {
  for (std::size_t k = 0; k < plan.channels.size(); ++k) {
    driver::Channel& channel = plan.channels[k];
    const auto index = static_cast<Eigen::Index>(k);
    if (channel.kind == driver::ChannelKind::contact || !(largest.rate[index] > 0.0)) {
      continue;
    }
    channel.speed = round_up(speed_times * largest.rate[index]);
    // Shorter than ten samples means nothing: an encoder's count may stay for so long at any speed that is
    // slow.
    channel.rest = round_up(std::max(rest_times * largest.rest[index], 10.0 * plan.period));
  }
  for (std::size_t k = 0; k < plan.commands.size(); ++k) {
    const double slew = largest.slew[static_cast<Eigen::Index>(k)];
    plan.commands[k].slew = slew > 0.0 ? round_up(slew_times * slew) : driver::kNone;
  }
}

Json drive_json(const Plan& plan) {
  Json drive;
  drive["robot"] = plan.robot;
  drive["period"] = plan.period;
  for (const driver::Channel& channel : plan.channels) {
    Json one;
    one["name"] = channel.name;
    one["unit"] = channel.unit;
    one["kind"] = kind_name(channel.kind);
    one["scale"] = channel.scale;
    one["speed"] = or_none(channel.speed);
    one["rest"] = or_none(channel.rest);
    drive["channels"].push_back(one);
  }
  for (const driver::CommandChannel& command : plan.commands) {
    Json one;
    one["name"] = command.name;
    one["unit"] = command.unit;
    one["limit"] = command.limit;
    one["slew"] = or_none(command.slew);
    one["hold"] = Json();
    if (command.hold.channel >= 0) {
      one["hold"]["channel"] = plan.channels[static_cast<std::size_t>(command.hold.channel)].name;
      one["hold"]["stiffness"] = command.hold.stiffness;
      one["hold"]["damping"] = command.hold.damping;
    }
    drive["commands"].push_back(one);
  }
  for (const Plan::Input& input : plan.inputs) {
    Json one;
    one["port"] = input.port;
    one["from"] = Json::Array();
    for (const int channel : input.from) {
      one["from"].push_back(plan.channels[static_cast<std::size_t>(channel)].name);
    }
    one["scale"] = input.scale;
    one["fixed"] = input.from.empty() ? Json(input.fixed) : Json();
    drive["inputs"].push_back(one);
  }
  for (const Plan::Output& output : plan.outputs) {
    Json one;
    one["port"] = output.port;
    one["to"] = plan.commands[static_cast<std::size_t>(output.to)].name;
    drive["outputs"].push_back(one);
  }
  drive["workspace"] = Json::Array();
  for (const driver::Reach& reach : plan.workspace) {
    drive["workspace"].push_back(reach_json(reach, plan, true));
  }
  drive["handover"] = Json::Array();
  for (const driver::Reach& reach : plan.handover) {
    drive["handover"].push_back(reach_json(reach, plan, false));
  }
  Json& packets = drive["packets"];
  packets["lost_in_succession"] = plan.packets.lost_in_succession;
  packets["lost"] = plan.packets.lost;
  packets["duplicated"] = plan.packets.duplicated;
  packets["reordered"] = plan.packets.reordered;
  packets["corrupt"] = plan.packets.corrupt;
  Json& times = drive["times"];
  times["silence"] = plan.silence;
  times["answer"] = plan.answer;
  times["late"] = plan.late;
  times["controller"] = plan.controller_time;
  return drive;
}

Json controller_json(const Plan& plan) {
  Json controller;
  controller["file"] = plan.library;
  controller["sha256"] = plan.library_sha256;
  controller["name"] = plan.controller;
  controller["version"] = plan.controller_version;
  controller["constants"] = Json::Array();
  for (std::size_t k = 0; k < plan.constants.size(); ++k) {
    Json one;
    one["name"] = plan.constant_names[k];
    one["value"] = plan.constants[k];
    controller["constants"].push_back(one);
  }
  controller["log"] = Json::Array();
  for (const std::string& name : plan.log) {
    Json one;
    one["name"] = name;
    controller["log"].push_back(one);
  }
  return controller;
}

}  // namespace plumbline::validation
