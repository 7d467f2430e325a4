// Tasks in, results in order out: threads.
#include "work/workers.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

namespace plumbline::work {
namespace {

using testing::ElementsAre;

std::vector<Task> counting(int count) {
  std::vector<Task> tasks;
  for (int i = 0; i < count; ++i) {
    tasks.push_back({"task " + std::to_string(i), [i] {
                       std::this_thread::sleep_for(std::chrono::milliseconds((7 * i) % 5));
                       return std::to_string(i * i);
                     }});
  }
  return tasks;
}

TEST(Threads, GiveResultsInTheOrderOfTheTasks) {
  std::vector<std::string> expected;
  for (int i = 0; i < 40; ++i) {
    expected.push_back(std::to_string(i * i));
  }
  for (const int threads : {1, 2, 7, 100}) {
    const Results results = Threads(threads).run(counting(40), {});
    EXPECT_FALSE(results.stopped);
    EXPECT_EQ(results.bytes, expected) << threads << " threads";
  }
}

TEST(Threads, DoNotRunWhatIsKnownAndTellOfTheRest) {
  std::vector<std::size_t> told;
  Watch watch;
  watch.known = [](std::size_t task) {
    return task == 1 ? std::optional<std::string>("kept") : std::nullopt;
  };
  watch.done = [&](std::size_t task, const std::string& result, double seconds) {
    told.push_back(task);
    EXPECT_EQ(result, std::to_string(task * task));
    EXPECT_GE(seconds, 0.0);
  };
  EXPECT_THAT(Threads(2).run(counting(3), watch).bytes, ElementsAre("0", "kept", "4"));
  EXPECT_THAT(told, testing::UnorderedElementsAre(0U, 2U));
}

TEST(Threads, BeginWithTheLongest) {
  std::vector<Task> tasks = counting(4);
  tasks[0].seconds = 1.0;
  tasks[1].seconds = 5.0;
  tasks[3].seconds = 3.0;  // and of the third nothing is known: it may be the longest of all
  EXPECT_THAT(order_of(tasks), ElementsAre(2U, 1U, 3U, 0U));
}

TEST(Threads, StopBetweenTasksAndKeepWhatIsFinished) {
  std::atomic<bool> stop{false};
  int ran = 0;
  std::vector<Task> tasks = counting(5);
  for (Task& task : tasks) {
    task.run = [&] {
      stop = ++ran == 2;
      return std::string("done");
    };
  }
  Watch watch;
  watch.stop = &stop;
  const Results results = Threads(1).run(tasks, watch);
  EXPECT_TRUE(results.stopped);
  EXPECT_EQ(ran, 2);
  EXPECT_THAT(results.bytes, ElementsAre("done", "done", "", "", ""));
}

TEST(Threads, ThrowWhatATaskThrows) {
  std::vector<Task> tasks = counting(5);
  tasks[2].run = []() -> std::string { throw std::out_of_range("the third"); };
  EXPECT_THROW(Threads(2).run(tasks, {}), std::out_of_range);
}

}  // namespace
}  // namespace plumbline::work
