#include "validation/identify/predict/problem.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <thread>

#include "simulator/trace/error.h"

namespace plumbline::validation {

void parallel_for(int count, int threads, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto loop = [&] {
    for (int i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        failure = failure ? failure : std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < std::min(threads, count); ++t) {
    others.emplace_back(loop);
  }
  loop();
  for (std::thread& thread : others) {
    thread.join();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

Data::Data(std::vector<Trial> all, const PredictOptions& options) : trials(std::move(all)), predict(options) {
  const auto first_test = std::stable_partition(trials.begin(), trials.end(),
                                                [](const Trial& one) { return one.role != Role::test; });
  tests.assign(std::make_move_iterator(first_test), std::make_move_iterator(trials.end()));
  trials.erase(first_test, trials.end());
  windows = cut_windows(trials, options);
  threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

Data Data::of_tests() const {
  Data copy = *this;
  copy.trials = tests;
  copy.tests.clear();
  copy.windows = cut_windows(copy.trials, predict);
  return copy.thinned(most_windows);
}

void Data::limit(std::size_t most) {
  if (most == 0) {
    throw InputError("found a limit of 0 windows, expected 1 at least");
  }
  const std::size_t all = windows.size();
  *this = thinned(most);
  most_windows = most;
  unused_windows += all - windows.size();
}

Data Data::thinned(std::size_t most) const {
  Data copy = *this;
  copy.windows.clear();
  for (const Role wanted : {Role::train, Role::held_out, Role::test}) {
    const std::vector<int> all = windows_of(wanted);
    const std::size_t count = std::min(most, all.size());
    for (std::size_t i = 0; i < count; ++i) {
      copy.windows.push_back(windows[static_cast<std::size_t>(all[i * all.size() / count])]);
    }
  }
  return copy;
}

Data Data::beginnings(double share) const { return beginnings(std::vector<double>(windows.size(), share)); }

Data Data::beginnings(const std::vector<double>& shares) const {
  Data copy = *this;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    copy.windows[w] = beginning_of(windows[w], trials[static_cast<std::size_t>(windows[w].trial)], shares[w]);
  }
  return copy;
}

Data Data::segments(double length) const {
  Data copy = *this;
  copy.windows.clear();
  for (const Window& window : windows) {
    const std::vector<Window> some =
        segments_of(window, trials[static_cast<std::size_t>(window.trial)], length);
    copy.windows.insert(copy.windows.end(), some.begin(), some.end());
  }
  return copy;
}

bool Data::has_segments() const {
  return std::any_of(windows.begin(), windows.end(), [](const Window& window) { return window.continues; });
}

Role Data::role(std::size_t window) const {
  return trials[static_cast<std::size_t>(windows[window].trial)].role;
}

std::vector<int> Data::all_windows() const {
  std::vector<int> all(windows.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> Data::windows_of(Role wanted) const {
  std::vector<int> chosen;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    if (role(w) == wanted) {
      chosen.push_back(static_cast<int>(w));
    }
  }
  return chosen;
}

PredictorPool::PredictorPool(const model::Model& model, const Data& data) : model_(model), data_(data) {
  idle_.resize(data.trials.size());
}

void PredictorPool::with(int window, const std::vector<FreeParameter>& parameters,
                         const Eigen::VectorXd& theta, const std::function<void(Predictor&)>& work) {
  if (data_.stop != nullptr && data_.stop->raised) {
    throw Stopped();
  }
  const auto trial = static_cast<std::size_t>(data_.windows[static_cast<std::size_t>(window)].trial);
  std::unique_ptr<Predictor> predictor;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!idle_[trial].empty()) {
      predictor = std::move(idle_[trial].back());
      idle_[trial].pop_back();
    }
  }
  if (!predictor) {
    predictor = std::make_unique<Predictor>(model_, data_.trials[trial], data_.predict);
  }
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double value = theta[static_cast<Eigen::Index>(p)];
    if (predictor->plant().value(parameters[p].id) != value) {
      parameters[p].set(predictor->plant(), value);
    }
  }
  const long before = predictor->evaluations();
  work(*predictor);
  evaluations_ += predictor->evaluations() - before;
  const std::lock_guard<std::mutex> lock(mutex_);
  idle_[trial].push_back(std::move(predictor));
}

double to_search(effects::Scale scale, double value) {
  switch (scale) {
    case effects::Scale::logarithm:
      return std::log(value);
    case effects::Scale::reciprocal:
      return std::isinf(value) ? 0.0 : 1.0 / value;
    case effects::Scale::linear:
      break;
  }
  return value;
}

double from_search(effects::Scale scale, double search) {
  switch (scale) {
    case effects::Scale::logarithm:
      return std::exp(search);
    case effects::Scale::reciprocal:
      return search == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / search;
    case effects::Scale::linear:
      break;
  }
  return search;
}

double search_slope(effects::Scale scale, double value) {
  switch (scale) {
    case effects::Scale::logarithm:
      return value;
    case effects::Scale::reciprocal:
      return -value * value;
    case effects::Scale::linear:
      break;
  }
  return 1.0;
}

}  // namespace plumbline::validation
