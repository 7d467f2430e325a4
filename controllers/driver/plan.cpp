#include "controllers/driver/plan.h"

#include <cmath>
#include <set>

#include "controllers/driver/packet.h"

namespace plumbline::driver {
namespace {

constexpr std::size_t kMostPorts = 128;
constexpr std::size_t kMostConstants = 1024;  // a gait's polynomials are many

/// One object of the body, and where it stands.
class Part {
 public:
  Part(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) fail("found something else, expected an object");
  }

  [[noreturn]] void fail(const std::string& what) const { throw DriverError(where_ + ": " + what); }
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw DriverError(where_ + "." + key + ": " + what);
  }

  const Json& at(const std::string& key) const {
    known_.insert(key);
    const Json* found = json_.find(key);
    if (found == nullptr) fail(key, "is missing");
    return *found;
  }
  std::string text(const std::string& key) const {
    const Json& value = at(key);
    if (!value.is_string() || value.text().find_first_of("\n\r") != std::string::npos) {
      fail(key, "expected a text of one line");
    }
    return value.text();
  }
  double number(const std::string& key, double least, double most) const {
    const Json& value = at(key);
    if (!value.is_number() || !(value.number() >= least) || !(value.number() <= most)) {
      fail(key, "expected a number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return value.number();
  }
  double positive(const std::string& key) const {
    const Json& value = at(key);
    if (!value.is_number() || !(value.number() > 0.0)) fail(key, "expected a number above 0");
    return value.number();
  }
  /// null: none.
  double positive_or_none(const std::string& key) const { return at(key).is_null() ? kNone : positive(key); }
  double limit(const std::string& key, double none) const {
    const Json& value = at(key);
    if (value.is_null()) return none;
    if (!value.is_number()) fail(key, "expected a number, or null for none");
    return value.number();
  }
  int whole(const std::string& key, int most) const {
    const double value = number(key, 0.0, most);
    if (value != std::floor(value)) fail(key, "expected a whole number");
    return static_cast<int>(value);
  }
  template <typename Each>
  void list(const std::string& key, Each each, std::size_t most = kMostPorts) const {
    const Json& value = at(key);
    if (!value.is_array() || value.array().size() > most) {
      fail(key, "expected a list of at most " + std::to_string(most));
    }
    for (std::size_t k = 0; k < value.array().size(); ++k) {
      const Part part(value.array()[k], where_ + "." + key + "[" + std::to_string(k) + "]");
      each(part);
      part.nothing_else();
    }
  }
  Part part(const std::string& key) const { return {at(key), where_ + "." + key}; }
  const Json& json() const { return json_; }

  void nothing_else() const {
    for (const auto& member : json_.object()) {
      if (known_.count(member.first) == 0) fail(member.first, "is not known");
    }
  }

 private:
  const Json& json_;
  std::string where_;
  mutable std::set<std::string> known_;
};

template <typename Item>
int index_of(const std::vector<Item>& items, const std::string& name, const Part& part,
             const std::string& key) {
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (items[k].name == name) return static_cast<int>(k);
  }
  part.fail(key, "found \"" + name + "\", which is no name of the robot's");
}

ChannelKind kind_of(const Part& part) {
  const std::string text = part.text("kind");
  if (text == "count") return ChannelKind::count;
  if (text == "switch") return ChannelKind::contact;
  if (text == "value") return ChannelKind::value;
  part.fail("kind", "found \"" + text + "\", expected count, switch or value");
}

Channel channel_from(const Part& part) {
  Channel channel;
  channel.name = part.text("name");
  channel.unit = part.text("unit");
  channel.kind = kind_of(part);
  channel.scale = part.limit("scale", 1.0);
  if (!std::isfinite(channel.scale) || channel.scale == 0.0)
    part.fail("scale", "expected a number that is not 0");
  channel.speed = part.positive_or_none("speed");
  channel.rest = part.positive_or_none("rest");
  return channel;
}

CommandChannel command_from(const Part& part, const Plan& plan) {
  CommandChannel command;
  command.name = part.text("name");
  command.unit = part.text("unit");
  command.limit = part.positive("limit");
  command.slew = part.positive_or_none("slew");
  if (!part.at("hold").is_null()) {
    const Part hold = part.part("hold");
    command.hold.channel = index_of(plan.channels, hold.text("channel"), hold, "channel");
    command.hold.stiffness = hold.number("stiffness", 0.0, 1e9);
    command.hold.damping = hold.number("damping", 0.0, 1e9);
    hold.nothing_else();
  }
  return command;
}

Reach reach_from(const Part& part, const Plan& plan, bool predicted) {
  Reach reach;
  reach.name = part.text("name");
  const Part of = part.part("of");
  for (const auto& [name, factor] : of.json().object()) {
    if (!factor.is_number()) of.fail(name, "expected a number");
    reach.of.push_back({index_of(plan.channels, name, of, name), factor.number()});
  }
  if (reach.of.empty()) part.fail("of", "expected at least one channel");
  reach.from = part.limit("from", -kNone);
  reach.to = part.limit("to", kNone);
  if (!(reach.from < reach.to)) part.fail("to", "expected a number above from");
  if (predicted) reach.deceleration = part.positive_or_none("deceleration");
  return reach;
}

void read_controller(const Part& body, Plan& plan) {
  const Part part = body.part("controller");
  plan.library = part.text("file");
  plan.library_sha256 = part.text("sha256");
  plan.controller = part.text("name");
  plan.controller_version = part.text("version");
  part.list(
      "constants",
      [&](const Part& one) {
        plan.constant_names.push_back(one.text("name"));
        const Json& value = one.at("value");
        if (!value.is_number()) one.fail("value", "expected a number");
        plan.constants.push_back(value.number());
      },
      kMostConstants);
  part.list("log", [&](const Part& one) { plan.log.push_back(one.text("name")); });
  part.nothing_else();
}

void read_ports(const Part& drive, Plan& plan) {
  drive.list("inputs", [&](const Part& part) {
    Plan::Input input;
    input.port = part.text("port");
    const Json& from = part.at("from");
    if (!from.is_array()) part.fail("from", "expected a list of channels");
    input.scale = part.limit("scale", 1.0);
    input.fixed = part.limit("fixed", 0.0);
    if (!std::isfinite(input.scale) || input.scale == 0.0)
      part.fail("scale", "expected a number that is not 0");
    for (const Json& name : from.array()) {
      if (!name.is_string()) part.fail("from", "expected names of channels");
      input.from.push_back(index_of(plan.channels, name.text(), part, "from"));
      if (from.array().size() > 1 &&
          plan.channels[static_cast<std::size_t>(input.from.back())].kind != ChannelKind::contact) {
        part.fail("from", "several channels of one port must be switches");
      }
    }
    plan.inputs.push_back(input);
  });
  drive.list("outputs", [&](const Part& part) {
    plan.outputs.push_back({part.text("port"), index_of(plan.commands, part.text("to"), part, "to")});
  });
}

void read_tolerances(const Part& drive, Plan& plan) {
  const Part packets = drive.part("packets");
  plan.packets.lost_in_succession = packets.whole("lost_in_succession", 1000);
  plan.packets.lost = packets.whole("lost", 1000);
  plan.packets.duplicated = packets.whole("duplicated", 1000);
  plan.packets.reordered = packets.whole("reordered", 1000);
  plan.packets.corrupt = packets.whole("corrupt", 1000);
  packets.nothing_else();
  const Part times = drive.part("times");
  plan.silence = times.number("silence", plan.period, 10.0);
  plan.answer = times.positive("answer");
  plan.late = times.whole("late", 1000);
  plan.controller_time = times.number("controller", 1e-6, 10.0);
  times.nothing_else();
}

}  // namespace

std::vector<std::string> Plan::channel_names() const {
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  return names;
}

std::vector<std::string> Plan::command_names() const {
  std::vector<std::string> names;
  for (const CommandChannel& command : commands) names.push_back(command.name);
  return names;
}

Plan plan_from(const Json& body) {
  const Part whole(body, "body");
  Plan plan;
  plan.title = whole.text("title");
  plan.model = whole.text("model");
  read_controller(whole, plan);
  const Part drive = whole.part("drive");
  plan.robot = drive.text("robot");
  plan.period = drive.number("period", 1e-5, 1.0);
  drive.list("channels", [&](const Part& part) { plan.channels.push_back(channel_from(part)); });
  drive.list("commands", [&](const Part& part) { plan.commands.push_back(command_from(part, plan)); });
  if (plan.channels.empty() || plan.commands.empty()) drive.fail("expected channels and commands");
  read_ports(drive, plan);
  drive.list("workspace", [&](const Part& part) { plan.workspace.push_back(reach_from(part, plan, true)); });
  drive.list("handover", [&](const Part& part) { plan.handover.push_back(reach_from(part, plan, false)); });
  read_tolerances(drive, plan);
  drive.nothing_else();
  return plan;
}

}  // namespace plumbline::driver
