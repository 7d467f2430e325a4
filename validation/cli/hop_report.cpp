#include "validation/cli/hop_report.h"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "validation/cli/output.h"

namespace plumbline::cli {

using validation::Hop;
using validation::HopRun;

nlohmann::json hops_json(const HopRun& run) {
  nlohmann::json hops = nlohmann::json::array();
  for (const Hop& hop : run.hops) {
    hops.push_back({{"landing", hop.landing},
                    {"period", hop.period},
                    {"travel", hop.travel},
                    {"torso", hop.torso},
                    {"torso_wanted", hop.torso_wanted},
                    {"touchdown_gap", hop.touchdown_gap},
                    {"largest_torque_mLA", hop.largest_torque_mLA},
                    {"largest_torque_mLS", hop.largest_torque_mLS},
                    {"time_at_limit", hop.time_at_limit},
                    {"largest_stretch_LA", hop.largest_stretch_LA},
                    {"largest_stretch_LS", hop.largest_stretch_LS},
                    {"lowest_hip", hop.lowest_hip},
                    {"highest_hip", hop.highest_hip}});
  }
  return hops;
}

void print_hops(const HopRun& run) {
  constexpr double kDegrees = 57.295779513082323;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t h = 0; h < run.hops.size(); ++h) {
    const Hop& hop = run.hops[h];
    rows.push_back(
        {fmt::format("{}", h + 1), fmt::format("{:.3f}", hop.landing), fmt::format("{:.3f}", hop.period),
         fmt::format("{:.3f}", hop.travel), fmt::format("{:.1f}", hop.torso * kDegrees),
         fmt::format("{:.1f}", 1e3 * hop.touchdown_gap),
         fmt::format("{:.1f} {:.1f}", hop.largest_torque_mLA, hop.largest_torque_mLS),
         fmt::format("{:.0f} {:.0f}", hop.largest_stretch_LA * kDegrees, hop.largest_stretch_LS * kDegrees)});
  }
  print_table({"hop", "landing s", "period s", "travel m", "torso deg", "gap ms", "torque LA LS N m",
               "stretch LA LS deg"},
              rows);
  fmt::print(
      "\n{} hops in {:.3f} s{}{}. Torque at its limit for {:.0f} ms. {:.3g} s of computing for each "
      "simulated second.\n",
      run.hops.size(), run.time, run.fell ? "; " : "", run.end, 1e3 * run.time_at_limit,
      run.time > 0.0 ? run.seconds / run.time : 0.0);
}

}  // namespace plumbline::cli
