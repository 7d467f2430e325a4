#include "validation/diagnose/by_segments.h"

#include <algorithm>
#include <utility>

#include "validation/diagnose/diagnoser.h"
#include "validation/diagnose/finish.h"
#include "validation/diagnose/judged.h"

namespace plumbline::validation {
namespace {

/// The segments once more with what is found, or longer ones if it can be followed so far; where it is at the
/// floor in any case.
Followed followed_further(const Data& data, const Followed& segments, bool in_any_case,
                          const Progress& progress, const Diagnosis& diagnosis) {
  progress("how far the model can be followed", 0.0);
  return follow_further(fitted_model(diagnosis.final_stage), data, segments, in_any_case);
}

class BySegments {
 public:
  BySegments(const effects::Catalogue& catalogue, const Data& data, const Policy& policy,
             const Progress& progress, Diagnosis& diagnosis)
      : catalogue_(catalogue), data_(data), policy_(policy), progress_(progress), diagnosis_(diagnosis) {
    // Windows that expand errors a thousandfold hardly come below it.
    policy_.at_floor = policy.nothing;
  }

  Followed run(const model::Model& model, Followed followed) {
    // The beginnings of windows are of use where these begin in flight.
    const bool promising =
        Diagnoser(catalogue_, followed, policy_, progress_).begin_on_segments(model, diagnosis_);
    if (!promising && begin_in_flight()) {
      diagnosis_ = restarted();
      followed = follow_beginnings(model, data_);
      Diagnoser(catalogue_, followed, policy_, progress_).begin_on_segments(model, diagnosis_);
      if (!names_more(followed)) {
        return followed;
      }
    } else if (!promising && !names_more(followed)) {
      return followed;
    }
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

 private:
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

}  // namespace

Followed diagnose_by_segments(const model::Model& model, const effects::Catalogue& catalogue,
                              const Data& data, const Followed& segments, const Policy& policy,
                              const Progress& progress, Diagnosis& diagnosis) {
  return BySegments(catalogue, data, policy, progress, diagnosis).run(model, segments);
}

}  // namespace plumbline::validation
