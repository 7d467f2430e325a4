#include "validation/hopping/hop_statistics.h"

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

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

std::vector<HopRun> hop_from(const model::Model& model, const controllers::HoppingConfig& config,
                             const std::vector<HopStart>& starts, const HopOptions& options,
                             const std::function<void(int)>& progress) {
  std::vector<HopRun> runs(starts.size());
  std::atomic<int> done{0};
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  parallel_for(static_cast<int>(starts.size()), threads, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    runs[k] = hop(model, config, starts[k], options);
    const int count = ++done;
    if (progress) {
      progress(count);
    }
  });
  return runs;
}

HopStatistics statistics_of(const std::vector<HopRun>& runs, long enough) {
  HopStatistics all;
  all.starts = static_cast<int>(runs.size());
  std::vector<double> counts;
  double hops = 0.0;
  for (const HopRun& run : runs) {
    counts.push_back(static_cast<double>(run.hops.size()));
    const bool sustained = static_cast<long>(run.hops.size()) >= enough;
    all.sustained += sustained ? 1 : 0;
    for (std::size_t h = run.hops.size() / 2; h < run.hops.size(); ++h) {
      const Hop& hop = run.hops[h];
      hops += 1.0;
      all.period += hop.period;
      all.travel += hop.travel;
      all.torso += hop.torso;
      all.touchdown_gap += hop.touchdown_gap;
      all.stretch_LA += hop.largest_stretch_LA;
      all.stretch_LS += hop.largest_stretch_LS;
      all.torque_mLA += hop.largest_torque_mLA;
      all.torque_mLS += hop.largest_torque_mLS;
    }
  }
  for (double* mean : {&all.period, &all.travel, &all.torso, &all.touchdown_gap, &all.stretch_LA,
                       &all.stretch_LS, &all.torque_mLA, &all.torque_mLS}) {
    *mean = hops > 0.0 ? *mean / hops : 0.0;
  }
  if (!counts.empty()) {
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::nth_element(counts.begin(), middle, counts.end());
    all.median_hops = *middle;
  }
  return all;
}

}  // namespace plumbline::validation
