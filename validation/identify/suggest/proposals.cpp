#include "validation/identify/suggest/proposals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

/// The commands of one motor: YAML items of a list, for a reach and a duration.
struct Family {
  const char* name;
  std::string (*write)(double reach, double duration, double shift, const std::string& unit);
};

std::string chirp(double from, double to, double first, double last, const std::string& unit) {
  return fmt::format(
      "    - {{kind: stepped_chirp, from: {} Hz, to: {} Hz, steps: 12, first_amplitude: {:.6g}, "
      "last_amplitude: {:.6g}, unit: {}}}\n",
      from, to, first, last, unit);
}

std::string slow_chirp(double reach, double /*duration*/, double shift, const std::string& unit) {
  const double factor = 1.0 + 0.3 * shift;
  return chirp(0.5 * factor, 6.0 * factor, 0.05 * reach, 0.8 * reach, unit);
}

std::string fast_chirp(double reach, double /*duration*/, double shift, const std::string& unit) {
  const double factor = 1.0 + 0.3 * shift;
  return chirp(3.0 * factor, 40.0 * factor, 0.3 * reach, reach, unit);
}

/// A smooth push over many frequencies; `shift` keeps the motors apart.
std::string multisine(double reach, double /*duration*/, double shift, const std::string& unit) {
  const double f = 1.0 + 0.37 * shift;
  return fmt::format(
      "    - {{kind: multisine, frequencies: [{:.3g} Hz, {:.3g} Hz, {:.3g} Hz, {:.3g} Hz], amplitudes: "
      "[{:.6g}, {:.6g}, {:.6g}, {:.6g}], phases: [0 deg, 110 deg, 205 deg, 320 deg], unit: {}}}\n",
      0.9 * f, 2.3 * f, 5.7 * f, 13.1 * f, 0.05 * reach, 0.12 * reach, 0.28 * reach, 0.55 * reach, unit);
}

std::string steps(double reach, double duration, double shift, const std::string& unit) {
  const auto at = [&](double share) { return (share + 0.03 * shift) * duration; };
  return fmt::format(
      "    - {{kind: steps, times: [{:.3f} s, {:.3f} s, {:.3f} s, {:.3f} s, {:.3f} s], levels: [{:.6g}, "
      "{:.6g}, {:.6g}, {:.6g}, 0], unit: {}}}\n",
      at(0.05), at(0.25), at(0.45), at(0.65), at(0.85), 0.3 * reach, -0.3 * reach, 0.15 * reach,
      -0.15 * reach, unit);
}

std::string pulses(double reach, double duration, double shift, const std::string& unit) {
  const auto train = [&](double from, double level) {
    std::string times;
    for (int i = 0; i < 4; ++i) {
      times += fmt::format("{}{:.3f} s", i == 0 ? "" : ", ", (from + 0.22 * i + 0.02 * shift) * duration);
    }
    return fmt::format("    - {{kind: pulses, times: [{}], width: 0.03 s, level: {:.6g}, unit: {}}}\n", times,
                       level, unit);
  };
  return train(0.05, 0.9 * reach) + train(0.16, -0.9 * reach);
}

std::string ramp(double reach, double /*duration*/, double shift, const std::string& unit) {
  const double sign = shift > 0.0 ? -1.0 : 1.0;
  return fmt::format("    - {{kind: ramp, start: {:.6g}, end: {:.6g}, unit: {}}}\n", -0.2 * sign * reach,
                     0.2 * sign * reach, unit);
}

std::string noise(double reach, double /*duration*/, double shift, const std::string& unit) {
  return fmt::format("    - {{kind: filtered_noise, deviation: {:.6g}, corner: 8 Hz, seed: {}, unit: {}}}\n",
                     0.3 * reach, 1 + static_cast<int>(shift), unit);
}

constexpr Family kFamilies[] = {{"slow chirp", slow_chirp},
                                {"fast chirp", fast_chirp},
                                {"multisine", multisine},
                                {"steps", steps},
                                {"pulses", pulses},
                                {"ramp", ramp},
                                {"noise", noise}};

/// Everything but the shapes of the motors that move.
std::string head(const model::Model& model, const Envelope& envelope, const std::string& title) {
  std::string text = fmt::format(
      "plumbline: experiment/1\ntitle: \"{}\"\nrole: train\nduration: {{value: {:.6g}, unit: s}}\n"
      "sample_period: {{value: {:.6g}, unit: s}}\n",
      title, envelope.duration, envelope.period);
  if (!envelope.start.empty()) {
    text += "start:\n";
    for (const Start& start : envelope.start) {
      text += fmt::format("  {}: {{value: {:.6g}, unit: {}}}\n", start.coordinate, start.position,
                          model::position_unit(model::is_angular(model, start.coordinate)));
    }
  }
  if (!envelope.locked.empty()) {
    text += fmt::format("locked: [{}]\n", fmt::join(envelope.locked, ", "));
  }
  return text + "commands:\n";
}

