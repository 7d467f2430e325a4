#include "validation/report/sentences.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "validation/identify/diagnose/own_parameters.h"

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

/// "arm:mass by +2.2, drive:torque_constant by -2.0 deviations": the model's own numbers that moved, the
/// farthest first, where the model as given is clearly above the floor and the error fell with them; else
/// empty.
std::string moved_numbers(const Diagnosis& diagnosis) {
  constexpr double kClearly = 1.2;  // floors: as Policy::finished
  constexpr double kMoved = 0.5;    // deviations; less is what any fit does
  constexpr std::size_t kShown = 4;
  const double given = judged(diagnosis.ladder.front()).error;
  if (given < kClearly || judged(diagnosis.ladder.back()).error >= given) {
    return "";
  }
  std::vector<OwnParameter> own = own_values(diagnosis.final_stage);
  own.erase(std::remove_if(own.begin(), own.end(),
                           [](const OwnParameter& one) { return std::abs(one.shift()) < kMoved; }),
            own.end());
  std::stable_sort(own.begin(), own.end(), [](const OwnParameter& a, const OwnParameter& b) {
    return std::abs(a.shift()) > std::abs(b.shift());
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(own.size(), kShown); ++i) {
    text += fmt::format("{}{} by {:+.1f}", i > 0 ? ", " : "", own[i].label, own[i].shift());
  }
  if (!text.empty()) {
    text += " deviations";
  }
  return own.size() > kShown ? text + fmt::format(", and {} more", own.size() - kShown) : text;
}

/// "the held-out error falls from 151.20 to 65.50 times the floor: 81.2 % of the squared error above the
/// floor is explained."
std::string fall_sentence(const Diagnosis& diagnosis) {
  const Judged first = judged(diagnosis.ladder.front());
  const Judged last = judged(diagnosis.ladder.back());
  const double before = first.error * first.error - 1.0;
  const double after = std::max(last.error * last.error - 1.0, 0.0);
  const std::string share = before > after
                                ? fmt::format(": {:.1f} % of the squared error above the floor is explained",
                                              100.0 * (1.0 - after / before))
                                : "";
  return fmt::format("the {} error {} from {:.2f} to {:.2f} times the floor{}.", last.role,
                     last.error <= first.error ? "falls" : "rises", first.error, last.error, share);
}

std::string whole_summary(const Diagnosis& diagnosis) {
  if (diagnosis.verdict == Verdict::missing && diagnosis.accepted.size() == 1) {
    return finding_sentences(diagnosis.accepted.front(), diagnosis);
  }
  if (diagnosis.verdict == Verdict::missing) {
    return fmt::format("Missing: {}. With them {}", names_of(diagnosis.accepted), fall_sentence(diagnosis));
  }
  return verdict_sentence(diagnosis);
}

}  // namespace

std::string verdict_sentence(const Diagnosis& diagnosis) {
  const Judged last = judged(diagnosis.ladder.back());
  switch (diagnosis.verdict) {
    case Verdict::nothing_missing: {
      const std::string moved = moved_numbers(diagnosis);
      if (!moved.empty()) {
        return fmt::format(
            "Nothing is missing once numbers of the model move within what is stated of them ({}): it then "
            "predicts the {} motion to {:.2f} times what the sensors alone would leave; as given, to {:.2f}.",
            moved, last.role, last.error, judged(diagnosis.ladder.front()).error);
      }
      return fmt::format(
          "Nothing is missing: the model predicts the {} motion to {:.2f} times what the sensors "
          "alone would leave.",
          last.role, last.error);
    }
    case Verdict::unexplained: {
      if (!diagnosis.accepted.empty()) {
        const bool one = diagnosis.accepted.size() == 1;
        return fmt::format(
            "Found: {}, a part of what is missing. With {} {} No effect of the catalogue explains the rest.",
            names_of(diagnosis.accepted), one ? "it" : "them", fall_sentence(diagnosis));
      }
      const std::string moved = moved_numbers(diagnosis);
      return fmt::format(
          "Unexplained: the {} error stays {:.2f} times the floor, and no effect of the catalogue "
          "explains it.{}",
          last.role, last.error,
          moved.empty() ? "" : " Numbers of the model moved: " + moved + "; " + fall_sentence(diagnosis));
    }
    case Verdict::missing:
      break;
  }
  return "";
}

namespace {

/// " (train 9.53, with the other 10.67)", where another role counts.
std::string in_place_train(const Finding& finding, const std::string& role) {
  return role == "train" ? ""
                         : fmt::format(" (train {:.2f}, with the other {:.2f})", finding.train_after,
                                       finding.train_before);
}

}  // namespace

