#include <fmt/core.h>

#include <algorithm>

#include "controllers/driver/json.h"
#include "controllers/driver/real_time.h"
#include "controllers/driver/transport.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/run_scenario.h"
#include "simulator/run/sampled_run.h"
#include "simulator/trace/error.h"
#include "validation/cli/driving_commands.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/control/robot/simulated_robot.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::string model, scenario, udp, shm, json;
  std::vector<std::string> faults, effects;
  double period = 1.0, watchdog = 1.0;  // ms
  bool fast = false, hard = false;
  validation::RobotOptions robot;
};

nlohmann::json to_json(const validation::RobotRun& run) {
  return {{"time", run.time},         {"landings", run.landings},
          {"fault", run.fault},       {"fault_at", run.fault_at},
          {"zero_at", run.zero_at},   {"fault_to_zero", run.fault_to_zero},
          {"watchdog", run.watchdog}, {"watchdog_after", run.watchdog_after}};
}

void print(const validation::RobotReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const validation::RobotRun& run : report.runs) {
    const bool fault = run.fault_at >= 0;
    rows.push_back({fmt::format("{:.3f} s", run.time), std::to_string(run.landings),
                    run.fault.empty() ? "none" : run.fault,
                    fault ? std::to_string(run.zero_at - run.fault_at) : "",
                    run.fault_to_zero >= 0.0 ? fmt::format("{:.2f} ms", 1e3 * run.fault_to_zero) : "",
                    run.watchdog ? fmt::format("watchdog, {:.2f} ms", 1e3 * run.watchdog_after) : "driver"});
  }
  print_table({"under power", "landings", "fault", "samples to no power", "wall clock", "power cut by"},
              rows);
  fmt::print(
      "\n{} samples, {} commands; sample to command p50 {:.0f} us, p99 {:.0f} us, p99.9 {:.0f} us, largest "
      "{:.0f} us\n",
      report.samples, report.commands, report.round_trip.quantile(0.5), report.round_trip.quantile(0.99),
      report.round_trip.quantile(0.999), static_cast<double>(report.round_trip.largest()) / 1e3);
  fmt::print(
      "{} samples were late by more than half a period, {:.2f} ms at most: the simulation had taken longer\n",
      report.slipped, 1e3 * report.largest_slip);
}

void run(Options& options) {
  if (options.udp.empty() == options.shm.empty()) {
    throw InputError({"", 0, "--udp, --shm"}, options.udp.empty() ? "neither" : "both", "one of them");
  }
  model::Model model;
  contact::Terrain terrain;
  Eigen::VectorXd start;
  if (options.scenario.empty()) {
    model = model::read_model(options.model, model::known_effects());
  } else {
    const run::LoadedScenario loaded = run::read_scenario(options.scenario, {options.model, ""});
    model = loaded.model;
    terrain = loaded.scenario.terrain;
    start = run::state_at_start(model, loaded.scenario);
  }
  for (const std::string& effect : options.effects) {
    model.effects.push_back(validation::parse_effect(effect, model, effects::Catalogue::all()));
  }
  // Hidden effects may add states: the start is found anew on the robot as it is.
  if (!options.scenario.empty() && !options.effects.empty()) {
    start = run::state_at_start(model, run::read_scenario(options.scenario, {options.model, ""}).scenario);
  }
  if (options.scenario.empty()) {
    start = Eigen::VectorXd::Zero(model::Plant(model, {}, terrain).states());
  }
  validation::RobotOptions& robot = options.robot;
  robot.period = 1e-3 * options.period;
  robot.watchdog = 1e-3 * options.watchdog;
  robot.real_time = !options.fast;
  robot.integrator = run::SampledOptions().integrator;
  for (const std::string& fault : options.faults) {
    robot.faults.push_back(validation::parse_fault(fault, model));
  }
  validation::SimulatedRobot simulated(model, terrain, start, robot);
  std::unique_ptr<driver::Transport> transport;
  try {
    transport = driver::open_transport(options.udp.empty() ? "shm:" + options.shm : "udp:" + options.udp,
                                       driver::Side::robot);
  } catch (const driver::DriverError& error) {
    throw InputError(error.what());
  }
  if (options.hard) {
    driver::RealTime wanted;
    wanted.priority = 70;  // below the driver's
    wanted.core = 0;
    for (const std::string& missing : driver::make_real_time(wanted)) {
      fmt::print(stderr, "plumbline: {}\n", missing);
    }
  }
  fmt::print("{}: waiting for a driver at {}\n", model.robot,
             options.udp.empty() ? options.shm : options.udp);
  std::fflush(stdout);
  const validation::RobotReport report =
      simulated.serve(*transport, [] { return stop_flag().raised.load(); });
  print(report);
  nlohmann::json json{{"samples", report.samples},
                      {"commands", report.commands},
                      {"corrupt", report.corrupt},
                      {"slipped", report.slipped},
                      {"largest_slip", report.largest_slip},
                      {"round_trip_us",
                       {{"p50", report.round_trip.quantile(0.5)},
                        {"p99", report.round_trip.quantile(0.99)},
                        {"p99.9", report.round_trip.quantile(0.999)},
                        {"max", static_cast<double>(report.round_trip.largest()) / 1e3}}}};
  json["runs"] = nlohmann::json::array();
  for (const validation::RobotRun& one : report.runs) {
    json["runs"].push_back(to_json(one));
  }
  write_json(json, options.json);
}

}  // namespace

void add_robot(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "robot", "Simulate a robot that answers a driver in real time, as the hardware would");
  command->add_option("model", options->model, "model file")->required()->type_name("MODEL");
  command
      ->add_option("--scenario", options->scenario,
                   "where it starts and on what ground; otherwise all at zero")
      ->type_name("FILE");
  command->add_option("--udp", options->udp, "listen at HOST:PORT")->type_name("HOST:PORT");
  command->add_option("--shm", options->shm, "make POSIX shared memory NAME")->type_name("NAME");
  command
      ->add_option(
          "--fault", options->faults,
          "KIND@SECONDS[:SENSOR][:AMOUNT] after the hand-over; again for the next run. Kinds: corrupt, lost, "
          "duplicated, reordered, silence, frozen, jump, drift, layout, emergency-stop, power")
      ->type_name("FAULT");
  command
      ->add_option("--effect", options->effects,
                   "something the model does not have, EFFECT@WHERE:param=value")
      ->type_name("EFFECT");
  command->add_option("--period", options->period, "between two samples, ms")
      ->capture_default_str()
      ->check(between(0.01, 1000.0));
  command
      ->add_option("--watchdog", options->watchdog, "cut the power when no command has come for so long, ms")
      ->capture_default_str()
      ->check(between(0.01, 10000.0));
  command->add_flag("--fast", options->fast, "not in real time: the next sample follows the command at once");
  command->add_flag("--hard", options->hard, "take real-time priority 70 and core 0");
  command->add_option("--for", options->robot.longest, "end after so many seconds")->check(between(0.0, 1e6));
  command->add_flag("--once", options->robot.once, "end when the driver has been silent for 2 s");
  command->add_option("--seed", options->robot.seed, "of sensor noise and flipped bits")
      ->capture_default_str();
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline robot robots/mabel/mabel.yaml --scenario "
      "robots/mabel/scenarios/hopping_boom.yaml "
      "--udp 127.0.0.1:5700");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
