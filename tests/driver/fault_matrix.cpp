// Every fault at random instants of MABEL's hopping: what the driver called it, and how long until zero
// torque.
//   fault_matrix INSTANTS [--real-time] [--udp PORT] [--only FAULT] [--seed N] [--folder DIR]
// The robot is another process (plumbline robot), joined by shared memory or UDP. Exit status 1 when a cause
// is another than expected or a command behind the fault's detection was not zero.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "controllers/driver/log.h"
#include "tests/driver/processes.h"
#include "tests/driver/rehearsal.h"

namespace plumbline::driver {
namespace {

namespace fs = std::filesystem;

struct Options {
  int instants = 20;
  bool real_time = false;
  std::string port;  ///< of UDP; empty: shared memory
  std::string only;
  std::uint64_t seed = 43;
  std::string folder = "fault_matrix_logs";
};

struct Row {
  std::string name;
  std::string robot;   ///< fault of the robot: what stands around "@SECONDS"
  std::string behind;  ///< what follows the seconds
  int controller = 0;  ///< fault of faulty_hopping
  std::string words;   ///< of the operator, behind the instant
  int signal = 0;      ///< that the driver's process gets at the instant
  std::vector<std::string> causes;
};

std::vector<std::string> of_a_false_sensor() {
  return {"workspace", "stopping position", "slew limit", "count jump", "frozen sensor"};
}

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"command not a number", "", "", 1, "", 0, {"not a number"}},
      {"command beyond its limit", "", "", 2, "", 0, {"command limit"}},
      {"command too quick", "", "", 3, "", 0, {"slew limit"}},
      {"controller gives up", "", "", 4, "", 0, {"controller gave up"}},
      {"controller slow", "", "", 8, "", 0, {"late cycle"}},
      {"controller hangs", "", "", 5, "", 0, {"controller overrun"}},
      // A process that takes longer to end than its answer may take has overrun.
      {"controller aborts", "", "", 6, "", 0, {"controller crash", "controller overrun"}},
      {"controller exits", "", "", 7, "", 0, {"controller crash", "controller overrun"}},
      // The controller answers to what it is told: which limit is met first depends on the instant.
      {"sensor drifts slowly", "drift", ":thigh_left:3000", 0, "", 0, of_a_false_sensor()},
      {"sensor drifts quickly", "drift", ":thigh_left:30000", 0, "", 0, of_a_false_sensor()},
      {"sensor jumps", "jump", ":knee_right:500", 0, "", 0, {"count jump"}},
      {"sensor freezes", "frozen", ":thigh_right", 0, "", 0, of_a_false_sensor()},
      {"packets corrupt", "corrupt", ":20", 0, "", 0, {"corrupt packets", "lost packets"}},
      {"packets lost", "lost", ":20", 0, "", 0, {"lost packets"}},
      {"packets twice", "duplicated", ":40", 0, "", 0, {"duplicated packets"}},
      {"packets overtaken", "reordered", ":40", 0, "", 0, {"reordered packets", "lost packets"}},
      {"other layout", "layout", "", 0, "", 0, {"wrong layout"}},
      {"robot silent", "silence", ":2", 0, "", 0, {"stale"}},
      {"emergency button", "emergency-stop", "", 0, "", 0, {"emergency stop"}},
      {"robot cuts power", "power", "", 0, "", 0, {"power cut"}},
      {"operator stops", "", "", 0, "stop; wait 0.1; ", 0, {"emergency stop"}},
      {"driver interrupted", "", "", 0, "", SIGINT, {"emergency stop"}},
      {"driver killed", "", "", 0, "", SIGKILL, {}}};
  return all;
}

/// What the driver's log says about its stop while the controller ran. Before that it may have seen the robot
/// of the run before lying about, and have stopped for it.
struct Stop {
  std::string cause = "none";
  double sequence = -1;  ///< of the first cycle that was stopped
  bool zero = true;      ///< every command from there on
};