std::string finding_sentences(const Finding& finding, const Diagnosis& diagnosis) {
  constexpr double kAsGood = 1.05;  // two numbers nearer than that are one
  const Judged before = judged(finding.train_before, finding.held_out_before);
  Judged after = judged(finding.train_after, finding.held_out_after);
  std::string tried;
  const bool is_last = !diagnosis.accepted.empty() && diagnosis.accepted.back().label() == finding.label();
  const Judged whole = diagnosis.ladder.empty() ? after : judged(diagnosis.ladder.back());
  if (is_last && whole.role == after.role && whole.error > kAsGood * after.error) {
    tried = fmt::format(" ({:.2f} on the windows on which it was tried)", after.error);
    after = whole;
  }
  // Where another one was dropped, the last one's error is that of the answer: the same model may be fitted
  // better.
  double train_after = finding.train_after;
  const bool is_dropped = !diagnosis.ladder.empty() && diagnosis.ladder.back().name.rfind("- ", 0) == 0;
  if (is_last && is_dropped && whole.role == after.role && whole.error < after.error) {
    after = whole;
    train_after = diagnosis.ladder.back().train();
  }
  const std::string train = after.role == "train" || !tried.empty()
                                ? ""
                                : fmt::format(" (train {:.2f} to {:.2f})", finding.train_before, train_after);
  if (!finding.in_place_of.empty()) {
    return fmt::format(
        "{}: {} at {}, in place of {}. With it the {} error is {:.2f} times the floor, with the other "
        "{:.2f}{}{}; it was chosen in {:.0f} % of the resamples.",
        diagnosis.verdict == Verdict::missing ? "Missing" : "A part", finding.effect, finding.at,
        finding.in_place_of, after.role, after.error, before.error, tried,
        in_place_train(finding, after.role), 100.0 * finding.selected_share);
  }
  return fmt::format(
      "{}: {} at {}. With it the {} error {} from {:.2f} to {:.2f} times the floor{}{}; {} chosen in "
      "{:.0f} % of the resamples.{}",
      diagnosis.verdict == Verdict::missing ? "Missing" : "A part", finding.effect, finding.at, after.role,
      after.error <= before.error ? "falls" : "rises", before.error, after.error, tried, train,
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
      "As given the model departs too far from the motion over whole windows: it was diagnosed on ones of "
      "about "
      "{:.2g} s.",
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

/// How many windows the user's limit left; empty without one.
std::string limit_sentence(const Diagnosis& diagnosis) {
  if (diagnosis.unused_windows == 0) {
    return "";
  }
  const std::size_t used = diagnosis.all_windows - diagnosis.unused_windows;
  return fmt::format(
      "Of {} windows {} were used, spread evenly over the trials; errors and shares are those of these "
      "windows.",
      diagnosis.all_windows, used);
}

/// The error on trials that neither fitted nor chose; empty where there are none.
std::string test_sentence(const Diagnosis& diagnosis) {
  if (!(diagnosis.test_after > 0.0)) {
    return "";
  }
  return fmt::format(
      "On the trials of role test, which neither fitted nor chose, the error goes from {:.2f} to {:.2f} "
      "times the "
      "floor.",
      diagnosis.test_before, diagnosis.test_after);
}

/// Where the held-out error at the train trials' best values is much larger than the foretold one, which
/// decides (validation/identify/predict/foretell.h): a caution with both; else empty.
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

/// Empty where nothing was withdrawn.
std::string withdrawn_sentence(const Diagnosis& diagnosis) {
  if (diagnosis.withdrawn.empty()) {
    return "";
  }
  std::vector<std::string> names;
  for (const Named& one : diagnosis.withdrawn) {
    names.push_back(one.effect + " at " + one.at);
  }
  return fmt::format(
      "Not named: {}. Of the catalogue's effects the error falls most with {}, but standard identification "
      "alone predicts better, and no better with {}.",
      fmt::join(names, ", "), names.size() > 1 ? "these" : "this", names.size() > 1 ? "them" : "it");
}

/// What the model states as exact and no laboratory knows exactly, where something stays unexplained; else
/// empty.
std::string exact_sentence(const Diagnosis& diagnosis) {
  if (diagnosis.verdict != Verdict::unexplained) {
    return "";
  }
  const std::vector<model::EffectUse>& uses = diagnosis.final_stage.model.effects;
  const auto is_stated = [&](const std::string& law) {
    return std::any_of(uses.begin(), uses.end(), [&](const model::EffectUse& use) {
      return use.law->declaration().name == law &&
             std::any_of(use.values.begin(), use.values.end(),
                         [](const model::Quantity& value) { return value.uncertainty > 0.0; });
    });
  };
  std::vector<std::string> exact;
  for (const auto& [law, constants] :
       {std::pair("encoder_scale", "ratios"), std::pair("com_shift", "centres of mass"),
        std::pair("command_delay", "the commands' delays")}) {
    if (!is_stated(law)) {
      exact.emplace_back(constants);
    }
  }
  return exact.empty()
             ? ""
             : fmt::format(
                   "The model states no uncertainty of its {}: they were taken as exact, and may be part of "
                   "what is left (docs/tutorial.md says how to state it).",
                   fmt::join(exact, ", "));
}

}  // namespace

std::string one_place_sentence(const OnePlace& place) {
  std::string laws;
  for (const LawShare& one : place.laws) {
    const std::string where = one.at == place.at ? "" : " at " + one.at;
    laws += fmt::format("{}{}{} {:.0f} %", laws.empty() ? "" : ", ", one.effect, where, 100.0 * one.share);
  }
  return fmt::format(
      "Something is missing at {}: a law there is the best in {:.0f} % of the resamples. Which one "
      "these data cannot tell: {}.",
      place.at, 100.0 * place.share, laws);
}

std::vector<std::string> remarks(const Diagnosis& diagnosis) {
  std::vector<std::string> said;
  const bool is_open = diagnosis.verdict != Verdict::nothing_missing && diagnosis.at_one_place;
  for (const std::string& one :
       {is_open ? one_place_sentence(*diagnosis.at_one_place) : "", test_sentence(diagnosis),
        withdrawn_sentence(diagnosis), open_values_sentence(diagnosis), part_sentence(diagnosis),
        limit_sentence(diagnosis), exact_sentence(diagnosis)}) {
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
