#include "validation/cli/recipe_report.h"

#include <fmt/core.h>

#include <cmath>

#include "validation/cli/files.h"
#include "validation/cli/output.h"
#include "validation/studies/recipes/untold.h"

namespace plumbline::cli {
namespace {

using validation::IdentifiedValue;
using validation::Recipe;
using validation::RecipeResult;
using validation::Step;
using validation::StepResult;
using validation::Truth;
using validation::Unknown;

const double* true_value(const std::string& unknown, const Truth& truth) {
  const auto found = truth.find(unknown);
  return found == truth.end() ? nullptr : &found->second;
}

bool covers(const IdentifiedValue& finding, double truth) {
  return finding.lower <= truth && truth <= finding.upper;
}

/// In the target's kind: a share of the true value, or in the unknown's unit.
std::string error_text(const Unknown& unknown, const IdentifiedValue& finding, double truth) {
  const double error = finding.value - truth;
  const bool relative = unknown.target ? unknown.target->relative : truth != 0.0;
  return relative ? fmt::format("{:+.2f} %", 100.0 * error / truth) : fmt::format("{:+.2g}", error);
}

std::string target_text(const Unknown& unknown) {
  if (!unknown.target) {
    return "-";
  }
  return unknown.target->relative ? fmt::format("{:g} %", 100.0 * unknown.target->size)
                                  : fmt::format("{:g}", unknown.target->size);
}

std::string verdict_text(const Unknown& unknown, const IdentifiedValue& finding, const Truth& truth) {
  const double* value = true_value(unknown.name, truth);
  if (!finding.seen) {
    return "not seen";
  }
  if (value == nullptr) {
    return "-";
  }
  std::string inside = covers(finding, *value) ? "inside" : "outside";
  switch (verdict_of(unknown, finding, truth)) {
    case Verdict::met:
      return "met, " + inside;
    case Verdict::missed:
      return "missed, " + inside;
    case Verdict::none:
      break;
  }
  return inside;
}

std::vector<std::string> row(const Unknown& unknown, const IdentifiedValue& finding, const Truth& truth) {
  const double* value = true_value(unknown.name, truth);
  return {unknown.name,
          unknown.unit,
          value == nullptr ? "-" : fmt::format("{:.5g}", *value),
          fmt::format("{:.5g}", finding.value),
          fmt::format("{:.5g} to {:.5g}", finding.lower, finding.upper),
          value == nullptr ? "-" : error_text(unknown, finding, *value),
          target_text(unknown),
          verdict_text(unknown, finding, truth)};
}

/// What the data could tell: nothing is recovered, and the values are the model's own.
std::vector<std::string> information_row(const Unknown& unknown, const IdentifiedValue& finding) {
  const double share = finding.deviation / std::abs(finding.value);
  return {unknown.name, unknown.unit, fmt::format("{:.5g}", finding.value),
          finding.seen ? fmt::format("{:.2g}", finding.deviation) : "inf",
          finding.seen ? fmt::format("{:.2g} %", 100.0 * share) : "not seen"};
}

void print_findings(const Recipe& recipe, const Step& step, const StepResult& result, const Truth& truth,
                    double confidence) {
  const bool information = step.method == "information";
  std::vector<std::vector<std::string>> rows;
  for (const IdentifiedValue& finding : result.findings) {
    const Unknown& unknown = recipe.unknown(finding.unknown);
    rows.push_back(information ? information_row(unknown, finding) : row(unknown, finding, truth));
  }
  if (information) {
    print_table({"unknown", "unit", "value (of the model)", "standard deviation", "as a share"}, rows);
  } else {
    print_table({"unknown", "unit", "true", "recovered", fmt::format("{:g} % interval", 100.0 * confidence),
                 "error", "target", "verdict"},
                rows);
  }
}

std::string untold_text(const validation::Untold& untold) {
  if (!std::isfinite(untold.width)) {
    return "  not identifiable from these data: " + untold.unknown;
  }
  const validation::StrongCorrelation& pair = untold.strongest;
  const std::string partner = pair.one == untold.unknown ? pair.other : pair.one;
  return fmt::format("  not identifiable from these data: {} (its interval is {:.0f} % of its size wide{})",
                     untold.unknown, 100.0 * untold.width,
                     partner.empty() ? "" : fmt::format("; trades with {}", partner));
}

void print_step(const Recipe& recipe, const Step& step, const StepResult& result, const Truth& truth,
                double confidence) {
  fmt::print("{}: {} ({}{})\n", step.name, step.title, step.source,
             step.method == "information" ? "; what is identifiable, nothing recovered"
             : step.carried               ? ""
                                          : "; for comparison");
  print_findings(recipe, step, result, truth, confidence);
  for (const validation::StrongCorrelation& one : result.correlations) {
    fmt::print("  correlated {:+.3f}: {} and {}\n", one.value, one.one, one.other);
  }
  for (const validation::WeakDirection& weak : result.weak) {
    std::string parts;
    for (const auto& [name, part] : weak.parts) {
      parts += fmt::format("{}{:+.2f} {}", parts.empty() ? "" : " ", part, name);
    }
    fmt::print("  hardly identifiable (known to within {:.2g} times the values): {}\n", weak.deviation,
               parts);
  }
  if (step.method != "information") {
    for (const validation::Untold& one : untold(recipe, result)) {
      fmt::print("{}\n", untold_text(one));
    }
  }
  if (result.after > 0.0) {
    fmt::print("  error in units of the floor: {:.3f} before, {:.3f} after; {} {}; {:.1f} s{}\n",
               result.before, result.after, result.windows,
               step.method == "posture_fit" ? "postures" : "windows", result.seconds,
               result.converged ? "" : "; not settled");
  }
  fmt::print("\n");
}

struct Counts {
  int covered = 0, known = 0, met = 0, targets = 0;
};

Counts counts_of(const Recipe& recipe, const RecipeResult& result) {
  Counts counts;
  for (std::size_t s = 0; s < recipe.steps.size(); ++s) {
    if (!recipe.steps[s].carried) {
      continue;
    }
    for (const IdentifiedValue& finding : result.steps[s].findings) {
      const double* value = true_value(finding.unknown, result.truth);
      if (value == nullptr || !finding.seen) {
        continue;
      }
      ++counts.known;
      counts.covered += covers(finding, *value) ? 1 : 0;
      const Verdict verdict = verdict_of(recipe.unknown(finding.unknown), finding, result.truth);
      counts.targets += verdict == Verdict::none ? 0 : 1;
      counts.met += verdict == Verdict::met ? 1 : 0;
    }
  }
  return counts;
}

nlohmann::json finding_json(const Recipe& recipe, const IdentifiedValue& finding, const Truth& truth) {
  const Unknown& unknown = recipe.unknown(finding.unknown);
  const double* value = true_value(finding.unknown, truth);
  nlohmann::json json{{"unknown", finding.unknown},
                      {"unit", unknown.unit},
                      {"true", nullptr},
                      {"recovered", json_number(finding.value)},
                      {"standard_deviation", json_number(finding.deviation)},
                      {"interval", {json_number(finding.lower), json_number(finding.upper)}},
                      {"seen", finding.seen},
                      {"covered", nullptr},
                      {"target", nullptr},
                      {"met", nullptr}};
  if (value != nullptr) {
    json["true"] = *value;
    json["covered"] = covers(finding, *value);
  }
  if (unknown.target) {
    json["target"] = {{"size", unknown.target->size}, {"relative", unknown.target->relative}};
    const Verdict verdict = verdict_of(unknown, finding, truth);
    if (verdict != Verdict::none) {
      json["met"] = verdict == Verdict::met;
    }
  }
  return json;
}

nlohmann::json step_json(const Recipe& recipe, const Step& step, const StepResult& result,
                         const Truth& truth) {
  nlohmann::json json{{"step", step.name},
                      {"title", step.title},
                      {"source", step.source},
                      {"method", step.method},
                      {"carried", step.carried},
                      {"before", result.before},
                      {"after", result.after},
                      {"used", result.windows},
                      {"converged", result.converged},
                      {"seconds", result.seconds},
                      {"findings", nlohmann::json::array()},
                      {"correlations", nlohmann::json::array()},
                      {"not_identifiable", nlohmann::json::array()},
                      {"weak", nlohmann::json::array()}};
  for (const IdentifiedValue& finding : result.findings) {
    // Nothing is recovered where only information is asked for.
    json["findings"].push_back(finding_json(recipe, finding, step.method == "information" ? Truth{} : truth));
  }
  for (const validation::StrongCorrelation& one : result.correlations) {
    json["correlations"].push_back({{"one", one.one}, {"other", one.other}, {"correlation", one.value}});
  }
  if (step.method != "information") {
    for (const validation::Untold& one : untold(recipe, result)) {
      json["not_identifiable"].push_back({{"unknown", one.unknown}, {"width", json_number(one.width)}});
    }
  }
  for (const validation::WeakDirection& weak : result.weak) {
    nlohmann::json parts = nlohmann::json::array();
    for (const auto& [name, part] : weak.parts) {
      parts.push_back({{"unknown", name}, {"part", part}});
    }
    json["weak"].push_back({{"deviation", json_number(weak.deviation)}, {"parts", parts}});
  }
  return json;
}

}  // namespace

Verdict verdict_of(const Unknown& unknown, const IdentifiedValue& finding, const Truth& truth) {
  const double* value = true_value(unknown.name, truth);
  if (!unknown.target || value == nullptr || !finding.seen) {
    return Verdict::none;
  }
  const double allowed = unknown.target->size * (unknown.target->relative ? std::abs(*value) : 1.0);
  return std::abs(finding.value - *value) <= allowed ? Verdict::met : Verdict::missed;
}

bool targets_met(const Recipe& recipe, const RecipeResult& result) {
  const Counts counts = counts_of(recipe, result);
  return counts.met == counts.targets;
}

void print_recipe(const Recipe& recipe, const RecipeResult& result, double confidence) {
  fmt::print("{}\n\n", recipe.title);
  for (std::size_t s = 0; s < recipe.steps.size(); ++s) {
    print_step(recipe, recipe.steps[s], result.steps[s], result.truth, confidence);
  }
  const Counts counts = counts_of(recipe, result);
  if (counts.known > 0) {
    fmt::print(
        "Without the steps for comparison: {} of {} targets met; {} of {} true values inside their {:g} % "
        "intervals.\n",
        counts.met, counts.targets, counts.covered, counts.known, 100.0 * confidence);
  }
}

nlohmann::json recipe_json(const Recipe& recipe, const RecipeResult& result, double confidence) {
  const Counts counts = counts_of(recipe, result);
  nlohmann::json json{{"recipe", recipe.file},     {"title", recipe.title},
                      {"confidence", confidence},  {"covered", counts.covered},
                      {"known", counts.known},     {"targets_met", counts.met},
                      {"targets", counts.targets}, {"steps", nlohmann::json::array()}};
  for (std::size_t s = 0; s < recipe.steps.size(); ++s) {
    json["steps"].push_back(step_json(recipe, recipe.steps[s], result.steps[s], result.truth));
  }
  return json;
}

}  // namespace plumbline::cli
