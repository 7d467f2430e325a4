#include "tests/driver/fuzz_targets.h"

#include <dlfcn.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "controllers/driver/certificate.h"
#include "controllers/driver/packet.h"
#include "controllers/driver/plan.h"
#include "controllers/driver/signature.h"
#include "controllers/driver/supervisor.h"
#include "tests/driver/small_body.h"
#include "tests/driver/small_plan.h"

namespace plumbline::driver {
namespace {

void hold(bool condition, const std::string& what) {
  if (!condition) throw std::logic_error(what);
}

void one_line(const std::string& text) {
  hold(!text.empty() && text.find('\n') == std::string::npos, "message: " + text);
}

}  // namespace

FuzzTargets::FuzzTargets(std::uint64_t seed, const std::string& controller, const std::string& certificate)
    : random_(seed), controller_(controller) {
  text_ = signed_certificate(small_body(), new_key().private_pem);
  body_text_ = canonical_json(small_body());
  Packet packet;
  packet.count = 3;
  packet_bytes_.resize(Packet::largest);
  packet_bytes_.resize(encode(packet, reinterpret_cast<std::uint8_t*>(packet_bytes_.data())));
  library_ = dlopen(controller.c_str(), RTLD_NOW | RTLD_LOCAL);
  hold(library_ != nullptr, controller + ": cannot be loaded");
  if (!certificate.empty()) good_constants_ = plan_from(read_certificate(certificate).body).constants;
}

double FuzzTargets::any_number() {
  switch (random_() % 6) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return random_() % 2 == 0 ? kNone : -kNone;
    case 2:
      return static_cast<double>(random_() % 7) - 3.0;
    case 3: {
      double value = 0.0;
      const std::uint64_t bits = random_();
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
    default:
      return std::normal_distribution<double>(0.0, 10.0)(random_);
  }
}

void FuzzTargets::mutate(std::string& text) {
  const std::uint64_t changes = 1 + random_() % 4;
  for (std::uint64_t k = 0; k < changes && !text.empty(); ++k) {
    const std::size_t at = random_() % text.size();
    switch (random_() % 5) {
      case 0:
        text[at] = static_cast<char>(random_());
        break;
      case 1:
        text.erase(at, 1 + random_() % 8);
        break;
      case 2:
        text.insert(at, 1, "{}[]\",:0123456789.eE+-\\ntfu"[random_() % 26]);
        break;
      case 3:
        text.insert(at, text.substr(random_() % text.size(), random_() % 32));
        break;
      default:
        text[at] = static_cast<char>(text[at] ^ (1 << (random_() % 8)));
        break;
    }
  }
}

void FuzzTargets::packet() {
  std::string bytes = packet_bytes_;
  if (random_() % 2 == 0) {
    mutate(bytes);
  } else {
    bytes.resize(random_() % (Packet::largest + 8));
    for (char& c : bytes) c = static_cast<char>(random_());
  }
  Packet packet;
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (decode(data, bytes.size(), packet)) {
    std::uint8_t again[Packet::largest];
    const std::size_t size = encode(packet, again);
    hold(size == bytes.size() && std::memcmp(again, data, size) == 0,
         "a packet that is not what it was read from");
  }
}

void FuzzTargets::certificate() {
  std::string text = text_;
  mutate(text);
  if (text == text_) return;
  try {
    parse_certificate(text, "x");
  } catch (const DriverError& error) {
    one_line(error.what());
    return;
  }
  hold(false, "a changed certificate was accepted");
}

void FuzzTargets::body() {
  std::string text = body_text_;
  mutate(text);
  try {
    const Plan plan = plan_from(parse_json(text));
    hold(plan.period > 0.0 && !plan.channels.empty() && plan.silence > 0.0, "a plan that cannot be driven");
  } catch (const DriverError& error) {
    one_line(error.what());
  }
}

std::vector<double> FuzzTargets::some_constants(const plumbline_controller_api& api) {
  std::vector<double> constants(api.constant_count);
  if (!good_constants_.empty() && random_() % 8 != 0) {
    constants = good_constants_;
    for (std::uint64_t k = 1 + random_() % 4; k > 0; --k) {
      double& one = constants[random_() % constants.size()];
      one = random_() % 2 == 0 ? any_number() : one * std::normal_distribution<double>(0.0, 2.0)(random_);
    }
    return constants;
  }
  for (double& value : constants) value = any_number();
  if (random_() % 2 == 0) {  // within the ports' limits: then the controller itself must look
    for (std::size_t k = 0; k < constants.size(); ++k) {
      const double lower = std::max(api.constants[k].lower, -1e3),
                   upper = std::min(api.constants[k].upper, 1e3);
      constants[k] = std::uniform_real_distribution<double>(lower, upper)(random_);
      if (random_() % 2 == 0) constants[k] = std::round(constants[k]);
    }
  }
  return constants;
}

void FuzzTargets::constants() {
  const auto entry =
      reinterpret_cast<decltype(&plumbline_controller)>(dlsym(library_, PLUMBLINE_CONTROLLER_SYMBOL));
  const plumbline_controller_api& api = *entry();
  hold(good_constants_.empty() || good_constants_.size() == api.constant_count,
       "the certificate is of another controller");
  const std::vector<double> constants = some_constants(api), scales(api.input_count, 1e-3);
  char message[256] = "";
  const plumbline_setup setup = {1e-3, constants.data(), scales.data()};
  bool within = true;
  for (std::size_t k = 0; k < constants.size(); ++k) {
    within = within && constants[k] >= api.constants[k].lower && constants[k] <= api.constants[k].upper;
  }
  if (!within) return;  // a host refuses these before
  void* const self = api.create(&setup, message, sizeof message);
  if (self == nullptr) {
    one_line(message);
    return;
  }
  ++created_;
  std::vector<double> inputs(api.input_count), outputs(api.output_count), log(api.log_count);
  for (int step = 0; step < 8; ++step) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      inputs[k] = api.inputs[k].kind == PLUMBLINE_SWITCH
                      ? static_cast<double>(random_() % 2)
                      : std::round(std::normal_distribution<double>(0, 1e4)(random_));
    }
    if (api.step(self, inputs.data(), outputs.data(), log.data()) != 0) break;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      hold(outputs[k] >= api.outputs[k].lower && outputs[k] <= api.outputs[k].upper,
           std::string(api.outputs[k].name) + " beyond the controller's own limits");
    }
  }
  api.destroy(self);
}

