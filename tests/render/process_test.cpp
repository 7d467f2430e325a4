// Programs that run beside ours, and never longer: the display and the encoder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "simulator/render/child_process.h"
#include "simulator/render/video.h"
#include "simulator/render/virtual_display.h"
#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::render {
namespace {

using testing::HasSubstr;

bool is_running(pid_t pid) { return kill(pid, 0) == 0; }

/// Sets a variable of the environment for one test.
class Setting {
 public:
  Setting(const char* name, const char* value) : name_(name) {
    const char* before = std::getenv(name);
    was_set_ = before != nullptr;
    before_ = was_set_ ? before : "";
    value == nullptr ? unsetenv(name) : setenv(name, value, 1);
  }
  ~Setting() { was_set_ ? setenv(name_, before_.c_str(), 1) : unsetenv(name_); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
  std::string before_;
  bool was_set_ = false;
};

/// Process ids of children whose program has this name.
std::vector<pid_t> children(const std::string& program) {
  std::vector<pid_t> found;
  std::ifstream list("/proc/self/task/" + std::to_string(getpid()) + "/children");
  for (pid_t pid = 0; list >> pid;) {
    std::string name;
    std::getline(std::ifstream("/proc/" + std::to_string(pid) + "/comm"), name);
    if (name == program) {
      found.push_back(pid);
    }
  }
  return found;
}

TEST(ChildProcess, IsGoneWithItsOwnerAlsoWhenItIsDeafToTerm) {
  pid_t pid = 0;
  {
    const ChildProcess child({"sh", "-c", "trap '' TERM; while :; do sleep 0.1; done"});
    pid = child.pid();
    EXPECT_TRUE(is_running(pid));
    usleep(200'000);  // until the trap is set
  }
  EXPECT_FALSE(is_running(pid));
}

TEST(ChildProcess, SaysHowItEndedAndWhatItSaidLast) {
  ChildProcess child({"sh", "-c", "read line; echo one >&2; echo \"two $line\" >&2; exit 3"});
  EXPECT_TRUE(child.write("here\n", 5));
  EXPECT_EQ(child.finish(), 3);
  EXPECT_EQ(child.last_words(), "two here");
  ChildProcess none({"no-such-program-anywhere"});
  EXPECT_EQ(none.finish(), 127);
}

TEST(ChildProcess, WritingToOneThatIsGoneIsNoSignal) {
  ChildProcess child({"true"});
  const std::string much(1'000'000, 'x');
  bool heard = true;
  for (int k = 0; k < 100 && heard; ++k) {
    heard = child.write(much.data(), much.size());
  }
  EXPECT_FALSE(heard);
}

// We die without a destructor: the kernel ends the child.
TEST(ChildProcess, DiesWithUs) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t middle = fork();
  if (middle == 0) {
    const ChildProcess child({"sleep", "60"});
    const pid_t pid = child.pid();
    static_cast<void>(!write(ends[1], &pid, sizeof pid));
    kill(getpid(), SIGKILL);
  }
  pid_t pid = 0;
  ASSERT_EQ(read(ends[0], &pid, sizeof pid), static_cast<ssize_t>(sizeof pid));
  waitpid(middle, nullptr, 0);
  close(ends[0]);
  close(ends[1]);
  bool running = true;
  for (int k = 0; k < 200 && running; ++k) {
    usleep(10'000);
    // An orphan that nobody has waited for yet is dead all the same.
    std::string state;
    std::getline(std::ifstream("/proc/" + std::to_string(pid) + "/stat"), state);
    running = !state.empty() && state.find(") Z ") == std::string::npos;
  }
  EXPECT_FALSE(running);
}

TEST(VirtualDisplay, IsStartedWhereThereIsNoneAndEnded) {
  if (!program_exists("Xvfb")) {
    GTEST_SKIP() << "no Xvfb";
  }
  const Setting no_display("DISPLAY", nullptr);
  {
    const VirtualDisplay display;
    EXPECT_EQ(children("Xvfb").size(), 1U);
    ASSERT_NE(std::getenv("DISPLAY"), nullptr);
    {
      const VirtualDisplay second;  // the first one answers
      EXPECT_EQ(children("Xvfb").size(), 1U);
    }
    EXPECT_EQ(children("Xvfb").size(), 1U);
  }
  EXPECT_TRUE(children("Xvfb").empty());
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
}

TEST(VirtualDisplay, IsStartedWhereDisplayNamesOneThatDoesNotAnswer) {
  if (!program_exists("Xvfb")) {
    GTEST_SKIP() << "no Xvfb";
  }
  const Setting dead("DISPLAY", ":9876");
  try {
    const VirtualDisplay display;
    EXPECT_STRNE(std::getenv("DISPLAY"), ":9876");
    throw std::runtime_error("work that fails");
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "work that fails");
  }
  EXPECT_TRUE(children("Xvfb").empty());
  EXPECT_STREQ(std::getenv("DISPLAY"), ":9876");
}

TEST(VirtualDisplay, SaysWhatIsMissing) {
  const Setting no_display("DISPLAY", nullptr);
  const Setting no_path("PATH", "/nowhere");
  try {
    const VirtualDisplay display;
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no Xvfb to stand in (Debian: package xvfb)"));
  }
}

Image gray(std::uint8_t level) {
  Image image(64, 64);
  image.rgb.assign(image.rgb.size(), level);
  return image;
}

TEST(Video, TheSameFramesGiveTheSameBytes) {
  if (!program_exists("ffmpeg")) {
    GTEST_SKIP() << "no ffmpeg";
  }
  const test::TemporaryFolder folder;
  for (const char* name : {"a.mp4", "b.mp4"}) {
    Video video(folder.path(name), 64, 64, 30.0);
    for (std::uint8_t k = 0; k < 20; ++k) {
      video.add(gray(static_cast<std::uint8_t>(10 * k)));
    }
    EXPECT_EQ(video.finish(), folder.path(name));
  }
  EXPECT_GT(folder.read("a.mp4").size(), 500U);
  EXPECT_EQ(folder.read("a.mp4"), folder.read("b.mp4"));
  EXPECT_EQ(folder.file_count(), 2U);
}

TEST(Video, WithoutFfmpegThereAreNumberedPictures) {
  const test::TemporaryFolder folder;
  const Setting no_path("PATH", "/nowhere");
  Video video(folder.path("a.mp4"), 64, 64, 30.0);
  video.add(gray(1));
  video.add(gray(2));
  EXPECT_EQ(video.finish(), folder.path("a.frames"));
  EXPECT_EQ(read_png(folder.path("a.frames/frame_00002.png")).rgb, gray(2).rgb);
  EXPECT_EQ(folder.file_count(), 3U);
}

TEST(Video, LeavesNothingBehindWhenItIsNotFinished) {
  const test::TemporaryFolder folder;
  const char* usual = std::getenv("PATH");
  ASSERT_NE(usual, nullptr);
  for (const std::string& path : {std::string("/nowhere"), std::string(usual)}) {
    const Setting with("PATH", path.c_str());
    Video video(folder.path("a.mp4"), 64, 64, 30.0);
    video.add(gray(1));
  }
  EXPECT_EQ(folder.file_count(), 0U);
  EXPECT_TRUE(children("ffmpeg").empty());
}

// Somebody's own folder of that name is not ours to replace.
TEST(Video, AFolderWithOtherThingsIsRefused) {
  const test::TemporaryFolder folder;
  folder.write("a.frames/letter.txt", "dear");
  const Setting no_path("PATH", "/nowhere");
  EXPECT_THROW(Video(folder.path("a.mp4"), 64, 64, 30.0), InputError);
  EXPECT_EQ(folder.read("a.frames/letter.txt"), "dear");
}

}  // namespace
}  // namespace plumbline::render
