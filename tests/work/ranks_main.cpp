// What ranks_test.cpp runs under mpirun: some tasks whose results are printed by the first rank.
// Words: count [fail TASK] [differ] [slow MILLISECONDS] [nested] [shared FOLDER]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "work/workers.h"

namespace {

using plumbline::work::Task;
using plumbline::work::Workers;

struct Wishes {
  int count = 0, fail = -1, slow = 0;
  bool differ = false, nested = false;
  std::string shared;
};

Wishes read(int argc, char** argv) {
  Wishes wishes;
  wishes.count = std::atoi(argv[1]);
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "fail") {
      wishes.fail = std::atoi(argv[++i]);
    } else if (word == "slow") {
      wishes.slow = std::atoi(argv[++i]);
    } else if (word == "shared") {
      wishes.shared = argv[++i];
    }
    wishes.differ = wishes.differ || word == "differ";
    wishes.nested = wishes.nested || word == "nested";
  }
  return wishes;
}

std::string result_of(int task, const Wishes& wishes, Workers& workers) {
  std::this_thread::sleep_for(std::chrono::milliseconds(wishes.slow));
  if (task == wishes.fail) {
    throw std::runtime_error("task " + std::to_string(task) + " has failed");
  }
  std::string result(static_cast<std::size_t>(1 + task * 1000), static_cast<char>('a' + task % 26));
  if (wishes.nested) {
    const std::vector<Task> inner{{"inner", [task] { return std::to_string(task); }}};
    result += workers.run(inner, {}).bytes.front() + std::to_string(workers.ranks());
  }
  return result;
}

int work(Workers& workers, const Wishes& wishes) {
  if (!wishes.shared.empty()) {
    workers.check_shared(wishes.shared);
  }
  std::string before;
  for (int round = 0; round < 3; ++round) {  // what comes later depends on what came before
    std::vector<Task> tasks;
    for (int i = 0; i < wishes.count; ++i) {
      const std::string name = wishes.differ && !workers.is_first() ? "another" : "task";
      tasks.push_back({name + std::to_string(i), [&, i] { return before + result_of(i, wishes, workers); }});
    }
    std::size_t length = 0;
    for (const std::string& result : workers.run(tasks, {}).bytes) {
      length = 31 * length + std::hash<std::string>()(result);
    }
    before = std::to_string(length);
  }
  if (workers.is_first()) {
    std::printf("%s\n", before.c_str());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Wishes wishes = read(argc, argv);
  const auto workers = plumbline::work::start("");
  int status = 0;
  try {
    status = work(*workers, wishes);
  } catch (const std::exception& error) {
    status = 3;
    workers->fail(error.what());
    if (workers->is_first()) {
      std::fprintf(stderr, "first: %s\n", error.what());
    }
  }
  std::fflush(stdout);
  return workers->finish(status);
}
