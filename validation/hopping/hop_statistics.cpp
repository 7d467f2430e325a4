#include "validation/hopping/hop_statistics.h"

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

#include "validation/hopping/measures.h"
#include "validation/predict/problem.h"

namespace plumbline::validation {

std::vector<HopStart> draw_starts(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> drop(0.03, 0.07);
  std::uniform_real_distribution<double> speed(-0.6, -0.1);
  std::uniform_real_distribution<double> torso(-0.02, 0.02);
  std::vector<HopStart> starts(static_cast<std::size_t>(count));
  for (HopStart& start : starts) {
    start.drop = drop(random);
    start.speed = speed(random);
    start.torso = torso(random);
  }
  return starts;
}

std::vector<std::vector<HopRun>> hop_all(const model::Model& model,
                                         const std::vector<controllers::HoppingConfig>& configs,
                                         const std::vector<HopStart>& starts, const HopOptions& options,
                                         const std::function<void(int)>& progress) {
  std::vector<std::vector<HopRun>> runs(configs.size(), std::vector<HopRun>(starts.size()));
  std::atomic<int> done{0};
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  parallel_for(static_cast<int>(configs.size() * starts.size()), threads, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const std::size_t config = k / starts.size(), start = k % starts.size();
    runs[config][start] = hop(model, configs[config], starts[start], options);
    const int count = ++done;
    if (progress) {
      progress(count);
    }
  });
  return runs;
}

std::vector<HopRun> hop_from(const model::Model& model, const controllers::HoppingConfig& config,
                             const std::vector<HopStart>& starts, const HopOptions& options,
                             const std::function<void(int)>& progress) {
  return hop_all(model, {config}, starts, options, progress).front();
}

HopStatistics statistics_of(const std::vector<HopRun>& runs, long enough) {
  HopStatistics all;
  all.starts = static_cast<int>(runs.size());
  std::vector<double> counts;
  for (const HopRun& run : runs) {
    counts.push_back(static_cast<double>(run.hops.size()));
    all.sustained += static_cast<long>(run.hops.size()) >= enough ? 1 : 0;
  }
  const std::vector<Hop> hops = settled_hops(runs);
  const double share = hops.empty() ? 0.0 : 1.0 / static_cast<double>(hops.size());
  for (const Hop& hop : hops) {
    all.period += share * hop.period;
    all.travel += share * hop.travel;
    all.torso += share * hop.torso;
    all.touchdown_gap += share * hop.touchdown_gap;
    all.stretch_LA += share * hop.largest_stretch_LA;
    all.stretch_LS += share * hop.largest_stretch_LS;
    all.torque_mLA += share * hop.largest_torque_mLA;
    all.torque_mLS += share * hop.largest_torque_mLS;
    all.time_at_limit += share * hop.time_at_limit;
  }
  if (!counts.empty()) {
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::nth_element(counts.begin(), middle, counts.end());
    all.median_hops = *middle;
  }
  return all;
}

}  // namespace plumbline::validation
