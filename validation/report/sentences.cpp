#include "validation/report/sentences.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "validation/diagnose/own_parameters.h"

namespace plumbline::validation {
namespace {

std::string names_of(const std::vector<Finding>& findings) {
  std::string names;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const bool last = i + 1 == findings.size();
    names += (i == 0 ? "" : last ? " and " : ", ") + findings[i].effect + " at " + findings[i].at;
  }
  return names;
}

/// The error that counts and its role: held-out where there is such a trial (0: there is none).
struct Judged {
  std::string role;
  double error = 0.0;
};

Judged judged(double train, double held_out) {
  return held_out > 0.0 ? Judged{"held-out", held_out} : Judged{"train", train};
}

Judged judged(const Rung& rung) { return judged(rung.train(), rung.held_out()); }

/// Model parameters that the fit moved by a deviation or more, the farthest first: "mass of arm by +2.2
/// deviations"; empty where none did.
std::string moved_parameters(const Diagnosis& diagnosis) {
  constexpr double kMoved = 1.0;
  constexpr std::size_t kShown = 3;
  std::vector<OwnParameter> moved = own_values(diagnosis.final_stage);
  moved.erase(std::remove_if(moved.begin(), moved.end(),
                             [](const OwnParameter& one) { return std::abs(one.shift()) < kMoved; }),
              moved.end());
  std::stable_sort(moved.begin(), moved.end(), [](const OwnParameter& a, const OwnParameter& b) {
    return std::abs(a.shift()) > std::abs(b.shift());
  });
  std::string said;
  for (std::size_t i = 0; i < std::min(kShown, moved.size()); ++i) {
    said += fmt::format("{}{} by {:+.1f} deviations", i == 0 ? "" : ", ", moved[i].label, moved[i].shift());
  }
  if (moved.size() > kShown) {
    said += fmt::format(" and {} more", moved.size() - kShown);
  }
  return said;
}

/// "The held-out error falls from 151.2 to 65.5 times the floor; this explains 81 % of the squared error above
/// the floor."
std::string fall_sentence(const Diagnosis& diagnosis) {
  const Judged first = judged(diagnosis.ladder.front());
  const Judged last = judged(diagnosis.ladder.back());
  const double before = first.error * first.error - 1.0;
  const double after = std::max(last.error * last.error - 1.0, 0.0);
  const std::string share =
      before > after && before > 0.0
          ? fmt::format(": {:.1f} % of the squared error above the floor is explained", 100.0 * (1.0 - after / before))
          : "";
  return fmt::format("the {} error {} from {:.2f} to {:.2f} times the floor{}.", last.role,
                     last.error <= first.error ? "falls" : "rises", first.error, last.error, share);
}

std::string whole_summary(const Diagnosis& diagnosis) {
  if (diagnosis.verdict == Verdict::missing && diagnosis.accepted.size() == 1) {
    return finding_sentences(diagnosis.accepted.front(), diagnosis.verdict);
  }
  if (diagnosis.verdict == Verdict::missing) {
    return fmt::format("Missing: {}. With them {}", names_of(diagnosis.accepted), fall_sentence(diagnosis));
  }
  return verdict_sentence(diagnosis);
}

}  // namespace

std::string verdict_sentence(const Diagnosis& diagnosis) {
  const Judged last = judged(diagnosis.ladder.back());
  const std::string moved = moved_parameters(diagnosis);
  switch (diagnosis.verdict) {
    case Verdict::nothing_missing:
      if (!moved.empty()) {
        return fmt::format(
            "Nothing is missing, but model parameters are off: {}. With the values fitted {}", moved,
            fall_sentence(diagnosis));
      }
      return fmt::format(
          "Nothing is missing: the model predicts the {} motion to {:.2f} times what the sensors "
          "alone would leave.",
          last.role, last.error);
    case Verdict::unexplained:
      if (!diagnosis.accepted.empty()) {
        return fmt::format("Found: {}, a part of what is missing. With {} {} No effect of the catalogue explains "
                           "the rest.",
                           names_of(diagnosis.accepted), diagnosis.accepted.size() == 1 ? "it" : "them",
                           fall_sentence(diagnosis));
      }
      return fmt::format(
          "Unexplained: the {} error stays {:.2f} times the floor, and no effect of the catalogue "
          "explains it.{}",
          last.role, last.error,
          moved.empty() ? "" : " Model parameters moved: " + moved + "; " + fall_sentence(diagnosis));
    case Verdict::missing:
      break;
  }
  return "";
}

