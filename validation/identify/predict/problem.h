// What an estimate is made from: one model, its trials cut into windows, and both cores.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

/// Set by Ctrl-C: long work looks at it and ends cleanly.
struct StopFlag {
  std::atomic<bool> raised{false};
};

/// Thrown when work was stopped by the user.
struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("stopped by the user") {}
};

/// Calls work(i) for i in [0, count) on `threads` threads; the first exception is thrown again here.
void parallel_for(int count, int threads, const std::function<void(int)>& work);

class KeptResults;

/// Trials and their windows, shared by all models that are tried on them. Those of role test are kept apart:
/// what is fitted, and what chooses, never sees them.
struct Data {
  std::vector<Trial> trials;
  std::vector<Window> windows;
  PredictOptions predict;
  int threads = 2;
  const StopFlag* stop = nullptr;
  std::shared_ptr<KeptResults> kept{};  ///< where long work keeps its results (kept_results.h); may be empty
  std::vector<Trial> tests{};           ///< trials of role test; none of them is among `trials`
  /// Of each role so many windows are used at most, and so many of train and held-out are not (limit()).
  std::size_t most_windows = std::numeric_limits<std::size_t>::max(), unused_windows = 0;

  Data(std::vector<Trial> all, const PredictOptions& options);
  /// The tests as its trials, cut into windows.
  Data of_tests() const;
  /// The same trials with at most `most` windows of each role, spread evenly.
  Data thinned(std::size_t most) const;
  /// From now on these are all the windows that there are: of each role `most` at most, spread evenly over
  /// its trials, tests included. Throws InputError when `most` is 0.
  void limit(std::size_t most);
  /// The same windows, of each the first `share` of its length, with the contact events in it.
  Data beginnings(double share) const;
  /// The same with a share for each window.
  Data beginnings(const std::vector<double>& shares) const;
  /// The same windows in segments of about `length` s (segments_of).
  Data segments(double length) const;
  bool has_segments() const;  ///< that begin where another one ends
  Role role(std::size_t window) const;
  std::vector<int> all_windows() const;
  std::vector<int> windows_of(Role wanted) const;
  bool has(Role role) const { return !windows_of(role).empty(); }
};

/// Predictors for one model, lent to one thread at a time. Parameter values are set at every loan, because
/// another loan may have left others.
class PredictorPool {
 public:
  PredictorPool(const model::Model& model, const Data& data);

  /// Runs `work` with a predictor of the window's trial whose free parameters have the values `theta`.
  void with(int window, const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
            const std::function<void(Predictor&)>& work);
  const Data& data() const { return data_; }
  const model::Model& model() const { return model_; }
  long evaluations() const { return evaluations_; }

 private:
  model::Model model_;
  const Data& data_;
  std::mutex mutex_;
  std::vector<std::vector<std::unique_ptr<Predictor>>> idle_;  // by trial
  std::atomic<long> evaluations_{0};
};

/// theta in the coordinates in which a parameter is searched, and back (Scale).
double to_search(effects::Scale scale, double value);
double from_search(effects::Scale scale, double search);
/// d(value)/d(search) at the value.
double search_slope(effects::Scale scale, double value);

}  // namespace plumbline::validation
