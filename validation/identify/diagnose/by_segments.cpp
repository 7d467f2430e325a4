#include "validation/identify/diagnose/by_segments.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "validation/identify/diagnose/diagnoser.h"
#include "validation/identify/diagnose/finish.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/look_ahead.h"
#include "validation/identify/predict/carried_states.h"
#include "validation/identify/predict/initial_states.h"

namespace plumbline::validation {
namespace {

/// The segments once more with what is found, or longer ones if it can be followed so far; where it is at the
/// floor in any case.
Followed followed_further(const Data& data, const Followed& segments, bool in_any_case,
                          const Progress& progress, const Diagnosis& diagnosis) {
  progress("how far the model can be followed", 0.0);
  return follow_further(fitted_model(diagnosis.final_stage), data, segments, in_any_case);
}

/// Spread over the trials, at most `most` of each role.
Followed some_of(const Followed& all, std::size_t most) {
  Followed some{all.data, {}, all.length};
  some.data.windows.clear();
  for (const Role role : {Role::train, Role::held_out}) {
    const std::vector<int> windows = all.data.windows_of(role);
    const std::size_t stride = (windows.size() + most - 1) / most;
    for (std::size_t i = 0; i < windows.size(); i += stride) {
      const auto w = static_cast<std::size_t>(windows[i]);
      some.data.windows.push_back(all.data.windows[w]);
      if (!all.x0.empty()) {
        some.x0.push_back(all.x0[w]);
      }
    }
  }
  return some;
}

class BySegments {
 public:
  BySegments(const effects::Catalogue& catalogue, const Data& data, const Policy& policy,
             const Progress& progress, Diagnosis& diagnosis)
      : catalogue_(catalogue), data_(data), policy_(policy), progress_(progress), diagnosis_(diagnosis) {}

  Followed run(const model::Model& model, Followed followed) {
    // The beginnings of windows are of use where these begin in flight.
    const bool promising =
        Diagnoser(catalogue_, followed, policy_, progress_).begin_on_segments(model, diagnosis_);
    if (!promising && begin_in_flight()) {
      const Followed segments = followed;
      diagnosis_ = restarted();
      followed = follow_beginnings(model, data_);
      Diagnoser(catalogue_, followed, policy_, progress_).begin_on_segments(model, diagnosis_);
      if (!names_more(followed) && !names_on_some(model, segments, followed)) {
        return followed;
      }
    } else if (!promising && !names_more(followed)) {
      return followed;
    }
    return grown(std::move(followed));
  }

  /// The same from shorter windows of a model that can be followed whole, but is far away there. Nothing
  /// where what is named on them is no answer, there or on whole windows.
  std::optional<Followed> run_nearer(const model::Model& model, Followed nearer) {
    Diagnoser(catalogue_, nearer, policy_, progress_).begin_on_segments(model, diagnosis_);
    const auto is_answer = [&](const Followed& on) {
      return is_below(policy_.finished, diagnosis_.final_stage.estimate, on.data);
    };
    if (!names_more(nearer) || !is_answer(nearer)) {
      return std::nullopt;
    }
    Followed followed = grown(std::move(nearer));
    return is_whole(followed) && is_answer(followed) ? std::optional<Followed>(std::move(followed))
                                                     : std::nullopt;
  }

 private:
  /// Longer and longer, up to the whole windows if it can be followed so far.
  Followed grown(Followed followed) {
    for (bool is_new = true; !is_whole(followed);) {
      segments_ = {followed.data, diagnosis_.final_stage.estimate.x0, followed.length};
      const bool explained = is_below(policy_.finished, diagnosis_.final_stage.estimate, followed.data);
      Followed further = followed_further(data_, segments_, explained, progress_, diagnosis_);
      const bool is_longer = further.length > followed.length;
      if (is_new || is_longer) {
        followed = std::move(further);
        go_on(followed, diagnosis_);
        is_new = is_longer;
        continue;
      }
      if (!names_more(followed)) {
        return followed;
      }
      is_new = true;
    }
    grow_anew(followed);
    names_more(followed);
    return followed;
  }

  bool begin_in_flight() const {
    return std::any_of(data_.trials.begin(), data_.trials.end(),
                       [](const Trial& trial) { return !trial.switches.empty(); });
  }

  /// Nothing found yet, but what was left out stays so.
  Diagnosis restarted() const {
    Diagnosis anew;
    anew.lost = diagnosis_.lost;
    return anew;
  }

  /// On these, with more own numbers open. Where they did not help on shorter ones something else is missing,
  /// and they are tried again on whole windows only, before it is looked for.
  void go_on(const Followed& followed, Diagnosis& diagnosis) {
    numbers_help_ =
        Diagnoser(catalogue_, followed, policy_, progress_)
            .further_on(not_followed(data_, followed) == 0, numbers_help_ || is_whole(followed), diagnosis);
  }

  /// What shows in a stance only shows in none of the beginnings. Some of the segments tell what it is; then
  /// all are fitted, and `followed`. False, and all as it was, where nothing is named on them either.
  bool names_on_some(const model::Model& model, const Followed& segments, Followed& followed) {
    constexpr std::size_t kMost = 16;  // of each role
    Diagnosis before = diagnosis_;
    const Followed some = some_of(segments, kMost);
    diagnosis_ = restarted();
    Diagnoser(catalogue_, some, policy_, progress_).begin_on_segments(model, diagnosis_);
    if (!names_more(some)) {
      diagnosis_ = std::move(before);
      return false;
    }
    followed = segments;  // with the states of what is named, too
    followed.x0 = carried_states(model, fitted_model(diagnosis_.final_stage), segments.data, segments.x0);
    go_on(followed, diagnosis_);
    return true;
  }

