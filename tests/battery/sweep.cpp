#include "tests/battery/sweep.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <utility>

namespace plumbline::battery {
namespace {

constexpr std::array<double, 2> kFactors{0.5, 2.0};

bool is_same(const Result& one, const Result& other) {
  return one.verdict == other.verdict && one.first == other.first && one.others == other.others;
}

/// Each with the policy as it is, then with each of the others, which are a constant and its value.
std::vector<Swept> swept_over(const std::vector<Diagnose>& diagnoses, const RunOptions& options,
                              const std::vector<std::pair<validation::PolicyConstant, double>>& others) {
  std::vector<Swept> all;
  all.reserve(others.size());
  for (const auto& [constant, value] : others) {
    all.push_back({constant.name, value, 0, 0, 0});
  }
  for (const Diagnose& diagnose : diagnoses) {
    RunOptions run = options;
    run.kept = std::make_shared<validation::KeptResults>();
    const Result as_it_is = diagnose(run);
    fmt::print("{}: {} {} {} ({:.3f} to {:.3f}, {:.0f} s)\n", as_it_is.one.name, as_it_is.verdict,
               as_it_is.first, as_it_is.others, as_it_is.before, as_it_is.after, as_it_is.seconds);
    for (std::size_t i = 0; i < others.size(); ++i) {
      run.policy = options.policy;
      others[i].first.set(run.policy, others[i].second);
      Swept& swept = all[i];
      const Result other = diagnose(run);
      swept.changed += is_same(as_it_is, other) ? 0 : 1;
      swept.lost += as_it_is.right && !other.right ? 1 : 0;
      swept.won += !as_it_is.right && other.right ? 1 : 0;
      swept.seconds += other.seconds;
      if (!is_same(as_it_is, other)) {
        fmt::print("  {} = {:g}: {} {} {} ({:.3f}, {:.0f} s){}\n", swept.constant, swept.value, other.verdict,
                   other.first, other.others, other.after, other.seconds,
                   as_it_is.right == other.right ? ""
                   : other.right                 ? ": right now"
                                                 : ": wrong now");
      }
      std::fflush(stdout);
    }
  }
  return all;
}

}  // namespace

std::vector<Swept> sweep(const std::vector<Diagnose>& diagnoses, const RunOptions& options) {
  std::vector<std::pair<validation::PolicyConstant, double>> others;
  for (const validation::PolicyConstant& constant : validation::policy_constants()) {
    for (const double factor : kFactors) {
      validation::Policy policy = options.policy;
      constant.scale(policy, factor);
      if (constant.value(policy) != constant.value(options.policy)) {
        others.emplace_back(constant, constant.value(policy));
      }
    }
  }
  return swept_over(diagnoses, options, others);
}

std::vector<Swept> take_away(const std::vector<Diagnose>& diagnoses, const RunOptions& options) {
  std::vector<std::pair<validation::PolicyConstant, double>> others;
  for (const validation::PolicyConstant& constant : validation::policy_constants()) {
    if (constant.absent) {
      others.emplace_back(constant, *constant.absent);
    }
  }
  return swept_over(diagnoses, options, others);
}

std::string sweep_text(const std::vector<Swept>& swept, std::size_t diagnoses) {
  std::string text = fmt::format("{} diagnoses\n{:<18} {:>8} {:>8} {:>6} {:>6} {:>8}\n", diagnoses,
                                 "constant", "value", "changed", "lost", "won", "s");
  for (const Swept& one : swept) {
    text += fmt::format("{:<18} {:>8.3g} {:>8} {:>6} {:>6} {:>8.0f}\n", one.constant, one.value, one.changed,
                        one.lost, one.won, one.seconds);
  }
  return text;
}

}  // namespace plumbline::battery
