// A full disk, and an end at any instant: what stands in a file is the old content or the whole new one.
#include <gmock/gmock.h>
#include <poll.h>
#include <sched.h>
#include <sys/inotify.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

#ifdef PLUMBLINE_SLOW
constexpr int kInstants = 24;
#else
constexpr int kInstants = 4;
#endif

/// While it lives, programs that are started can write files of so many bytes only: a write beyond fails, as
/// on a full disk, and no signal ends the program.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit small{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit old_{};
  void (*handler_)(int);
};

/// Says when something was made, written or renamed in a folder.
class Watch {
 public:
  explicit Watch(const std::string& folder) : descriptor_(::inotify_init1(IN_NONBLOCK)) {
    EXPECT_GE(::inotify_add_watch(descriptor_, folder.c_str(), IN_CREATE | IN_MODIFY | IN_MOVED_TO), 0);
  }
  ~Watch() { ::close(descriptor_); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Waits for the n-th time; false when the program ends before.
  bool wait_for(int n, Process& process) const {
    alignas(inotify_event) std::array<char, 4096> events{};
    for (int seen = 0; process.is_running();) {
      pollfd ready{descriptor_, POLLIN, 0};
      if (::poll(&ready, 1, 20) > 0) {
        const ssize_t bytes = ::read(descriptor_, events.data(), events.size());
        for (ssize_t at = 0; at < bytes; ++seen) {
          inotify_event event{};
          std::copy_n(events.data() + at, sizeof event, reinterpret_cast<char*>(&event));
          at += static_cast<ssize_t>(sizeof event + event.len);
        }
        if (seen >= n) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  int descriptor_;
};

/// What a program that was killed had begun to write beside its file; the next one takes another name.
bool is_temporary(const std::string& name) {
  const std::string file = fs::path(name).filename().string();
  return file.front() == '.' && fs::path(file).extension() == ".tmp";
}

class Faults : public RobotFolder {
 protected:
  void SetUp() override {
    RobotFolder::SetUp();
    write("jobs.yaml",
          "plumbline: batch/1\ntitle: A pendulum\nmodel: robot/model.yaml\nrows:\n"
          "  - {label: one, mode: compare, trials: [trials/chirp]}\n"
          "  - {label: two, mode: compare, trials: [trials/steps]}\n");
    fs::create_directories(folder + "/out/rows");
  }

  /// Results of the command below out/, without what says how long it took and what it keeps on its way.
  Files results() const {
    Files files;
    for (const auto& [name, text] : snapshot()) {
      const bool is_work = name.find("durations.csv") != std::string::npos || is_temporary(name) ||
                           name.find(".results") != std::string::npos;
      if (name.rfind("out/", 0) == 0 && !fs::is_directory(folder + "/" + name) && !is_work) {
        files[name] = text;
      }
    }
    return files;
  }

  void begin_anew(const Files& old) const {
    remove("out");
    fs::create_directories(folder + "/out/rows");
    for (const auto& [name, text] : old) {
      write(name, text);
    }
  }

  void expect_old_or_whole(const Files& old, const Files& whole, const std::string& when) const {
    for (const auto& [name, text] : results()) {
      const auto before = old.find(name), after = whole.find(name);
      EXPECT_TRUE((before != old.end() && text == before->second) ||
                  (after != whole.end() && text == after->second))
          << name << ", " << text.size() << " bytes, " << when;
    }
  }

  /// Kills the command at many instants: spread over its time, and just when it writes.
  void kill_at_instants(const std::vector<std::string>& command, const Files& old,
                        const std::string& watched) const {
    begin_anew(old);
    Process undisturbed(command, folder);
    const Outcome outcome = undisturbed.wait();
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Files whole = results();
    ASSERT_FALSE(whole.empty());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int killed = 0;
    for (int n = 0; n < kInstants; ++n) {
      begin_anew(old);
      const Watch watch(folder + watched);
      Process process(command, folder);
      std::string when;
      if (n % 4 != 3) {
        const int event = 3 + n - n / 4;  // a temporary file is made, written to, renamed: then the next one
        when = "killed at event " + std::to_string(event);
        killed += watch.wait_for(event, process) ? 1 : 0;
      } else {
        const double seconds = share(random) * undisturbed.processor_seconds();
        when = "killed after " + std::to_string(seconds) + " s of processor";
        while (process.is_running() && process.processor_seconds() < seconds) {
          std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        killed += process.is_running() ? 1 : 0;
      }
      process.kill();
      process.wait();
      expect_old_or_whole(old, whole, when);
    }
    EXPECT_GE(killed, 1) << "each time it had ended before";
    // What the last one left stands in nobody's way.
    succeed(command);
    EXPECT_EQ(results(), whole);
  }

  /// The disk was full: it says so, and nothing is left of what it had begun.
  void expect_refused(const Outcome& outcome, const Files& old, const Files& whole,
                      const std::string& when) const {
    EXPECT_NE(outcome.status, 0) << when << "\n" << outcome.out << outcome.err;
    EXPECT_LT(outcome.status, 128) << "a signal ended it, " << when;
    expect_old_or_whole(old, whole, when);
    for (const auto& [name, text] : snapshot()) {
      EXPECT_FALSE(is_temporary(name)) << name << ", " << when;
    }
  }

  static const std::vector<std::string> kDiagnose, kBatch;
};

const std::vector<std::string> Faults::kDiagnose{"diagnose", "trials/chirp",    "trials/swing", "--most=1",
                                                 "--save",   "out/found.yaml",  "--json",       "out/d.json",
                                                 "--resume", "out/kept.results"};
const std::vector<std::string> Faults::kBatch{"batch", "jobs.yaml", "-o", "out"};

TEST_F(Faults, ABatchThatIsKilledLeavesNoHalfFile) { kill_at_instants(kBatch, {}, "/out/rows"); }

/// A row that could not be kept says so in its place.
bool is_whole(const std::string& name, const std::string& text) {
  const std::string kind = fs::path(name).extension().string();
  const std::string end = kind == ".html" ? "</html>\n" : "\n";
  return text == "old\n" || (text.size() > end.size() && text.substr(text.size() - end.size()) == end &&
                             (kind != ".json" || nlohmann::json::accept(text)));
}

TEST_F(Faults, ABatchWhoseFilesCannotBeWrittenLeavesNoHalfOnes) {
  for (const rlim_t bytes : {0U, 1000U}) {  // rows are longer, and what is said of them is shorter
    begin_anew({{"out/batch.csv", "old\n"}, {"out/batch.html", "old\n"}});
    const Outcome outcome = [&] {
      const SmallFiles small(bytes);
      return plumbline(kBatch);
    }();
    EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << outcome.status << " with " << bytes;
    for (const auto& [name, text] : snapshot()) {
      EXPECT_FALSE(is_temporary(name)) << name << " with " << bytes;
    }
    for (const auto& [name, text] : results()) {
      EXPECT_TRUE(is_whole(name, text)) << name << " with " << bytes << "\n" << text;
    }
  }
}

TEST_F(Faults, WhatCannotBePrintedIsNoSuccess) {
  const Outcome outcome = [&] {
    const SmallFiles small(20);
    return plumbline({"check", "robot/model.yaml"});
  }();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out.size(), 20U);
}

#ifdef PLUMBLINE_SLOW
/// A disk of few pages in a name space of its own; nothing where that is not allowed.
class SmallDisk {
 public:
  SmallDisk(const std::string& at, int pages) : at_(at) {
    const std::string options = "size=" + std::to_string(pages * ::sysconf(_SC_PAGESIZE));
    is_there_ = ::unshare(CLONE_NEWNS) == 0 &&
                ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                ::mount("tmpfs", at.c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_there_) {
      ::umount2(at_.c_str(), MNT_DETACH);
    }
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool is_there() const { return is_there_; }

 private:
  std::string at_;
  bool is_there_ = false;
};

TEST_F(Faults, ADiagnosisOnAFullDiskKeepsTheOldFiles) {
  const Files old{{"out/found.yaml", "old\n"}, {"out/d.json", "{}\n"}};
  begin_anew({});
  succeed(kDiagnose);
  const Files whole = results();
  ASSERT_EQ(whole.size(), 2U);
  for (const int pages : {3, 5}) {  // two for the old files, and what is left
    begin_anew({});
    const SmallDisk disk(folder + "/out", pages);
    if (!disk.is_there()) {
      GTEST_SKIP() << "a file system cannot be mounted here: only root may";
    }
    for (const auto& [name, text] : old) {
      write(name, text);
    }
    expect_refused(plumbline(kDiagnose), old, whole, std::to_string(pages) + " pages");
  }
}

TEST_F(Faults, ADiagnosisThatIsKilledLeavesNoHalfFile) {
  kill_at_instants(kDiagnose, {{"out/found.yaml", "old\n"}, {"out/d.json", "{}\n"}}, "/out");
}
#endif

}  // namespace
}  // namespace plumbline::test