void widen(Envelope& envelope, const Trial& trial) {
  for (const Command& command : trial.commands) {
    const double mean = command.values.mean();
    const double reach = (command.values.array() - mean).abs().maxCoeff();
    const auto known = std::find_if(envelope.motors.begin(), envelope.motors.end(),
                                    [&](const Envelope::Motor& one) { return one.name == command.motor; });
    if (known == envelope.motors.end()) {
      envelope.motors.push_back({command.motor, command.unit, mean, reach});
    } else if (reach > known->reach) {
      known->mean = mean;
      known->reach = reach;
    }
  }
  for (const Measured& measured : trial.measured) {
    const double low = measured.values.minCoeff();
    const double high = measured.values.maxCoeff();
    const auto known =
        std::find_if(envelope.channels.begin(), envelope.channels.end(),
                     [&](const Envelope::Channel& one) { return one.sensor == measured.sensor; });
    if (known == envelope.channels.end()) {
      envelope.channels.push_back({measured.sensor, low, high});
    } else {
      known->low = std::min(known->low, low);
      known->high = std::max(known->high, high);
    }
  }
}

}  // namespace

Envelope envelope_of(const std::vector<Trial>& trials, const std::vector<Start>& start) {
  Envelope envelope;
  envelope.start = start;
  for (const Trial& trial : trials) {
    widen(envelope, trial);
    envelope.period = trial.period;
    envelope.duration = std::max(envelope.duration, trial.period * static_cast<double>(trial.samples()));
  }
  const bool moves = std::any_of(envelope.motors.begin(), envelope.motors.end(),
                                 [](const Envelope::Motor& motor) { return motor.reach > 0.0; });
  if (!moves) {
    throw InputError("found no trial in which a command changes, expected at least one motor that is driven");
  }
  // Longer does not tell more of which experiment is better, only takes longer.
  constexpr double kLongest = 4.0;
  const double periods = std::floor(std::min(envelope.duration, kLongest) / envelope.period + 0.5);
  envelope.duration = periods * envelope.period;
  for (const model::Lock& lock : trials.front().locks) {
    const bool always = std::all_of(trials.begin(), trials.end(), [&](const Trial& trial) {
      return std::any_of(trial.locks.begin(), trial.locks.end(),
                         [&](const model::Lock& other) { return other.at == lock.at; });
    });
    if (always) {
      envelope.locked.push_back(lock.at);
    }
  }
  return envelope;
}

std::vector<Idea> ideas_for(const Envelope& envelope) {
  std::vector<std::size_t> together;
  for (std::size_t m = 0; m < envelope.motors.size(); ++m) {
    if (envelope.motors[m].reach > 0.0) {
      together.push_back(m);
    }
  }
  std::vector<Idea> ideas;
  for (std::size_t family = 0; family < std::size(kFamilies); ++family) {
    const std::string shape = std::string(": ") + kFamilies[family].name;
    for (const std::size_t m : together) {
      ideas.push_back({envelope.motors[m].name + shape, family, {m}});
    }
    if (together.size() > 1) {
      ideas.push_back({"all motors" + shape, family, together});
    }
  }
  return ideas;
}

Proposal propose(const model::Model& model, const Envelope& envelope, const Idea& idea, double share) {
  Proposal proposal{idea.name, head(model, envelope, idea.name), {}};
  for (std::size_t m = 0; m < envelope.motors.size(); ++m) {
    const Envelope::Motor& motor = envelope.motors[m];
    proposal.text += fmt::format("  {}:\n    - {{kind: constant, value: {:.6g}, unit: {}}}\n", motor.name,
                                 motor.mean, motor.unit);
    const auto place = std::find(idea.moving.begin(), idea.moving.end(), m);
    if (place != idea.moving.end()) {
      proposal.text +=
          kFamilies[idea.family].write(share * motor.reach, envelope.duration,
                                       static_cast<double>(place - idea.moving.begin()), motor.unit);
    }
  }
  proposal.experiment = parse_experiment(proposal.text, proposal.name, model);
  return proposal;
}

bool stays_within(const Envelope& envelope, const Trial& trial) {
  constexpr double kSpare = 1.0;
  for (const Measured& measured : trial.measured) {
    for (const Envelope::Channel& channel : envelope.channels) {
      const double spare = kSpare * (channel.high - channel.low);
      if (channel.sensor == measured.sensor && (measured.values.minCoeff() < channel.low - spare ||
                                                measured.values.maxCoeff() > channel.high + spare)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace plumbline::validation
