// The rounds of a diagnosis on one set of windows.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/diagnose/look_ahead.h"
#include "validation/identify/predict/reach.h"

namespace plumbline::validation {

/// What it is given must outlive it.
class Diagnoser {
 public:
  Diagnoser(const effects::Catalogue& catalogue, const Followed& followed, const Policy& policy,
            const Progress& progress);
  /// On whole windows, with the model's own numbers exactly as stated, and with them free within what is
  /// stated of them: the first where that gives an answer and the data do not speak for other numbers.
  void run(const model::Model& model, Diagnosis& diagnosis);
  /// On segments, with the numbers free at once: what they tell is weighed anew on longer ones. False where
  /// these promise little of what is above the floor: something large is missing, and they stay as stated.
  bool begin_on_segments(const model::Model& model, Diagnosis& diagnosis);
  /// What was named on other segments, on these, with more own numbers open if `with_numbers`: above the
  /// floor, and where these are not `complete`. A model with wrong numbers loses windows before its error
  /// shows in those that it keeps. Did the numbers help, or was there no need of them?
  bool further_on(bool complete, bool with_numbers, Diagnosis& diagnosis);
  /// What else is missing here: above the floor, or in any case.
  void look_further(bool in_any_case, Diagnosis& diagnosis);
  /// The first round from the model that nothing was added to; empty where none was needed.
  const Tried& first() const { return first_; }

 private:
  void start(const model::Model& model, Diagnosis& diagnosis);
  /// With its own numbers open, unless it is at the floor as it is.
  Stage opened(const Stage& given) const;
  /// The error at which there is nothing to look for. On segments of the windows one that would be an answer:
  /// what little is left shows better further on.
  double enough() const;
  bool is_costly(const Diagnosis& diagnosis) const;
  /// One effect after the other from where the ladder stands, the first in any case if so, and behind each
  /// the own numbers again if so.
  void look(int most, Diagnosis& diagnosis, bool in_any_case = false, bool with_numbers = false);
  /// As a whole: an interruption must not leave parameters without their values.
  static void restart(const std::vector<Rung>& ladder, Diagnosis& diagnosis);
  /// With the numbers as stated first, because an answer with them says more. But where other numbers alone
  /// explain much, first with the numbers free. The stated ones then need no trial if an effect
  /// is named beside which the data speak against them, or if no answer was found: it would have been one
  /// with free numbers, too.
  void look_with_own_numbers(const Rung& given, const Rung& fitted, Diagnosis& diagnosis);
  /// First with the numbers as stated, and where the data do not speak for them also with the fitted ones;
  /// what predicts better stays.
  void look_as_stated_first(const Rung& given, const Rung& fitted, Diagnosis& diagnosis);
  /// The fitted numbers lower the error, and at most half of them stand at the limits of what is stated.
  bool helps(const Rung& given, const Rung& fitted) const;
  double evidence(const Diagnosis& diagnosis) const;
  /// An answer at the floor that would be improbable if the model's own numbers were not exactly as stated.
  bool speaks_for_stated(const Diagnosis& diagnosis) const;
  /// Beside what is named, and more of them than on shorter parts. Do they help?
  bool open_own_numbers(Diagnosis& diagnosis) const;
  /// A rung, and the values that it gives to what is named.
  void take(const std::string& name, const Stage& stage, Diagnosis& diagnosis) const;
  void replace_last(const Stage& stage, Diagnosis& diagnosis) const;
  Stage fit_own(const Stage& open) const;
  /// Do the open numbers promise a good part of what is above the floor, and this share of all? A model that
  /// lacks something large is not searched for numbers that make up for it.
  bool promises_much(const Stage& open, double least = 0.0) const;
  /// A law that is already named at a place is not named there again: two of a kind can add up to a third.
  static std::vector<std::string> names_of(const std::vector<Finding>& findings);
  bool step(Diagnosis& diagnosis, int round);
  const effects::Catalogue& catalogue_;
  const Data& data_;
  const std::vector<Eigen::VectorXd>& x0_;  // where the windows begin; empty: to be searched
  double length_;
  const Policy& policy_;
  const Progress& progress_;
  Tried first_;
};

}  // namespace plumbline::validation
