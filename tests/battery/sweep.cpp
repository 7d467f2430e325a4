#include "tests/battery/sweep.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>

namespace plumbline::battery {
namespace {

constexpr std::array<double, 2> kFactors{0.5, 2.0};

bool is_same(const Result& one, const Result& other) {
  return one.verdict == other.verdict && one.first == other.first && one.others == other.others;
}

}  // namespace

std::vector<Swept> sweep(const std::vector<Case>& cases, const RunOptions& options) {
  std::vector<Swept> all;
  for (const validation::PolicyConstant& constant : validation::policy_constants()) {
    for (const double factor : kFactors) {
      validation::Policy policy = options.policy;
      constant.scale(policy, factor);
      all.push_back({constant.name, constant.value(policy), 0, 0, 0});
    }
  }
  for (const Case& one : cases) {
    RunOptions run = options;
    run.kept = std::make_shared<validation::KeptResults>();
    const Result as_it_is = run_case(one, run);
    fmt::print("{}: {} {} {}\n", one.name, as_it_is.verdict, as_it_is.first, as_it_is.others);
    std::size_t i = 0;
    for (const validation::PolicyConstant& constant : validation::policy_constants()) {
      for (const double factor : kFactors) {
        run.policy = options.policy;
        constant.scale(run.policy, factor);
        Swept& swept = all[i++];
        if (constant.value(run.policy) == constant.value(options.policy)) {
          continue;
        }
        const Result other = run_case(one, run);
        swept.changed += is_same(as_it_is, other) ? 0 : 1;
        swept.lost += as_it_is.right && !other.right ? 1 : 0;
        swept.won += !as_it_is.right && other.right ? 1 : 0;
        if (!is_same(as_it_is, other)) {
          fmt::print("  {} = {:g}: {} {} {}\n", constant.name, swept.value, other.verdict, other.first,
                     other.others);
        }
        std::fflush(stdout);
      }
    }
  }
  return all;
}

std::string sweep_text(const std::vector<Swept>& swept, std::size_t cases) {
  std::string text = fmt::format("{} cases\n{:<18} {:>8} {:>8} {:>6} {:>6}\n", cases, "constant", "value",
                                 "changed", "lost", "won");
  for (const Swept& one : swept) {
    text += fmt::format("{:<18} {:>8.3g} {:>8} {:>6} {:>6}\n", one.constant, one.value, one.changed, one.lost,
                        one.won);
  }
  return text;
}

}  // namespace plumbline::battery
