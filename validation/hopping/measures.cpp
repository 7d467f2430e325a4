#include "validation/hopping/measures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace plumbline::validation {
namespace {

using controllers::HoppingConfig;
using Kind = Measure::Kind;

constexpr std::size_t kTransient = 5, kFall = 3;  // hops

using OfHop = double (*)(const Hop&, const HoppingConfig&);

const std::map<std::string, OfHop>& of_hops() {
  static const std::map<std::string, OfHop> all{
      {"period", [](const Hop& h, const HoppingConfig&) { return h.period; }},
      {"travel", [](const Hop& h, const HoppingConfig&) { return h.travel; }},
      {"tower_turn", [](const Hop& h, const HoppingConfig& c) { return h.travel / c.boom_length; }},
      {"torso_at_landing", [](const Hop& h, const HoppingConfig&) { return h.torso; }},
      {"touchdown_gap", [](const Hop& h, const HoppingConfig&) { return h.touchdown_gap; }},
      {"stretch_LA", [](const Hop& h, const HoppingConfig&) { return h.largest_stretch_LA; }},
      {"stretch_LS", [](const Hop& h, const HoppingConfig&) { return h.largest_stretch_LS; }},
      {"stretch", [](const Hop& h,
                     const HoppingConfig&) { return std::max(h.largest_stretch_LA, h.largest_stretch_LS); }},
      {"torque_mLA", [](const Hop& h, const HoppingConfig&) { return h.largest_torque_mLA; }},
      {"torque_mLS", [](const Hop& h, const HoppingConfig&) { return h.largest_torque_mLS; }},
      {"time_at_limit", [](const Hop& h, const HoppingConfig&) { return h.time_at_limit; }},
      {"hip_swing", [](const Hop& h, const HoppingConfig&) { return h.highest_hip - h.lowest_hip; }},
  };
  return all;
}

}  // namespace

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all{
      {"hops", "1", Kind::of_a_run, "hops in a row from the default start, at most those asked for"},
      {"hops_tuned_rigid", "1", Kind::of_a_run,
       "hops in a row over the starts with the gains that were found on rigid cables"},
      {"growth", "1", Kind::of_an_orbit,
       "largest multiplier of the orbit, with the update of the torso's angle"},
      {"growth_without_update", "1", Kind::of_an_orbit, "the same without the update"},
      {"period", "s", Kind::of_a_hop, "from landing to landing"},
      {"travel", "m", Kind::of_a_hop,
       "of the hip along its circle, from landing to landing, forward positive"},
      {"tower_turn", "rad", Kind::of_a_hop, "travel over the boom's length"},
      {"torso_at_landing", "rad", Kind::of_a_hop, "when both feet are down, leaning backward positive"},
      {"touchdown_gap", "s", Kind::of_a_hop, "from the first foot's contact to the second's"},
      {"stretch", "rad", Kind::of_a_hop, "largest |c(q)| of the four cables in a hop, angle of the motor"},
      {"stretch_LA", "rad", Kind::of_a_hop, "the same of the leg angles' cables"},
      {"stretch_LS", "rad", Kind::of_a_hop, "the same of the leg shapes' cables"},
      {"torque_mLA", "N m", Kind::of_a_hop, "largest command to a leg-angle motor in a hop"},
      {"torque_mLS", "N m", Kind::of_a_hop, "largest command to a leg-shape motor in a hop"},
      {"time_at_limit", "s", Kind::of_a_hop,
       "time in a hop that a motor's command is at its limit, all motors"},
      {"hip_swing", "m", Kind::of_a_hop, "highest less lowest hip in a hop"},
      {"joint_angle_of_stretch_LA", "1", Kind::of_a_model,
       "angle of the joint for an angle of stretch, leg angle"},
      {"joint_angle_of_stretch_LS", "1", Kind::of_a_model,
       "angle of the joint for an angle of stretch, leg shape"},
  };
  return all;
}

const Measure* find_measure(const std::string& name) {
  for (const Measure& measure : measures()) {
    if (measure.name == name) {
      return &measure;
    }
  }
  return nullptr;
}

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  spread.count = static_cast<long>(values.size());
  const double n = static_cast<double>(values.size());
  for (const double value : values) {
    spread.mean += value / n;
  }
  for (const double value : values) {
    spread.deviation += (value - spread.mean) * (value - spread.mean);
  }
  spread.deviation = values.size() > 1 ? std::sqrt(spread.deviation / (n - 1.0)) : 0.0;
  return spread;
}

std::vector<Hop> settled_hops(const std::vector<HopRun>& runs) {
  std::vector<Hop> settled;
  for (const HopRun& run : runs) {
    const std::size_t end = run.hops.size() - (run.fell ? std::min(kFall, run.hops.size()) : 0);
    for (std::size_t h = kTransient; h < end; ++h) {
      settled.push_back(run.hops[h]);
    }
  }
  return settled;
}

double measure_of(const Measure& measure, const Hop& hop, const HoppingConfig& config) {
  const auto found = of_hops().find(measure.name);
  if (found == of_hops().end()) {
    throw std::invalid_argument(measure.name + " is not measured hop by hop");
  }
  return found->second(hop, config);
}

}  // namespace plumbline::validation