Stop read_stop(const std::string& log) {
  Stop stop;
  std::ifstream events(log + "/events.txt");
  std::string line;
  bool ran = false;
  while (std::getline(events, line)) {
    ran = ran || line.find("running: ") != std::string::npos;
    const std::size_t at = line.find("stopped: ");
    if (ran && at != std::string::npos && stop.cause == "none") {
      stop.cause = line.substr(at + 9, line.find(':', at + 9) - at - 9);
    }
  }
  std::ifstream cycles(log + "/cycles.csv");
  std::getline(cycles, line);
  std::vector<std::size_t> commands;
  std::stringstream head(line);
  for (std::size_t k = 0; std::getline(head, line, ','); ++k) {
    if (line.rfind("u_", 0) == 0) commands.push_back(k);
  }
  ran = false;
  while (std::getline(cycles, line)) {
    std::vector<double> values;
    std::stringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) {
      values.push_back(std::strtod(cell.c_str(), nullptr));
    }
    if (values.size() < 3) continue;
    ran = ran || values[1] == static_cast<double>(State::running);
    if (!ran || values[2] == 0.0) continue;
    if (stop.sequence < 0) stop.sequence = values[0];
    for (const std::size_t k : commands) stop.zero = stop.zero && k < values.size() && values[k] == 0.0;
  }
  return stop;
}

class Matrix {
 public:
  Matrix(const Options& options, const Rehearsal& rehearsal)
      : options_(options), rehearsal_(rehearsal), random_(options.seed) {}

  bool run(const Row& row) {
    std::uniform_real_distribution<double> draw(0.6, 3.0);
    std::vector<double> instants(static_cast<std::size_t>(options_.instants));
    for (double& instant : instants) instant = draw(random_);
    const std::string folder = options_.folder + "/" + row.name;
    fs::create_directories(folder);
    const std::string name = fmt::format("plumbline-faults-{}", getpid());
    const std::string udp = "127.0.0.1:" + options_.port;
    address_ = options_.port.empty() ? "shm:" + name : "udp:" + udp;
    // Only a robot with a wall clock has a watchdog, and goes on while the driver hears nothing whole.
    const bool real_time = options_.real_time || row.signal == SIGKILL || row.robot == "corrupt";
    const std::string report = folder + "/robot.json";
    std::vector<std::string> words{
        PLUMBLINE_PROGRAM, "robot", rehearsal_.model(), "--scenario", rehearsal_.scenario(),
        "--json",          report,  "--watchdog",       "20"};
    for (const std::string& word : options_.port.empty() ? std::vector<std::string>{"--shm", name}
                                                         : std::vector<std::string>{"--udp", udp}) {
      words.push_back(word);
    }
    words.emplace_back("--hard");  // a robot that is not given the processor is a fault of its own
    if (!real_time) words.emplace_back("--fast");
    for (const double instant : instants) {
      if (!row.robot.empty()) {
        words.emplace_back("--fault");
        words.push_back(fmt::format("{}@{:.3f}{}", row.robot, instant, row.behind));
      }
    }
    Process robot(words, folder + "/robot.txt");
    wait_for(folder + "/robot.txt", "waiting for a driver");
    std::vector<Stop> stops;
    for (std::size_t k = 0; k < instants.size(); ++k) {
      stops.push_back(drive(row, instants[k], fmt::format("{}/{}", folder, k)));
    }
    robot.signal(SIGINT);
    robot.wait();
    std::ifstream in(report);
    return judge(row, stops, nlohmann::json::parse(in).at("runs"));
  }

 private:
  Stop drive(const Row& row, double instant, const std::string& log) {
    fs::remove_all(log);
    const std::string certificate =
        rehearsal_.faulty(row.controller, row.controller == 0 ? 0.0 : std::round(1000.0 * instant));
    const bool at_instant = !row.words.empty() || row.signal != 0;
    const std::string wait =
        at_instant && row.signal == 0 ? fmt::format("wait {:.3f}; ", instant) : "wait 20; ";
    Process driver({DRIVE_PROGRAM, certificate, "--key", rehearsal_.key(), "--robot", address_, "--log", log,
                    "--allow-soft-timing", "--do",
                    "wait 0.1; reset; wait 0.1; arm; wait 0.1; go; " + wait + row.words + "wait 0.05; quit"},
                   log + ".txt");
    if (row.signal != 0) {
      wait_for(log + "/events.txt", "running: ");
      usleep(static_cast<useconds_t>(1e6 * instant));
      driver.signal(row.signal);
    }
    driver.wait();
    if (row.signal == SIGKILL) {
      usleep(200000);  // ten times the robot's watchdog: it is to find out by itself
    }
    return read_stop(log);
  }

