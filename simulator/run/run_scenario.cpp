#include "simulator/run/run_scenario.h"

#include <chrono>
#include <random>
#include <stdexcept>

#include "simulator/trace/error.h"

namespace plumbline::run {
namespace {

constexpr double kStands = 1e-6;  // m: a foot that is put onto the ground may be so deep in it by rounding

/// Keeps what is asked for, and says when it is over.
class Account {
 public:
  Account(const model::Model& model, const Scenario& scenario, const RunOptions& options,
          const SampledRun& sampled)
      : scenario_(scenario),
        options_(options),
        ends_(scenario.ends, sampled.controller()),
        recorder_(model, sampled.controller()) {}

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
    run.end = ends_.look(simulation);
    run.fell = !run.end.empty();
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