std::string finding_sentences(const Finding& finding, Verdict verdict) {
  const Judged before = judged(finding.train_before, finding.held_out_before);
  const Judged after = judged(finding.train_after, finding.held_out_after);
  const std::string train = after.role == "train" ? ""
                                                  : fmt::format(" (train {:.2f} to {:.2f})",
                                                                finding.train_before, finding.train_after);
  return fmt::format(
      "{}: {} at {}. With it the {} error falls from {:.2f} to {:.2f} times the floor{}; {} chosen in "
      "{:.0f} % of the resamples.{}",
      verdict == Verdict::missing ? "Missing" : "A part", finding.effect, finding.at, after.role,
      before.error, after.error, train,
      finding.together_with.empty() ? "it was" : "together with " + finding.together_with + " it was",
      100.0 * finding.selected_share,
      finding.open_in_train
          ? " The train trials leave it open, with nothing as its best value: what is given is "
            "what the held-out ones ask for."
          : "");
}

namespace {

std::string of_segments(const Diagnosis& diagnosis) {
  const double first = diagnosis.ladder.front().length;
  const double last = diagnosis.ladder.back().length;
  if (std::isinf(first)) {
    return "";
  }
  const std::string where = fmt::format(
      "As given the model loses the motion: it was diagnosed on windows of about {:.2g} s, through contact "
      "too.",
      first);
  if (std::isinf(last)) {
    return where + " With what was found the last error is that of the whole windows.";
  }
  return last > first ? where + fmt::format(" What was found was followed over {:.2g} s.", last) : where;
}

/// On what part of the windows the model was diagnosed, how far it goes with what was found, and how many
/// windows end early; empty where that is the whole.
std::string part_sentence(const Diagnosis& diagnosis) {
  std::string said = of_segments(diagnosis);
  if (diagnosis.cut_windows > 0) {
    said += fmt::format(
        "{}{} of {} windows {} not followed to {} end in one piece: where the motion runs to depends more "
        "finely on where it begins than can be searched.",
        said.empty() ? "" : " ", diagnosis.cut_windows, diagnosis.windows,
        diagnosis.cut_windows == 1 ? "is" : "are", diagnosis.cut_windows == 1 ? "its" : "their");
  }
  return said;
}

/// Where the held-out error at the train trials' best values is much larger than the foretold one, which
/// decides (validation/predict/foretell.h): a caution with both; else empty.
std::string open_values_sentence(const Diagnosis& diagnosis) {
  constexpr double kMuch = 1.1;
  const Rung& last = diagnosis.ladder.back();
  const double granted = std::max(last.foretold(), 1.0);
  if (last.held_out() < kMuch * granted) {
    return "";
  }
  return fmt::format(
      "With caution: at the values that serve the train trials best the held-out error is {:.2f} times the "
      "floor. {:.2f} grants what the train trials leave open; ones that move as the held-out ones do would "
      "tell more.",
      last.held_out(), last.foretold());
}

}  // namespace

std::vector<std::string> remarks(const Diagnosis& diagnosis) {
  std::vector<std::string> said;
  for (const std::string& one : {open_values_sentence(diagnosis), part_sentence(diagnosis)}) {
    if (!one.empty()) {
      said.push_back(one);
    }
  }
  return said;
}

std::string summary(const Diagnosis& diagnosis) {
  if (diagnosis.ladder.empty()) {
    return "Nothing was finished.";
  }
  std::string said = whole_summary(diagnosis);
  for (const std::string& remark : remarks(diagnosis)) {
    said += " " + remark;
  }
  return said;
}

}  // namespace plumbline::validation
