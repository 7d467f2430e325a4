#include "validation/report/sentences.h"

#include <fmt/core.h>

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

}  // namespace

std::string verdict_sentence(const Diagnosis& diagnosis) {
  const Rung& last = diagnosis.ladder.back();
  switch (diagnosis.verdict) {
    case Verdict::nothing_missing:
      return fmt::format(
          "Nothing is missing: the model predicts the held-out motion to {:.2f} times what the sensors "
          "alone would leave.",
          last.held_out());
    case Verdict::unexplained:
      return fmt::format(
          "Unexplained: the held-out error stays {:.2f} times the floor, and no effect of the catalogue "
          "explains it.{}",
          last.held_out(),
          diagnosis.accepted.empty() ? "" : " What follows helps, but is not the whole answer.");
    case Verdict::missing:
      break;
  }
  return "";
}

std::string finding_sentences(const Finding& finding, Verdict verdict) {
  return fmt::format(
      "{}: {} at {}. With it the held-out error falls from {:.2f} to {:.2f} times the floor "
      "(train {:.2f} to {:.2f}); it was chosen in {:.0f} % of the resamples.",
      verdict == Verdict::missing ? "Missing" : "A part", finding.effect, finding.at, finding.held_out_before,
      finding.held_out_after, finding.train_before, finding.train_after, 100.0 * finding.selected_share);
}

std::string summary(const Diagnosis& diagnosis) {
  if (diagnosis.ladder.empty()) {
    return "Nothing was finished.";
  }
  if (diagnosis.verdict == Verdict::missing && diagnosis.accepted.size() == 1) {
    return finding_sentences(diagnosis.accepted.front(), diagnosis.verdict);
  }
  const double first = diagnosis.ladder.front().held_out();
  const double last = diagnosis.ladder.back().held_out();
  if (diagnosis.verdict == Verdict::missing) {
    return fmt::format(
        "Missing: {}. With them the held-out error falls from {:.2f} to {:.2f} times the floor; {:.1f} % of "
        "the squared error above the floor stays unexplained.",
        names_of(diagnosis.accepted), first, last, 100.0 * diagnosis.unexplained_share);
  }
  if (diagnosis.accepted.empty()) {
    return verdict_sentence(diagnosis);
  }
  return fmt::format(
      "Unexplained: the held-out error stays {:.2f} times the floor. {} help{}, from {:.2f} times the floor, "
      "but {} not the whole answer.",
      last, names_of(diagnosis.accepted), diagnosis.accepted.size() == 1 ? "s" : "", first,
      diagnosis.accepted.size() == 1 ? "is" : "are");
}

}  // namespace plumbline::validation
