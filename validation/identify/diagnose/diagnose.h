// Which effect is missing, where, and how sure.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "validation/identify/diagnose/policy.h"
#include "validation/identify/diagnose/screen.h"
#include "validation/identify/predict/deviations.h"
#include "validation/identify/predict/lost_windows.h"

namespace plumbline::validation {

struct ParameterValue {
  std::string name, unit;
  double value = 0.0;
  double deviation = 0.0;  ///< one standard deviation, from the spread between windows
  bool chosen = false;     ///< structural: one of the values that were tried, with no deviation
};

struct Named {
  std::string effect, at;
  std::string label() const { return effect + "@" + at; }
};

/// What the data cannot tell from a finding.
struct Rival {
  Named name;
  double correlation = 1.0;  ///< between what either takes off the residuals (correlation.h); 1: one answer
  bool same = false;         ///< on this model one force under two names: no experiment tells them apart
};

/// One accepted effect. Its errors are those of the ladder's rungs before and with it.
struct Finding : Named {
  int rung = -1;  ///< of the ladder, with which it came; -1: not of it any more
  std::vector<ParameterValue> parameters;
  std::vector<Rival> rivals;
  double held_out_before = 0.0, held_out_after = 0.0;
  double train_before = 0.0, train_after = 0.0;
  double selected_share = 0.0;
  std::string equation;
  std::string in_place_of;    ///< "law@place" of an earlier finding whose place it took; usually empty
  std::string together_with;  ///< "law@place" of the effect that was found with it at once; usually empty
  /// The train trials' best value is no effect at all, though they leave it open: the values are then those
  /// that serve the held-out trials, too, and their error is no prediction any more.
  bool open_in_train = false;
};

struct RankRow : Named {
  double score = 0.0;  ///< mean square of train and held-out together with this effect added, floor units
  double held_out_after = 0.0;  ///< foretold
  double train_after = 0.0;
  bool refitted = false;  ///< false: promised by the linearisation only
  std::string remark;     ///< why it was not accepted
  /// Refitted only: the share of resamples in which it was the best, and between which values 90 % of the
  /// resamples have the error that counts (held-out where there is one).
  double selected_share = 0.0, judged_low = 0.0, judged_high = 0.0;
};

/// Two effects that were refitted together because one after the other led nowhere.
struct PairRow {
  Named first, second;
  double train_after = 0.0, held_out_after = 0.0;  ///< held-out: foretold
  double selected_share = 0.0;
  std::string remark;  ///< why they were not accepted
};

/// A law and the share of the resamples in which it is the best.
struct LawShare : Named {
  double share = 0.0;
};

/// Something is missing at this place, and which law the data cannot tell (one_place.h).
struct OnePlace {
  std::string at;
  double share = 0.0;          ///< of the resamples in which one of the laws is the best
  std::vector<LawShare> laws;  ///< most probable first
};

struct Rung {
  std::string name;  ///< "as given", "own parameters fitted", "+ coulomb@drive"
  Stage stage;
  /// Of the windows on which its errors are, s: shorter ones are segments; infinite: whole windows.
  double length = std::numeric_limits<double>::infinity();
  /// What `compare` gives of the rung's model, on all windows; of an answer whose rungs are all on whole
  /// ones.
  std::optional<Scores> compared{};
  const Scores& scores() const { return compared ? *compared : stage.estimate.scores; }
  double train() const { return scores().train; }
  double held_out() const { return scores().held_out; }
  double foretold() const { return stage.estimate.predicted.scores.held_out; }
};

/// A refit that was not named, of all those in the last round the one that predicts best: for a model to
/// predict with, never a name.
struct Unnamed {
  std::vector<Named> effects;
  Stage stage;
  bool beside_named = true;  ///< what is named is in it, too
};

enum class Verdict { missing, nothing_missing, unexplained };
std::string to_string(Verdict verdict);

struct Diagnosis {
  Verdict verdict = Verdict::nothing_missing;
  std::vector<Finding> accepted;
  std::vector<RankRow> ranking;          ///< of the first round in which something was looked for
  std::vector<RankRow> leads;            ///< refitted but not accepted in the last round
  std::optional<OnePlace> at_one_place;  ///< of the leads
  std::vector<PairRow> pairs;  ///< best first; empty where one effect after the other led to an answer
  std::vector<Rung> ladder;
  double unexplained_share = 0.0;  ///< share of the squared error above the floor that is left
  int candidates = 0;              ///< hypotheses screened
  bool interrupted = false;
  std::size_t windows = 0;  ///< on which the last errors are
  std::vector<LostWindow>
      lost;  ///< left out from the beginning: the model as given cannot be integrated there
  std::size_t all_windows = 0;     ///< of the train and held-out trials
  std::size_t unused_windows = 0;  ///< those of them that Data::limit() left out
  std::size_t cut_windows = 0;     ///< those of them that are not followed to their end (predict/reach.h)
  Stage final_stage;               ///< model with everything accepted, its parameters and estimate
  /// Of final_stage's parameters, those of what is named held against the cost (predict/profile.h); empty
  /// where that was not done: nothing named, or above the floor.
  Precision precision;
  /// Named at first, but standard identification predicts better without them (finish.h).
  std::vector<Named> withdrawn;
  std::optional<Unnamed> unnamed;  ///< empty where none predicts better than final_stage
  /// Errors on the trials of role test, in floors, of the model as given and of the final one; 0 without such
  /// trials. They are computed when all is decided.
  double test_before = 0.0, test_after = 0.0;
  std::size_t bare_rungs = 1;  ///< how many rungs come before anything was added
  const Rung& bare() const { return ladder[bare_rungs - 1]; }
};

/// Where the model cannot be followed to the end of the windows (predict/reach.h), it is diagnosed on
/// segments of them; what explains these goes on to longer ones, where more may be found, up to the whole
/// windows. Throws InputError when there is no train trial. An interruption (Ctrl-C) returns what is
/// finished.
Diagnosis diagnose(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                   const Policy& policy, const Progress& progress);

}  // namespace plumbline::validation
