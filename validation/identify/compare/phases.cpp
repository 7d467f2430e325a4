#include "validation/identify/compare/phases.h"

#include <algorithm>
#include <cmath>

#include "simulator/sensing/differentiation.h"

namespace plumbline::validation {
namespace {

constexpr double kTurning = 0.1;       // share of the rms velocity below which a channel is turning
constexpr std::size_t kStretches = 8;  // between events; further ones share a column

/// Adds a group of phases; kind(k) says which of them sample k belongs to.
template <typename Kind>
void add_group(const std::string& group, const std::vector<std::string>& names, Eigen::Index samples,
               const Kind& kind, PhaseTable& table) {
  const std::size_t first = table.phases.size();
  for (const std::string& name : names) {
    table.phases.push_back({group, name});
    table.members.emplace_back();
  }
  for (Eigen::Index k = 0; k < samples; ++k) {
    table.members[first + kind(k)].push_back(k);
  }
}

Eigen::VectorXd velocity_of(const Trial& trial, const Measured& channel) {
  const auto options = sensing::DifferentiationOptions::acausal();
  if (channel.values.size() < options.window) {
    return Eigen::VectorXd::Zero(channel.values.size());
  }
  const Eigen::VectorXd velocity = sensing::differentiate(channel.values, trial.period, options);
  // A channel at rest has the rounding errors of the differences: no motion.
  const double nothing = 1e-12 * channel.values.cwiseAbs().maxCoeff() / trial.period;
  return velocity.unaryExpr([nothing](double v) { return std::abs(v) > nothing ? v : 0.0; });
}

/// Value below which a share of the values lies.
double quantile(const Eigen::VectorXd& values, double share) {
  std::vector<double> sorted(values.data(), values.data() + values.size());
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + at, sorted.end());
  return sorted[static_cast<std::size_t>(at)];
}

/// Which switches are closed at a sample: "flight", or their names joined.
std::string contact_at(const Trial& trial, Eigen::Index k) {
  std::string closed;
  for (const SwitchRecord& one : trial.switches) {
    if (one.values[k] != 0.0) {
      closed += (closed.empty() ? "" : " + ") + one.name;
    }
  }
  return closed.empty() ? "flight" : closed;
}

void add_contact(const Trial& trial, PhaseTable& table) {
  if (trial.switches.empty()) {
    return;
  }
  std::vector<std::string> names;
  std::vector<std::size_t> kinds;
  for (Eigen::Index k = 0; k < trial.samples(); ++k) {
    const std::string name = contact_at(trial, k);
    const auto known = std::find(names.begin(), names.end(), name);
    kinds.push_back(static_cast<std::size_t>(known - names.begin()));
    if (known == names.end()) {
      names.push_back(name);
    }
  }
  add_group(
      "contact", names, trial.samples(), [&](Eigen::Index k) { return kinds[static_cast<std::size_t>(k)]; },
      table);
}

void add_stance(const Trial& trial, PhaseTable& table) {
  constexpr Eigen::Index kTenths = 10;
  const std::vector<Stance> stances = stances_of(trial);
  if (stances.empty()) {
    return;
  }
  std::vector<std::string> names;
  for (Eigen::Index t = 0; t < kTenths; ++t) {
    names.push_back(std::to_string(10 * t) + "-" + std::to_string(10 * (t + 1)) + " %");
  }
  names.emplace_back("else");
  std::vector<std::size_t> tenth(static_cast<std::size_t>(trial.samples()), names.size() - 1);
  for (const Stance& stance : stances) {
    for (Eigen::Index k = stance.first; k < stance.end; ++k) {
      tenth[static_cast<std::size_t>(k)] =
          static_cast<std::size_t>(kTenths * (k - stance.first) / (stance.end - stance.first));
    }
  }
  add_group(
      "stance", names, trial.samples(), [&](Eigen::Index k) { return tenth[static_cast<std::size_t>(k)]; },
      table);
}

void add_events(const Trial& trial, PhaseTable& table) {
  if (trial.events.empty()) {
    return;
  }
  std::vector<std::string> names{"start"};
  for (std::size_t e = 0; e < std::min(trial.events.size(), kStretches - 1); ++e) {
    names.push_back("after " + std::to_string(e + 1));
  }
  if (trial.events.size() >= kStretches) {
    names.emplace_back("later");
  }
  add_group(
      "between events", names, trial.samples(),
      [&](Eigen::Index k) {
        const auto passed = std::upper_bound(trial.events.begin(), trial.events.end(), trial.time[k]);
        const auto stretch = static_cast<std::size_t>(passed - trial.events.begin());
        return std::min(stretch, names.size() - 1);
      },
      table);
}

}  // namespace

PhaseTable phases_of(const Trial& trial, const Measured& channel) {
  PhaseTable table;
  const Eigen::Index n = trial.samples();
  add_contact(trial, table);
  add_stance(trial, table);
  add_events(trial, table);
  add_group(
      "time", {"early", "middle", "late"}, n,
      [n](Eigen::Index k) { return static_cast<std::size_t>(3 * k / n); }, table);
  const Eigen::VectorXd velocity = velocity_of(trial, channel);
  const Eigen::VectorXd speed = velocity.cwiseAbs();
  const double slow = quantile(speed, 1.0 / 3.0);
  const double fast = quantile(speed, 2.0 / 3.0);
  add_group(
      "speed", {"slow", "medium", "fast"}, n,
      [&](Eigen::Index k) -> std::size_t { return speed[k] <= slow   ? 0
                                                  : speed[k] <= fast ? 1
                                                                     : 2; }, table);
  const double turning = kTurning * std::sqrt(velocity.squaredNorm() / static_cast<double>(n));
  add_group(
      "direction", {"backward", "turning", "forward"}, n,
      [&](Eigen::Index k) -> std::size_t {
        return velocity[k] < -turning ? 0 : velocity[k] > turning ? 2 : 1;
      },
      table);
  return table;
}

}  // namespace plumbline::validation