void FuzzTargets::supervisor() {
  const Plan plan = small_plan();
  Supervisor supervisor(plan);
  double last = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double channels[] = {any_number(), any_number(), any_number()};
    supervisor.sensors(channels, static_cast<std::uint32_t>(random_() % 5), true);
    if (random_() % 3 == 0) supervisor.reset();
    if (!supervisor.stopped()) last = random_() % 2 == 0 ? any_number() : last;
    double command = last;
    supervisor.command(&command);
    hold(std::isfinite(command) && std::abs(command) <= plan.commands[0].limit, "a command beyond its limit");
    hold(!supervisor.stopped() || command == 0.0, "a command from a stopped supervisor");
    last = command;
  }
}

void FuzzTargets::run(std::uint64_t count) {
  for (std::uint64_t k = 0; k < count; ++k) {
    switch (k % 8) {
      case 0:
        certificate();
        break;
      case 1:
      case 2:
        body();
        break;
      case 3:
        constants();
        break;
      case 4:
        supervisor();
        break;
      default:
        packet();
        break;
    }
  }
}

void FuzzTargets::run_only(const std::string& target, std::uint64_t count) {
  using Target = void (FuzzTargets::*)();
  const std::map<std::string, Target> targets = {{"packet", &FuzzTargets::packet},
                                                 {"certificate", &FuzzTargets::certificate},
                                                 {"body", &FuzzTargets::body},
                                                 {"constants", &FuzzTargets::constants},
                                                 {"supervisor", &FuzzTargets::supervisor}};
  const auto found = targets.find(target);
  if (found == targets.end()) throw std::invalid_argument(target + ": no target of that name");
  for (std::uint64_t k = 0; k < count; ++k) (this->*found->second)();
}

}  // namespace plumbline::driver
