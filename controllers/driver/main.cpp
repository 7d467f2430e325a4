// drive: runs a certified controller on a robot.
#include <pthread.h>
#include <sys/random.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "controllers/driver/certificate.h"
#include "controllers/driver/console.h"
#include "controllers/driver/real_time.h"
#include "controllers/driver/signature.h"

namespace {

using namespace plumbline::driver;  // NOLINT(google-build-using-namespace): the program is this namespace's

constexpr const char* kUsage =
    "usage: drive CERTIFICATE --robot ADDRESS --log DIR [OPTIONS]\n"
    "\n"
    "Runs the certified controller on a robot, under a supervisor that ends in zero torque.\n"
    "\n"
    "  --robot ADDRESS      udp:HOST:PORT or shm:NAME\n"
    "  --log DIR            a new folder: every cycle, timing, and a trial for plumbline compare\n"
    "  --key FILE           public key that must have signed; or the environment variable PLUMBLINE_KEY\n"
    "  --controller FILE    the controller's library; otherwise where the certificate says\n"
    "  --clock robot|timer  one cycle for each packet of the robot (default), or by an own timer\n"
    "  --priority N         of SCHED_FIFO, 2 to 99 (80)\n"
    "  --core N             processor core to stay on (the last one)\n"
    "  --allow-soft-timing  go on where the system refuses priority, memory or core; the log says so\n"
    "  --for SECONDS        finish after running for so long\n"
    "  --do WORDS           \"arm; wait 1; go; wait 60; finish\" instead of words from standard input:\n"
    "                       arm, go, finish, stop, reset, quit, wait SECONDS\n"
    "\n"
    "Exit status: 0 no fault; 1 a fault stopped the robot, or no robot answered; 2 wrong certificate, input "
    "or\n"
    "usage.\n";

std::atomic<bool> interrupted{false};

extern "C" void on_interrupt(int /*signal*/) { interrupted.store(true); }

struct Arguments {
  std::string certificate, robot, log, key, controller, words;
  bool has_words = false, soft = false;
  SessionOptions session;
  RealTime real_time;
};

double number_of(const std::string& option, const char* text, double least, double most) {
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (*text == '\0' || *end != '\0' || !(value >= least && value <= most)) {
    throw DriverError(option + ": found \"" + text + "\", expected a number from " + std::to_string(least) +
                      " to " + std::to_string(most));
  }
  return value;
}

ClockSource clock_of(const std::string& text) {
  if (text == "robot") return ClockSource::robot;
  if (text == "timer") return ClockSource::timer;
  throw DriverError("--clock: found \"" + text + "\", expected robot or timer");
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  arguments.real_time.core = static_cast<int>(cores) - 1;
  for (int k = 1; k < argc; ++k) {
    const std::string option = argv[k];
    if (option == "--allow-soft-timing") {
      arguments.soft = true;
      continue;
    }
    if (option.rfind("--", 0) != 0) {
      if (!arguments.certificate.empty())
        throw DriverError("found \"" + option + "\", expected one certificate");
      arguments.certificate = option;
      continue;
    }
    if (k + 1 >= argc) throw DriverError(option + ": unknown, or its value is missing; see drive --help");
    const char* const value = argv[++k];
    if (option == "--robot") {
      arguments.robot = value;
    } else if (option == "--log") {
      arguments.log = value;
    } else if (option == "--key") {
      arguments.key = value;
    } else if (option == "--controller") {
      arguments.controller = value;
    } else if (option == "--clock") {
      arguments.session.clock = clock_of(value);
    } else if (option == "--priority") {
      arguments.real_time.priority = static_cast<int>(number_of(option, value, 2, 99));
    } else if (option == "--core") {
      arguments.real_time.core =
          static_cast<int>(number_of(option, value, 0, static_cast<double>(cores - 1)));
    } else if (option == "--for") {
      arguments.session.run_for = number_of(option, value, 0.001, 1e6);
    } else if (option == "--do") {
      arguments.words = value;
      arguments.has_words = true;
    } else {
      throw DriverError(option + ": unknown option; see drive --help");
    }
  }
  if (arguments.certificate.empty()) throw DriverError("no certificate; see drive --help");
  if (arguments.robot.empty()) throw DriverError("--robot is missing; see drive --help");
  if (arguments.log.empty()) throw DriverError("--log is missing; see drive --help");
  const char* const key = std::getenv("PLUMBLINE_KEY");
  if (arguments.key.empty() && key != nullptr) arguments.key = key;
  if (arguments.key.empty()) {
    throw DriverError("no key to trust: name the public key with --key FILE or PLUMBLINE_KEY");
  }
  return arguments;
}

std::string own_path() {
  char path[PATH_MAX];
  const ssize_t n = readlink("/proc/self/exe", path, sizeof path);
  if (n <= 0 || n == static_cast<ssize_t>(sizeof path)) throw DriverError("/proc/self/exe cannot be read");
  return {path, static_cast<std::size_t>(n)};
}

std::string absolute(const std::string& path) {
  char* const real = realpath(path.c_str(), nullptr);
  std::string result = real == nullptr ? path : real;
  std::free(real);
  return result;
}

// The bytes that were certified, and that are then loaded without reading the file again.
std::string controller_bytes(const Certificate& certificate, const Plan& plan, const std::string& named) {
  const std::string path = named.empty() ? path_of(certificate, plan.library) : named;
  std::string bytes = read_bytes(path);
  const std::string found = sha256_hex(bytes);
  if (found != plan.library_sha256) {
    throw DriverError(path + ": is not the file that was certified (SHA-256 " + found.substr(0, 16) +
                      "..., certified " + plan.library_sha256.substr(0, 16) + "...)");
  }
  return bytes;
}

// Constants, model and data are not needed here; but those that are here must be the certified ones.
void check_other_files(const Certificate& certificate, const Plan& plan) {
  for (const CertifiedFile& one : certified_files(certificate)) {
    const std::string path = path_of(certificate, one.file);
    if (one.file == plan.library || access(path.c_str(), F_OK) != 0) continue;
    if (sha256_of_file(path) != one.sha256) throw DriverError(path + ": is not the file that was certified");
  }
}

Plan checked_plan(const Certificate& certificate) {
  try {
    return plan_from(certificate.body);
  } catch (const DriverError& error) {
    throw DriverError(certificate.file + ": " + error.what());
  }
}

std::uint32_t random_number() {
  std::uint32_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number)
    number = static_cast<std::uint32_t>(monotonic_now());
  return number;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "; ") + line;
  return text;
}

