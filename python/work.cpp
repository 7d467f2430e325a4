#include "python/work.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace plumbline::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kLook{100};

/// What both threads see.
struct Shared {
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  bool news = false;
  std::string what;
  double fraction = 0.0;
  std::exception_ptr error;
};

/// Waits a little; true when there is something to report, with what it is.
bool wait_for_news(Shared& shared, bool& done, std::string& what, double& fraction) {
  const py::gil_scoped_release others_may_run;
  std::unique_lock<std::mutex> lock(shared.mutex);
  shared.ended.wait_for(lock, kLook, [&] { return shared.done; });
  done = shared.done;
  what = shared.what;
  fraction = shared.fraction;
  return std::exchange(shared.news, false);
}

void work_through(const std::function<void(const validation::StopFlag&, const validation::Progress&)>& work,
                  const validation::StopFlag& stop, Shared& shared) {
  const validation::Progress report = [&](const std::string& what, double fraction) {
    const std::lock_guard<std::mutex> lock(shared.mutex);
    shared.what = what;
    shared.fraction = fraction;
    shared.news = true;
  };
  std::exception_ptr error;
  try {
    work(stop, report);
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(shared.mutex);
  shared.error = error;
  shared.done = true;
  shared.ended.notify_all();
}

}  // namespace

bool run(const py::object& progress,
         const std::function<void(const validation::StopFlag&, const validation::Progress&)>& work) {
  Shared shared;
  validation::StopFlag stop;
  bool interrupted = false;
  std::exception_ptr from_python;
  std::thread thread(work_through, std::cref(work), std::cref(stop), std::ref(shared));
  for (bool done = false; !done;) {
    std::string what;
    double fraction = 0.0;
    const bool news = wait_for_news(shared, done, what, fraction);
    if (stop.raised) {
      continue;  // only the end is waited for
    }
    if (PyErr_CheckSignals() != 0) {
      PyErr_Clear();
      interrupted = true;
      stop.raised = true;
    } else if (news && !progress.is_none()) {
      try {
        progress(what, fraction);
      } catch (const py::error_already_set&) {
        from_python = std::current_exception();
        stop.raised = true;
      }
    }
  }
  thread.join();
  if (from_python) {
    std::rethrow_exception(from_python);
  }
  if (shared.error) {
    try {
      std::rethrow_exception(shared.error);
    } catch (const validation::Stopped&) {
      interrupted = true;
    }
  }
  return interrupted;
}

}  // namespace plumbline::python
