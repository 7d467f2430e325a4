#include "validation/hopping/hop_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "simulator/integrate/plant_ode.h"
#include "simulator/trace/error.h"
#include "validation/hopping/hop_counter.h"
#include "validation/hopping/hop_recorder.h"
#include "validation/hopping/hopping_loop.h"

namespace plumbline::validation {
namespace {

constexpr double kLowestHip = -0.5;    // m, against a level boom at 1 m
constexpr double kLargestTorso = 1.0;  // rad
constexpr double kLongestPhase = 1.5;  // s

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

std::string fall(const HipWatch& watch, const Eigen::VectorXd& y, const controllers::Hopping& controller) {
  if (!y.allFinite()) {
    return "the state is not finite";
  }
  if (watch.height(y) < kLowestHip) {
    return "fell: the hip is down";
  }
  if (std::abs(watch.torso(y)) > kLargestTorso) {
    return std::string("fell ") + (watch.torso(y) > 0.0 ? "backward" : "forward") +
           ": the torso has turned over";
  }
  if (controller.time_in_phase() > kLongestPhase) {
    return std::string("stays in phase ") + to_string(controller.phase());
  }
  return "";
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
  model::Plant plant(model, {});
  HoppingLoop loop(model, config);
  const HipWatch watch(model, config);
  HopRun run;
  HopCounter counter(watch, run.hops);
  HopRecorder recorder(model);
  integrate::PlantOde ode(plant, false, false);
  integrate::Integrator integrator(ode, options.integrator);
  integrator.start(0.0, start_state(plant, config, start));
  Eigen::VectorXd y(plant.sensors());
  Eigen::VectorXd command = Eigen::VectorXd::Zero(plant.motors());
  const auto begin = std::chrono::steady_clock::now();
  try {
    for (long k = 0;; ++k) {
      if (options.stop != nullptr && options.stop->raised) {
        throw Stopped();
      }
      run.time = static_cast<double>(k) * config.period;
      const Eigen::VectorXd& x = integrator.state();
      plant.outputs(x.data(), y.data());
      const std::vector<model::Touch> touches = plant.touches(x.data());
      loop.command(y, touches, command.data());
      counter.feet(run.time, touches);
      counter.load(loop.torques(), stretch(plant, "leg_angle", x), stretch(plant, "leg_shape", x));
      counter.sample(run.time, y, loop.controller());
      if (options.trace) {
        recorder.row(run.time, y, command, touches, loop.controller());
      }
      run.end = fall(watch, y, loop.controller());
      run.fell = !run.end.empty();
      if (run.fell || static_cast<long>(run.hops.size()) >= options.hops || run.time >= options.longest) {
        break;
      }
      std::copy(command.data(), command.data() + command.size(), ode.command());
      integrator.input_changed(true);
      integrator.advance(static_cast<double>(k + 1) * config.period);
    }
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
  run.summary = integrator.summary();
  if (options.trace) {
    run.trace = recorder.table();
  }
  return run;
}

}  // namespace plumbline::validation