  bool judge(const Row& row, const std::vector<Stop>& stops, const nlohmann::json& runs) const {
    bool good = runs.size() == stops.size();
    std::string causes;
    double least = 1e9, most = -1e9, latest = 0.0, wall = 0.0, watchdog = 0.0;
    bool detected = false;
    for (std::size_t k = 0; k < stops.size() && k < runs.size(); ++k) {
      const Stop& stop = stops[k];
      const double fault_at = runs[k].at("fault_at").get<double>(),
                   zero_at = runs[k].at("zero_at").get<double>();
      watchdog = std::max(watchdog, runs[k].at("watchdog_after").get<double>());
      if (row.causes.empty()) {  // the driver is gone: the robot's own watchdog
        good = good && runs[k].at("watchdog").get<bool>();
        causes = "robot's watchdog";
        continue;
      }
      const bool expected = std::find(row.causes.begin(), row.causes.end(), stop.cause) != row.causes.end();
      good = good && expected && stop.zero;
      if (causes.find(stop.cause) == std::string::npos) causes += (causes.empty() ? "" : ", ") + stop.cause;
      if (stop.sequence >= 0) latest = std::max(latest, zero_at - stop.sequence);
      if (fault_at >= 0) {
        detected = true;
        least = std::min(least, zero_at - fault_at);
        most = std::max(most, zero_at - fault_at);
      }
      wall = std::max(wall, runs[k].at("fault_to_zero").get<double>());
    }
    good = good && latest <= 0.0;
    const std::string reach = detected ? fmt::format("{:.0f} to {:.0f}", std::max(least, 0.0), most) : "-";
    const std::string end = row.causes.empty() ? fmt::format("{:.1f} ms", 1e3 * watchdog)
                                               : fmt::format("{:.0f}", std::max(latest, 0.0));
    const std::string clock =
        detected && options_.real_time ? fmt::format("{:.1f} ms", 1e3 * wall) : std::string("-");
    fmt::print("{:<26} {:>3}  {:<36} {:>12} {:>12} {:>12}   {}\n", row.name, stops.size(), causes, reach, end,
               clock, good ? "holds" : "FAILS");
    std::fflush(stdout);
    return good;
  }

  Options options_;
  const Rehearsal& rehearsal_;
  std::string address_;
  std::mt19937_64 random_;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--real-time") {
      options.real_time = true;
    } else if (word == "--udp" && k + 1 < argc) {
      options.port = argv[++k];
    } else if (word == "--only" && k + 1 < argc) {
      options.only = argv[++k];
    } else if (word == "--seed" && k + 1 < argc) {
      options.seed = std::strtoull(argv[++k], nullptr, 10);
    } else if (word == "--folder" && k + 1 < argc) {
      options.folder = argv[++k];
    } else {
      options.instants = std::max(1, std::atoi(word.c_str()));
    }
  }
  return options;
}

int run(const Options& options) {
  fs::create_directories(options.folder);
  const Rehearsal rehearsal(options.folder);
  Matrix matrix(options, rehearsal);
  fmt::print("{:<26} {:>3}  {:<36} {:>12} {:>12} {:>12}\n", "fault", "n", "cause", "samples from", "stop to",
             "wall clock,");
  fmt::print("{:<26} {:>3}  {:<36} {:>12} {:>12} {:>12}\n", "", "", "", "it to stop", "zero torque",
             "largest");
  bool good = true;
  for (const Row& row : rows()) {
    if (options.only.empty() || row.name == options.only) good = matrix.run(row) && good;
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace plumbline::driver

int main(int argc, char** argv) {
  try {
    return plumbline::driver::run(plumbline::driver::parse(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "fault_matrix: {}\n", error.what());
    return 2;
  }
}
