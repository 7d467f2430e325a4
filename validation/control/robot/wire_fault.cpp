#include "validation/control/robot/wire_fault.h"

#include <cmath>
#include <cstdlib>

#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

using Kind = WireFault::Kind;

struct Known {
  const char* name;
  Kind kind;
  bool of_sensor;
  double amount;  // unless stated
};
constexpr Known kKnown[] = {{"corrupt", Kind::corrupt, false, 10},
                            {"lost", Kind::lost, false, 10},
                            {"duplicated", Kind::duplicated, false, 10},
                            {"reordered", Kind::reordered, false, 10},
                            {"silence", Kind::silence, false, 1.0},
                            {"frozen", Kind::frozen, true, 0},
                            {"jump", Kind::jump, true, 1000},
                            {"drift", Kind::drift, true, 1000},
                            {"layout", Kind::layout, false, 0},
                            {"emergency-stop", Kind::emergency_stop, false, 0},
                            {"power", Kind::power, false, 0}};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  while (true) {
    const std::size_t end = text.find(at, from);
    parts.push_back(text.substr(from, end - from));
    if (end == std::string::npos) return parts;
    from = end + 1;
  }
}

double number_of(const std::string& part, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(part.c_str(), &end);
  if (part.empty() || *end != '\0' || !std::isfinite(value)) {
    throw InputError({"", 0, "--fault " + text}, "\"" + part + "\"", "a number");
  }
  return value;
}

int channel_of(const std::string& name, const model::Model& model) {
  const int sensor = model.sensor_index(name);
  if (sensor >= 0) {
    return sensor;
  }
  std::vector<std::string> known;
  for (const model::Sensor& one : model.sensors) {
    known.push_back(one.name);
  }
  throw InputError("--fault: no sensor \"" + name + "\"" + nearest_names(name, known));
}

}  // namespace

WireFault parse_fault(const std::string& text, const model::Model& model) {
  const std::size_t at = text.find('@');
  const std::string name = text.substr(0, at);
  std::vector<std::string> names;
  const Known* known = nullptr;
  for (const Known& one : kKnown) {
    names.emplace_back(one.name);
    known = name == one.name ? &one : known;
  }
  if (known == nullptr) {
    throw InputError("--fault: unknown kind \"" + name + "\"" + nearest_names(name, names));
  }
  if (at == std::string::npos) {
    throw InputError({"", 0, "--fault " + text}, "no time", "KIND@SECONDS");
  }
  const std::vector<std::string> parts = split(text.substr(at + 1), ':');
  WireFault fault;
  fault.text = text;
  fault.kind = known->kind;
  fault.time = number_of(parts[0], text);
  fault.amount = known->amount;
  std::size_t next = 1;
  if (known->of_sensor) {
    if (parts.size() < 2) {
      throw InputError({"", 0, "--fault " + text}, "no sensor", "KIND@SECONDS:SENSOR");
    }
    fault.channel = channel_of(parts[next++], model);
  }
  if (parts.size() > next) {
    fault.amount = number_of(parts[next++], text);
  }
  if (parts.size() > next) {
    throw InputError({"", 0, "--fault " + text}, "more than expected", "KIND@SECONDS[:SENSOR][:AMOUNT]");
  }
  return fault;
}

void FaultInjector::change(driver::Packet& packet, double since) {
  const auto channel = static_cast<std::size_t>(std::max(fault_.channel, 0));
  switch (fault_.kind) {
    case Kind::frozen:
      packet.values[channel] = frozen_;
      break;
    case Kind::jump:
      packet.set_whole(channel, packet.whole(channel) + static_cast<std::int64_t>(fault_.amount));
      break;
    case Kind::drift:
      packet.set_whole(channel, packet.whole(channel) + std::llround(fault_.amount * since));
      break;
    case Kind::layout:
      packet.layout ^= 1U;
      break;
    case Kind::emergency_stop:
      packet.flags |= driver::robot_flag::emergency_stop;
      break;
    default:
      break;
  }
}

std::vector<std::vector<std::uint8_t>> FaultInjector::datagrams(driver::Packet packet, double time) {
  const bool on = fault_.kind != Kind::none && time >= fault_.time;
  if (on && begun_ < 0) {
    begun_ = packet.sequence;
    left_ = static_cast<int>(fault_.amount);
    frozen_ = packet.values[static_cast<std::size_t>(std::max(fault_.channel, 0))];
  }
  if (on) {
    change(packet, time - fault_.time);
  }
  std::vector<std::uint8_t> bytes(driver::Packet::largest);
  bytes.resize(driver::encode(packet, bytes.data()));
  if (!on || left_ <= 0) {
    return {bytes};
  }
  switch (fault_.kind) {
    case Kind::corrupt: {
      --left_;
      const std::uint64_t bit = random_() % (8 * bytes.size());
      bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
      return {bytes};
    }
    case Kind::lost:
      --left_;
      return {};
    case Kind::silence:
      left_ = time - fault_.time < fault_.amount ? 1 : 0;
      return {};
    case Kind::duplicated:
      --left_;
      return {bytes, bytes};
    case Kind::reordered: {
      if (kept_.empty()) {
        kept_ = bytes;
        return {};
      }
      --left_;
      std::vector<std::vector<std::uint8_t>> both{bytes, kept_};
      kept_.clear();
      return both;
    }
    default:
      return {bytes};
  }
}

}  // namespace plumbline::validation