// Takes what real time needs on the calling thread; a refusal is a reason to stop unless it was allowed.
std::string timing_notes(const Arguments& arguments) {
  const std::vector<std::string> missing = make_real_time(arguments.real_time);
  if (missing.empty()) return "hard timing: SCHED_FIFO, memory locked, one core";
  if (!arguments.soft) {
    throw DriverError("the system does not allow real time: " + joined(missing) +
                      "; --allow-soft-timing goes on");
  }
  return "soft timing: " + joined(missing);
}

int drive(int argc, char** argv) {
  Arguments arguments = parse(argc, argv);
  const std::vector<Word> words = parse_words(arguments.words);
  const Certificate certificate = read_certificate(arguments.certificate);
  check_key(certificate, arguments.key);
  check_date(certificate, today_utc());
  const Plan plan = checked_plan(certificate);
  const std::string bytes = controller_bytes(certificate, plan, arguments.controller);
  check_other_files(certificate, plan);
  arguments.session.session = random_number();

  // The controller's process comes before real time: it takes its own priority, one below.
  Schedule schedule;
  schedule.priority = arguments.real_time.priority - 1;
  schedule.core = arguments.real_time.core;
  schedule.lock_memory = true;
  ControllerProcess controller(own_path(), plan, bytes, schedule);
  const std::unique_ptr<Transport> transport = open_transport(arguments.robot, Side::driver);
  // The log's thread begins before priorities are taken, and so stays an ordinary one.
  std::string notes;
  Log log(arguments.log, plan, absolute(path_of(certificate, plan.model)));
  Session session(plan, *transport, controller, &log, arguments.session);

  signal(SIGINT, on_interrupt);
  signal(SIGTERM, on_interrupt);
  signal(SIGPIPE, SIG_IGN);
  std::string refusal;
  std::atomic<int> ready{0};
  std::thread loop([&] {
    try {
      notes = timing_notes(arguments);
    } catch (const DriverError& error) {
      refusal = error.what();
    }
    ready.store(1);
    if (refusal.empty()) session.run();
  });
  // SIGCHLD is for the loop's thread alone: it ends the wait for a controller that has crashed.
  sigset_t child;
  sigemptyset(&child);
  sigaddset(&child, SIGCHLD);
  pthread_sigmask(SIG_BLOCK, &child, nullptr);
  while (ready.load() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!refusal.empty()) {
    loop.join();
    throw DriverError(refusal);
  }
  log.event(0.0, notes.c_str());
  std::thread dates([&] {
    while (!session.over()) {
      if (today_utc() > certificate.body.at("valid_until").text()) session.expire();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  if (arguments.has_words) {
    follow(session, words, interrupted);
  } else {
    follow_input(session, interrupted);
  }
  loop.join();
  dates.join();
  log.finish(notes, session.counts(), session.wake(), session.answer(), session.controller_time());
  std::printf(
      "%llu cycles; sense to command p50 %.0f us, p99.9 %.0f us, largest %.0f us; %llu packets lost; %llu "
      "rows of the log lost\n",
      static_cast<unsigned long long>(session.counts().cycles), session.answer().quantile(0.5),
      session.answer().quantile(0.999), static_cast<double>(session.answer().largest()) / 1000.0,
      static_cast<unsigned long long>(session.counts().lost), static_cast<unsigned long long>(log.lost()));
  if (session.counts().cycles == 0) {
    const Counts& counts = session.counts();
    std::fprintf(stderr, "drive: no robot answered at %s: %llu packets came, none of them of this session\n",
                 arguments.robot.c_str(), static_cast<unsigned long long>(counts.corrupt + counts.foreign));
    return 1;
  }
  return session.faults() > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], kControllerArgument) == 0) return controller_main(argc - 2, argv + 2);
  if (argc > 1 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0)) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  try {
    return drive(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "drive: %s\n", error.what());
    return 2;
  }
}