  /// Where too many whole windows are lost something is missing, whatever the error of the others.
  bool names_more(const Followed& followed) {
    const std::size_t named = diagnosis_.accepted.size();
    Diagnoser(catalogue_, followed, policy_, progress_)
        .look_further(is_whole(followed) && are_too_many_lost(data_, followed), diagnosis_);
    const bool more = diagnosis_.accepted.size() > named;
    if (more) {
      numbers_help_ = true;
      drop_superfluous(followed.data, policy_, progress_, diagnosis_);
    }
    return more;
  }

  /// Above the floor on whole windows: once more from the segments that they grew from, with the values that
  /// were found since. A window may have grown into a minimum beside its own with those before. The better
  /// counts.
  void grow_anew(Followed& followed) {
    if (is_below(policy_.at_floor, diagnosis_.final_stage.estimate, followed.data)) {
      return;
    }
    Followed anew = followed_further(data_, segments_, true, progress_, diagnosis_);
    if (!is_whole(anew)) {
      return;
    }
    Diagnosis other = diagnosis_;
    go_on(anew, other);
    if (judged(other.final_stage.estimate, anew.data) <
        judged(diagnosis_.final_stage.estimate, followed.data)) {
      diagnosis_ = std::move(other);
      followed = std::move(anew);
    }
  }

  const effects::Catalogue& catalogue_;
  const Data& data_;
  Policy policy_;
  const Progress& progress_;
  Diagnosis& diagnosis_;
  bool numbers_help_ = true;
  Followed segments_{data_, {}, 0.0};  // that were followed last, before the whole windows
};

/// Segments of the windows on which the model as given comes within `hopeless` floors, as long as can be;
/// none where it does on none.
std::optional<Followed> nearer_windows(const model::Model& model, const Data& data, const Policy& policy) {
  constexpr std::size_t kFew = 6;  // of each role tell how long they are
  constexpr int kMostParts = 16;
  const Data few = data.thinned(kFew);
  for (int parts = 2; parts <= kMostParts; parts *= 2) {
    const double length = data.predict.window / parts;
    const Followed some = follow_at(model, few, length);
    PredictorPool pool(model, some.data);
    if (!some.data.windows.empty() && is_below(policy.hopeless, estimate_states(pool, some.x0), some.data)) {
      return follow_at(model, data, length);
    }
  }
  return std::nullopt;
}

/// Does any law that is linear where it is nothing promise the floor on a few of these? On short windows
/// nearly all laws take much of a large error, and what releases a ratio takes most: only what explains it
/// whole is worth the searches.
bool is_promising(const model::Model& model, const effects::Catalogue& catalogue, const Followed& followed,
                  const Policy& policy, const Progress& progress) {
  constexpr std::size_t kFew = 12;
  Stage stage{model, {}, {}};
  const Data few = followed.data.thinned(kFew);
  {
    PredictorPool pool(model, few);
    stage.estimate = estimate_states(pool, {});
  }
  const Tried tried = screen_candidates(stage, catalogue, {}, few, progress);
  return std::any_of(tried.hypotheses.begin(), tried.hypotheses.end(), [&](const Hypothesis& one) {
    return one.tangent &&
           one.promised() < 2.0 * policy.nearer * policy.nearer;  // of train and held-out together
  });
}

}  // namespace

std::optional<Followed> diagnose_from_nearer(const model::Model& model, const effects::Catalogue& catalogue,
                                             const Data& data, const Followed& whole, const Policy& policy,
                                             const Progress& progress, Diagnosis& diagnosis) {
  progress("the model as given", 0.0);
  PredictorPool pool(model, whole.data);
  const Stage given{model, {}, estimate_states(pool, whole.x0)};
  if (is_below(policy.hopeless, given.estimate, whole.data)) {
    return std::nullopt;
  }
  const Diagnosis before = diagnosis;
  diagnosis.ladder.push_back({"as given", given, std::numeric_limits<double>::infinity()});
  diagnosis.final_stage = given;
  Diagnosis tried;
  tried.lost = before.lost;
  std::optional<Followed> followed;
  try {
    progress("shorter windows, on which the model is nearer", 0.0);
    const std::optional<Followed> nearer = nearer_windows(model, data, policy);
    if (nearer && is_promising(model, catalogue, *nearer, policy, progress)) {
      followed = BySegments(catalogue, data, policy, progress, tried).run_nearer(model, *nearer);
    }
  } catch (const Stopped&) {
    if (!tried.accepted.empty()) {
      diagnosis = std::move(tried);
    }
    throw;
  }
  if (followed) {
    diagnosis = std::move(tried);
  } else {
    diagnosis = before;
  }
  return followed;
}

Followed diagnose_by_segments(const model::Model& model, const effects::Catalogue& catalogue,
                              const Data& data, const Followed& segments, const Policy& policy,
                              const Progress& progress, Diagnosis& diagnosis) {
  return BySegments(catalogue, data, policy, progress, diagnosis).run(model, segments);
}

}  // namespace plumbline::validation
