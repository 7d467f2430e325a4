#include "validation/control/certify/lasting.h"

#include <cmath>
#include <random>

#include "controllers/driver/supervisor.h"
#include "simulator/run/ends.h"
#include "simulator/run/run_scenario.h"
#include "simulator/run/sampled_run.h"

namespace plumbline::validation {
namespace {

using driver::Json;

/// Keeps the extremes of what passes between robot and driver.
class Watch {
 public:
  explicit Watch(const driver::Plan& plan)
      : plan_(plan), supervisor_(plan), channels_(static_cast<Eigen::Index>(plan.channels.size())) {
    extremes_.rate = extremes_.rest = rested_ = Eigen::VectorXd::Zero(channels_.size());
    extremes_.command = extremes_.slew = last_command_ =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(plan.commands.size()));
    extremes_.margin = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(plan.workspace.size()), 1.0);
  }

  void sensors(const run::Sensed& sensed) {
    const Eigen::Index sensors = sensed.readings.size();
    Eigen::VectorXd now(channels_.size());
    for (Eigen::Index k = 0; k < sensors; ++k) {
      const bool counts = plan_.channels[static_cast<std::size_t>(k)].kind == driver::ChannelKind::count;
      now[k] = counts ? sensed.counts[k] : sensed.readings[k];
    }
    now.tail(sensed.switches.size()) = sensed.switches;
    if (known_) {
      for (Eigen::Index k = 0; k < now.size(); ++k) {
        const driver::Channel& channel = plan_.channels[static_cast<std::size_t>(k)];
        const double change = std::abs((now[k] - channels_[k]) * channel.scale);
        extremes_.rate[k] = std::max(extremes_.rate[k], change / plan_.period);
        rested_[k] = change == 0.0 ? rested_[k] + plan_.period : 0.0;
        extremes_.rest[k] = std::max(extremes_.rest[k], rested_[k]);
      }
    }
    channels_ = now;
    known_ = true;
    supervisor_.sensors(channels_.data(), 1, true);
    for (std::size_t k = 0; k < plan_.workspace.size(); ++k) {
      const driver::Reach& reach = plan_.workspace[k];
      for (const double at : {supervisor_.position(k), supervisor_.stopping_position(k)}) {
        const double margin = std::min(at - reach.from, reach.to - at) / (reach.to - reach.from);
        double& least = extremes_.margin[static_cast<Eigen::Index>(k)];
        least = std::min(least, margin);
      }
    }
  }

  void command(const Eigen::VectorXd& command) {
    extremes_.command = extremes_.command.cwiseMax(command.cwiseAbs());
    extremes_.slew = extremes_.slew.cwiseMax((command - last_command_).cwiseAbs() / plan_.period);
    last_command_ = command;
    Eigen::VectorXd copy = command;
    supervisor_.command(copy.data());
  }

  const Eigen::VectorXd& channels() const { return channels_; }
  const Extremes& extremes() const { return extremes_; }
  std::string fault() const {
    if (!supervisor_.stopped()) {
      return "";
    }
    return std::string(to_string(supervisor_.fault().cause)) + ": " + supervisor_.fault().detail;
  }

 private:
  const driver::Plan& plan_;
  driver::Supervisor supervisor_;
  Eigen::VectorXd channels_, rested_, last_command_;
  bool known_ = false;
  Extremes extremes_;
};

Json numbers(const Eigen::VectorXd& values) {
  Json::Array list;
  for (const double value : values) {
    list.emplace_back(value);
  }
  return Json(list);
}

Eigen::VectorXd vector_of(const Json& json) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(json.array().size()));
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    values[k] = json.array()[static_cast<std::size_t>(k)].number();
  }
  return values;
}

}  // namespace

void Extremes::widen(const Extremes& other) {
  if (rate.size() == 0) {
    *this = other;
    return;
  }
  rate = rate.cwiseMax(other.rate);
  rest = rest.cwiseMax(other.rest);
  command = command.cwiseMax(other.command);
  slew = slew.cwiseMax(other.slew);
  margin = margin.cwiseMin(other.margin);
}

Json to_json(const LastingRun& run) {
  Json json;
  json["cycles"] = static_cast<double>(run.cycles);
  json["end"] = run.end;
  json["supervisor"] = run.supervisor;
  json["rate"] = numbers(run.extremes.rate);
  json["rest"] = numbers(run.extremes.rest);
  json["command"] = numbers(run.extremes.command);
  json["slew"] = numbers(run.extremes.slew);
  json["margin"] = numbers(run.extremes.margin);
  return json;
}

LastingRun lasting_run_from(const Json& json) {
  LastingRun run;
  run.cycles = static_cast<long>(json.at("cycles").number());
  run.end = json.at("end").text();
  run.supervisor = json.at("supervisor").text();
  run.extremes.rate = vector_of(json.at("rate"));
  run.extremes.rest = vector_of(json.at("rest"));
  run.extremes.command = vector_of(json.at("command"));
  run.extremes.slew = vector_of(json.at("slew"));
  run.extremes.margin = vector_of(json.at("margin"));
  return run;
}

LastingRun last(const run::LoadedScenario& loaded, const Gait& gait, const driver::Plan& plan,
                const LastingOptions& options) {
  const run::SampledOptions sampled;
  model::Plant plant(loaded.model, {}, loaded.scenario.terrain);
  run::SimulationOptions simulation_options;
  simulation_options.integrator = sampled.integrator;
  simulation_options.period = plan.period;
  run::Simulation simulation(plant, simulation_options);
  run::SensorOptions sensor_options;
  sensor_options.seed = options.seed;
  run::Sensors sensors(loaded.model, sensor_options);
  run::WiredController controller(loaded.model, *loaded.controller);
  run::EndWatch ends(loaded.scenario.ends, &controller);
  CycleFinder finder(gait, loaded.model.feet.size());
  Watch watch(plan);
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> draw(0.0, 1.0);

  LastingRun result;
  Eigen::VectorXd command = Eigen::VectorXd::Zero(plant.motors());
  Eigen::VectorXd acting = command;
  run::Sensed sensed;
  if (options.keep > 0) {
    result.channels.resize(static_cast<Eigen::Index>(plan.channels.size()), options.keep);
  }
  simulation.start(run::state_at_start(loaded.model, loaded.scenario));
  try {
    for (long k = 0; result.cycles < options.cycles && result.end.empty(); ++k) {
      simulation.measure();
      sensors.read(simulation.outputs(), simulation.touches(), sensed);
      watch.sensors(sensed);
      if (k < options.keep) {
        result.channels.col(k) = watch.channels();
      }
      const bool lost = draw(random) < options.wire.lost;
      const bool late = draw(random) < options.wire.late;
      const Eigen::VectorXd before = command;
      if (!lost) {
        controller.step(sensed, command.data());
      }
      acting = late ? before : command;
      watch.command(command);
      if (finder.look(simulation.time(), simulation.touches())) {
        ++result.cycles;
      }
      result.end = ends.look(simulation);
      if (result.end.empty() && simulation.time() >= loaded.scenario.longest) {
        result.end = "the scenario's length is over";
      }
      simulation.advance(acting);
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    result.end = error.what();
  }
  if (result.cycles >= options.cycles) {
    result.end.clear();
  }
  result.supervisor = watch.fault();
  result.extremes = watch.extremes();
  if (options.keep > 0) {
    const auto samples = static_cast<Eigen::Index>(simulation.samples());
    result.channels.conservativeResize(Eigen::NoChange, std::min<Eigen::Index>(samples, options.keep));
  }
  return result;
}

}  // namespace plumbline::validation
