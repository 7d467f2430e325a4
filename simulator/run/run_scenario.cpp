#include "simulator/run/run_scenario.h"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <random>
#include <stdexcept>

#include "simulator/trace/error.h"

namespace plumbline::run {
namespace {

constexpr double kStands = 1e-6;  // m: a foot that is put onto the ground may be so deep in it by rounding

constexpr double kHeld = 0.05;  // s: a command that stays at its largest for so long is at a limit

/// What is said behind a fall: of each foot since when it has been on the ground or in the air (one that
/// missed its touchdown is in the air for long), and of each motor whether its command has stood at its
/// largest.
class LastWords {
 public:
  explicit LastWords(const model::Model& model)
      : model_(model), feet_(model.feet.size()), motors_(model.motors.size()) {}

  void follow(double now, const std::vector<model::Touch>& touches, const Eigen::VectorXd& command) {
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      const bool down = touches[f].depth > 0.0;
      if (!known_ || down != feet_[f].down) {
        feet_[f] = {down, now};
      }
    }
    known_ = true;
    for (std::size_t m = 0; m < motors_.size(); ++m) {
      const double size = std::abs(command[static_cast<Eigen::Index>(m)]);
      Motor& motor = motors_[m];
      if (size > motor.largest || size < motor.largest || motor.since < 0.0) {
        motor.since = size > 0.0 && size >= motor.largest ? now : -1.0;
      }
      motor.largest = std::max(motor.largest, size);
    }
  }

  std::string at(double now) const {
    std::string words;
    const auto add = [&](const std::string& more) { words += (words.empty() ? "" : ", ") + more; };
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      add(fmt::format("foot {} {} since {:.3f} s", model_.feet[f].name,
                      feet_[f].down ? "on the ground" : "in the air", feet_[f].since));
    }
    for (std::size_t m = 0; m < motors_.size(); ++m) {
      if (motors_[m].since >= 0.0 && now - motors_[m].since > kHeld) {
        add(fmt::format("{} at its largest torque, {:.3g} {}, since {:.3f} s", model_.motors[m].name,
                        motors_[m].largest, model_.motors[m].command_unit, motors_[m].since));
      }
    }
    return words.empty() ? "" : " (" + words + ")";
  }

 private:
  struct Foot {
    bool down = false;
    double since = 0.0;
  };
  struct Motor {
    double largest = 0.0, since = -1.0;  // since: -1 while the command is below its largest
  };
  const model::Model& model_;
  bool known_ = false;
  std::vector<Foot> feet_;
  std::vector<Motor> motors_;
};

/// Keeps what is asked for, and says when it is over.
class Account {
 public:
  Account(const model::Model& model, const Scenario& scenario, const RunOptions& options,
          const SampledRun& sampled)
      : scenario_(scenario),
        options_(options),
        ends_(scenario.ends, sampled.controller()),
        recorder_(model, sampled.controller()),
        last_words_(model) {}

  bool over(SampledRun& sampled, RunRecord& run) {
    const Simulation& simulation = sampled.simulation();
    run.time = simulation.time();
    if (options_.energy) {
      run.energy_error = simulation.energy_error();
      run.energy_exchanged = simulation.energy_exchanged();
    }
    if (options_.trace) {
      recorder_.row(simulation, sampled.sensed(), sampled.command());
    }
    const bool ended = options_.watch && options_.watch(sampled);
    last_words_.follow(run.time, simulation.touches(), sampled.command());
    run.end = ends_.look(simulation);
    run.fell = !run.end.empty();
    if (run.fell) {
      run.end += last_words_.at(run.time);
    }
    return ended || run.fell || run.time >= scenario_.longest;
  }

  void finish(const SampledRun& sampled, RunRecord& run) const {
    run.summary = sampled.simulation().summary();
    run.fault = sampled.controller() == nullptr ? 0 : sampled.controller()->fault();
    if (options_.trace) {
      run.trace = recorder_.trace();
      run.record = recorder_.record();
    }
  }

 private:
  const Scenario& scenario_;
  const RunOptions& options_;
  EndWatch ends_;
  Recorder recorder_;
  LastWords last_words_;
};

/// False where the integrator finds no way on; `run` then says so.
bool advance(SampledRun& sampled, RunRecord& run) {
  try {
    sampled.advance();
    return true;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    run.fell = true;
    run.end = error.what();
    if (!run.end.empty() && run.end.back() == '.') {
      run.end.pop_back();  // sentences go on behind it
    }
    return false;
  }
}

}  // namespace

Eigen::VectorXd state_at_start(const model::Model& model, const Scenario& scenario) {
  model::Plant flat(model, {}, contact::Terrain(scenario.terrain.floor()));
  Eigen::VectorXd state;
  try {
    state = start_state(flat, scenario.start);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(scenario.file + ": " + error.what());
  }
  if (scenario.terrain.platforms().empty()) {
    return state;
  }
  model::Plant there(model, {}, scenario.terrain);
  const std::vector<model::Touch> touches = there.touches(state.data());
  for (std::size_t f = 0; f < touches.size(); ++f) {
    if (touches[f].depth > kStands) {
      throw InputError({scenario.file, 0, "terrain"},
                       "the " + model.feet[f].name + " foot " + std::to_string(touches[f].depth) +
                           " m inside the terrain at the start",
                       "terrain below the feet; start higher or elsewhere");
    }
  }
  return state;
}

std::vector<Start> draw_starts(const Scenario& scenario, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Start> starts(static_cast<std::size_t>(count), scenario.start);
  for (Start& start : starts) {
    for (const Drawn& drawn : scenario.drawn) {
      const double value = std::uniform_real_distribution<double>(drawn.from, drawn.to)(random) / drawn.times;
      if (drawn.of == Drawn::Of::clearance) {
        start.clearance = value + (drawn.added ? start.clearance : 0.0);
        continue;
      }
      const bool position = drawn.of == Drawn::Of::position;
      double* known = position ? start.position(drawn.name) : start.velocity(drawn.name);
      if (known == nullptr) {
        (position ? start.positions : start.velocities).emplace_back(drawn.name, value);
      } else {
        *known = value + (drawn.added ? *known : 0.0);
      }
    }
  }
  return starts;
}

RunRecord run_scenario(const model::Model& model, const Scenario& scenario, const ControllerSetup* controller,
                       const RunOptions& options) {
  SampledRun sampled(model, scenario.terrain, controller, options);
  sampled.start(state_at_start(model, scenario));
  RunRecord run;
  Account account(model, scenario, options, sampled);
  const auto begin = std::chrono::steady_clock::now();
  for (;;) {
    sampled.sample();
    if (account.over(sampled, run) || !advance(sampled, run)) {
      break;
    }
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  account.finish(sampled, run);
  return run;
}

}  // namespace plumbline::run
