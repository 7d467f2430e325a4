#include "validation/hopping/hop_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "simulator/integrate/energy_account.h"
#include "simulator/trace/error.h"
#include "validation/hopping/hop_counter.h"
#include "validation/hopping/hop_recorder.h"
#include "validation/hopping/hop_simulation.h"
#include "validation/hopping/hop_watchdog.h"

namespace plumbline::validation {
namespace {

/// The larger |c(q)| of both legs (Park et al. equation 23), rad of motor.
double stretch(const model::Plant& plant, const std::string& ratio, const Eigen::VectorXd& x) {
  double most = 0.0;
  for (const char* side : {"_left", "_right"}) {
    if (plant.model().find_ratio(ratio + side) != nullptr) {
      const effects::Motion motion = plant.motion_at(effects::Place::ratio, ratio + side, x.data());
      most = std::max(most, std::abs(motion.position));
    }
  }
  return most;
}

/// Above the floor, whatever stands there: a platform that reaches a foot is refused.
Eigen::VectorXd place(const model::Model& model, const controllers::HoppingConfig& config,
                      const HopStart& start, const HopOptions& options, HopSimulation& simulation) {
  model::Plant flat(model, {}, contact::Terrain(options.terrain.floor()));
  Eigen::VectorXd state = start_state(flat, config, start);
  const std::vector<model::Touch> touches = simulation.plant().touches(state.data());
  for (std::size_t f = 0; f < touches.size(); ++f) {
    if (touches[f].depth > 0.0) {
      throw InputError({model.file, 0, "platform"},
                       "the " + model.feet[f].name + " foot " + std::to_string(touches[f].depth) +
                           " m inside the terrain at the start",
                       "terrain below the feet; start higher or elsewhere");
    }
  }
  return state;
}

/// One sample's record; true when the run is over.
class Account {
 public:
  Account(const model::Model& model, const controllers::HoppingConfig& config, const HopOptions& options,
          HopRun& run)
      : options_(options),
        run_(run),
        watch_(model, config),
        counter_(watch_, config, run.hops),
        watchdog_(watch_),
        recorder_(model) {}

  bool over(HopSimulation& s) {
    const Eigen::VectorXd x = s.state();
    if (options_.energy) {
      keep_energy(s, x);
    }
    run_.time = s.time();
    counter_.feet(run_.time, s.touches());
    counter_.load(s.loop().torques(), stretch(s.plant(), "leg_angle", x), stretch(s.plant(), "leg_shape", x));
    counter_.sample(run_.time, s.outputs(), s.loop().controller());
    if (options_.trace) {
      recorder_.row(run_.time, s.outputs(), s.command(), s.touches(), s.loop().controller());
    }
    run_.end = watchdog_.look(s);
    run_.fell = !run_.end.empty();
    return run_.fell || static_cast<long>(run_.hops.size()) >= options_.hops || run_.time >= options_.longest;
  }

  void finish(const HopSimulation& simulation) {
    run_.time_at_limit = counter_.time_at_limit();
    run_.summary = simulation.summary();
    if (options_.trace) {
      run_.trace = recorder_.table();
    }
  }

 private:
  void keep_energy(HopSimulation& s, const Eigen::VectorXd& x) {
    const double stored = s.plant().energetics(x.data(), s.command().data()).stored;
    s.time() > 0.0 ? energy_.add(stored) : energy_.start(stored);
    run_.energy_error = energy_.error(s.work(), s.dissipated());
    run_.energy_exchanged = energy_.exchanged(s.work(), s.dissipated());
  }

  const HopOptions& options_;
  HopRun& run_;
  HipWatch watch_;
  HopCounter counter_;
  HopWatchdog watchdog_;
  HopRecorder recorder_;
  integrate::EnergyAccount energy_;
};

void go(HopSimulation& simulation, const HopOptions& options, Account& account) {
  for (;;) {
    if (options.stop != nullptr && options.stop->raised) {
      throw Stopped();
    }
    simulation.sample();
    if (account.over(simulation)) {
      return;
    }
    simulation.advance();
  }
}

}  // namespace

HopOptions::HopOptions() {
  integrator.method = integrate::Method::rosenbrock;
  integrator.weight = integrate::Weight::reach;
  integrator.relative_tolerance = 1e-5;
  integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-7);
  integrator.max_steps = 2000;  // in a sample; more is no progress
}

HopRun hop(const model::Model& model, const controllers::HoppingConfig& config, const HopStart& start,
           const HopOptions& options) {
  HopSimulation simulation(model, config, options.integrator, options.terrain, options.energy);
  simulation.start(place(model, config, start, options, simulation));
  HopRun run;
  Account account(model, config, options, run);
  const auto begin = std::chrono::steady_clock::now();
  try {
    go(simulation, options, account);
  } catch (const Stopped&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    run.fell = true;
    run.end = error.what();
    if (!run.end.empty() && run.end.back() == '.') {
      run.end.pop_back();  // sentences go on behind it
    }
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  account.finish(simulation);
  return run;
}

}  // namespace plumbline::validation
