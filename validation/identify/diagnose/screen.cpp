#include "validation/identify/diagnose/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "validation/identify/diagnose/family.h"
#include "validation/identify/diagnose/part.h"
#include "validation/identify/diagnose/promise.h"
#include "validation/identify/diagnose/tangents.h"
#include "validation/identify/predict/carried_states.h"
#include "validation/identify/predict/kept_keys.h"
#include "validation/identify/predict/work_ahead.h"

namespace plumbline::validation {
namespace {

const Candidate& candidate_of(const std::vector<Candidate>& candidates, const Hypothesis& hypothesis) {
  return candidates[static_cast<std::size_t>(hypothesis.candidate)];
}

/// What the linearisation at the extended model's values promises, `own` of whose parameters are new.
Promise promise_at(const Extended& extended, std::size_t own, const Data& data,
                   const std::vector<int>& windows, const std::vector<Eigen::VectorXd>& x0) {
  LinearProblem problem =
      linear_problem(extended.model, extended.parameters, extended.theta, data, windows, x0);
  Room& bounds = problem.bounds;
  // A linearisation far from null is trusted for about a factor of two.
  const Eigen::Index count = extended.theta.size();
  for (Eigen::Index p = count - static_cast<Eigen::Index>(own); p < count; ++p) {
    bounds.lower[p] = std::max(bounds.lower[p], -1.0);
    bounds.upper[p] = std::min(bounds.upper[p], 1.0);
  }
  return promise_of(problem);
}

/// An infinite one where the model cannot be integrated on these trials: it is no explanation of them.
Promise promise_unless_lost(const Extended& extended, std::size_t own, const Data& data,
                            const std::vector<int>& windows, const std::vector<Eigen::VectorXd>& x0) {
  try {
    return promise_at(extended, own, data, windows, x0);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return {Eigen::VectorXd::Zero(static_cast<Eigen::Index>(extended.parameters.size())), kNone, kNone};
  }
}

Promise kept_promise(const Extended& extended, std::size_t own, const Data& data,
                     const std::vector<int>& windows, const std::vector<Eigen::VectorXd>& x0) {
  ResultKey key = key_of("screen", extended.model, data);
  add_parameters(extended.parameters, key);
  key.numbers.add(extended.theta).add(static_cast<double>(own)).add(x0);
  for (const int w : windows) {
    key.numbers.add(w);
  }
  const Record record = kept(data, key, [&] {
    const Promise promise = promise_unless_lost(extended, own, data, windows, x0);
    return Record().add(promise.step).add(promise.train).add(promise.held_out);
  });
  RecordReader reader(record);
  Promise promise;
  promise.step = reader.vector();
  promise.train = reader.number();
  promise.held_out = reader.number();
  return promise;
}

/// Windows begin where the measurements say; segments, which may begin in a contact, where the stage has
/// them.
std::vector<Eigen::VectorXd> start_states(const Stage& stage, const Extended& extended, const Data& data) {
  return data.has_segments() ? carried_states(fitted_model(stage), extended.model, data, stage.estimate.x0)
                             : std::vector<Eigen::VectorXd>(data.windows.size());
}

/// Some of the windows, and what mean squared error the stage has on all as a multiple of what the same
/// linearisation promises there of the stage itself: promises made on them are brought to all windows by it.
/// A law that does nothing then promises what the stage has.
struct Part {
  std::vector<int> windows;
  double train = 1.0, held_out = 1.0;
};

Part part_of(const Stage& stage, std::vector<int> windows, const Data& data) {
  const Extended as_it_is{fitted_model(stage), stage.parameters, stage.estimate.theta};
  const Promise promise = kept_promise(as_it_is, 0, data, windows, start_states(stage, as_it_is, data));
  const Scores& now = stage.estimate.predicted.scores;
  const auto times = [](double error, double promised) {
    return error > 0.0 && std::isfinite(promised) ? error * error / promised : 1.0;
  };
  return {std::move(windows), times(now.train, promise.train), times(now.held_out, promise.held_out)};
}

void screen_start(const Stage& stage, const std::vector<Candidate>& candidates, Hypothesis& hypothesis,
                  const Data& data, const Part& part) {
  const Extended extended = extend(stage, candidate_of(candidates, hypothesis), hypothesis.start);
  const Promise promise = kept_promise(extended, extended.parameters.size() - stage.parameters.size(), data,
                                       part.windows, start_states(stage, extended, data));
  hypothesis.step = promise.step;
  hypothesis.promised_train = promise.train * part.train;
  hypothesis.promised_held_out = promise.held_out * part.held_out;
}

/// Each of them by one of the ranks, where there are several.
void screen_ahead(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                  const Part& part, const std::vector<Hypothesis>& starts) {
  std::vector<Ahead> pieces;
  pieces.reserve(starts.size());
  for (const Hypothesis& start : starts) {
    pieces.push_back({"screening " + candidate_of(candidates, start).label(), [&] {
                        Hypothesis copy = start;
                        screen_start(stage, candidates, copy, data, part);
                      }});
  }
  work_ahead(data, pieces);
}

/// Starts from which the model cannot be integrated are out.
void screen_starts(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                   const Part& part, const Progress& progress, std::vector<Hypothesis>& starts) {
  screen_ahead(stage, candidates, data, part, starts);
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const Candidate& candidate = candidate_of(candidates, starts[s]);
    progress("screening " + candidate.label(),
             static_cast<double>(s + 1) / static_cast<double>(starts.size() + 1));
    screen_start(stage, candidates, starts[s], data, part);
  }
  starts.erase(std::remove_if(starts.begin(), starts.end(),
                              [](const Hypothesis& one) { return !std::isfinite(one.promised()); }),
               starts.end());
}

/// Where linear laws of the law's family promise most, or, where the family has none, any linear laws at
/// motors and coordinates; the most promising place first. Empty where nothing linear tells of the law.
std::vector<std::string> places_for(const effects::Law& law, const std::vector<Candidate>& candidates,
                                    const std::vector<Hypothesis>& tangents, const TiedPlaces& tied) {
  constexpr std::size_t kPlaces = 4;
  const bool has_linear = std::any_of(tangents.begin(), tangents.end(), [&](const Hypothesis& one) {
    return are_of_one_family(*candidate_of(candidates, one).law, law);
  });
  const auto tells = [&](const Candidate& candidate) {
    const bool is_drive =
        candidate.place == effects::Place::motor || candidate.place == effects::Place::coordinate;
    return has_linear ? are_of_one_family(*candidate.law, law) : is_drive;
  };
  std::vector<std::string> places;
  for (const Hypothesis& one : tangents) {  // sorted
    const Candidate& candidate = candidate_of(candidates, one);
    const bool is_known = std::any_of(places.begin(), places.end(),
                                      [&](const std::string& at) { return tied.are_one(at, candidate.at); });
    if (places.size() < kPlaces && !is_known && tells(candidate)) {
      places.push_back(candidate.at);
    }
  }
  return places;
}

/// Families first: what has to be tried from values of its own costs a linearisation for each of them, and is
/// tried at a few places only. A law without a family is tried everywhere, and every law at a place of which
/// no linear law tells anything: a rod of a loop.
void keep_where_family_promises(const std::vector<Candidate>& candidates,
                                const std::vector<Hypothesis>& tangents, const TiedPlaces& tied,
                                std::vector<Hypothesis>& starts) {
  std::map<std::string, std::vector<std::string>> places;  // by law
  const auto is_elsewhere = [&](const Hypothesis& start) {
    const Candidate& candidate = candidate_of(candidates, start);
    const effects::Law& law = *candidate.law;
    const bool is_told = std::any_of(tangents.begin(), tangents.end(), [&](const Hypothesis& one) {
      return tied.are_one(candidate_of(candidates, one).at, candidate.at);
    });
    if (!are_of_one_family(law, law) || !is_told) {
      return false;
    }
    const std::string& name = law.declaration().name;
    if (places.count(name) == 0) {
      places[name] = places_for(law, candidates, tangents, tied);
    }
    const std::vector<std::string>& best = places[name];
    return !best.empty() && std::none_of(best.begin(), best.end(), [&](const std::string& at) {
      return tied.are_one(at, candidate.at);
    });
  };
  starts.erase(std::remove_if(starts.begin(), starts.end(), is_elsewhere), starts.end());
}

constexpr std::size_t kFew = 4;  // one window of so many is enough to leave out what promises nothing

/// The third of the starts that promises most on a few windows.
void keep_promising(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                    const Part& few, const Progress& progress, std::vector<Hypothesis>& starts) {
  constexpr std::size_t kLeast = 12;
  screen_starts(stage, candidates, data, few, progress, starts);
  sort_by_promise(starts);
  starts.resize(std::min(starts.size(), std::max(kLeast, starts.size() / 3)));
}

/// A start, and which of the screened ones it is of.
struct SecondLook {
  std::size_t of = 0;
  Hypothesis again;
};

/// Where the promises of the best lead that had to be linearised away from their null value.
std::vector<SecondLook> second_looks(const Stage& stage, const std::vector<Candidate>& candidates,
                                     const std::vector<Hypothesis>& found) {
  constexpr std::size_t kLooks = 12;
  std::vector<int> seen;
  std::vector<SecondLook> looks;
  for (std::size_t h = 0; h < found.size() && seen.size() < kLooks; ++h) {
    if (found[h].tangent || std::find(seen.begin(), seen.end(), found[h].candidate) != seen.end()) {
      continue;
    }
    seen.push_back(found[h].candidate);
    const Candidate& candidate = candidate_of(candidates, found[h]);
    const Extended extended = extend(stage, candidate, found[h].start);
    const Eigen::VectorXd theta = promised_theta(extended, found[h]);
    Hypothesis again = found[h];
    again.start = with_values(extended.model, extended.parameters, theta).effects.back().numbers();
    if (!candidate.law->is_null(again.start.data())) {
      looks.push_back({h, std::move(again)});
    }
  }
  return looks;
}

/// They are linearised once more there: theirs is the promise that a straight line keeps worst.
void look_again(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                const Part& part, const Progress& progress, std::vector<Hypothesis>& found) {
  std::vector<SecondLook> looks = second_looks(stage, candidates, found);
  std::vector<Hypothesis> starts;
  starts.reserve(looks.size());
  for (const SecondLook& look : looks) {
    starts.push_back(look.again);
  }
  screen_ahead(stage, candidates, data, part, starts);
  for (SecondLook& look : looks) {
    progress("looking again at " + candidate_of(candidates, look.again).label(), 0.95);
    screen_start(stage, candidates, look.again, data, part);
    if (look.again.promised() < found[look.of].promised()) {
      found[look.of] = std::move(look.again);
    }
  }
  sort_by_promise(found);
}

/// Those that promise most where there are many, each from its start.
void screen_those(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                  const Part& part, const Progress& progress, std::vector<Hypothesis>& starts) {
  constexpr std::size_t kMany = 60;
  if (data.has_segments() || starts.size() > kMany) {
    keep_promising(stage, candidates, data, part_of(stage, telling(stage, kFew, part.windows, data), data),
                   progress, starts);
  }
  screen_starts(stage, candidates, data, part, progress, starts);
}

}  // namespace

void sort_by_promise(std::vector<Hypothesis>& hypotheses) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.promised() < b.promised(); });
}

model::Model fitted_model(const Stage& stage) {
  return with_values(stage.model, stage.parameters, stage.estimate.theta);
}

Stage fitted_anew(Stage stage, const Data& data, const std::vector<Eigen::VectorXd>& x0, double tolerance) {
  PredictorPool pool(stage.model, data);
  stage.estimate =
      try_gauss_newton(pool, stage.parameters, values_of(stage.model, stage.parameters), x0, {10, tolerance});
  return stage;
}

Extended extend(const Stage& stage, const Candidate& candidate, const effects::Values& values) {
  Extended extended{fitted_model(stage), stage.parameters, {}};
  extended.model.effects.push_back(make_use(candidate, values));
  for (FreeParameter& parameter : searched_parameters_of(
           extended.model, candidate, static_cast<int>(extended.model.effects.size()) - 1)) {
    extended.parameters.push_back(std::move(parameter));
  }
  extended.theta = values_of(extended.model, extended.parameters);
  return extended;
}

Eigen::VectorXd promised_theta(const Extended& extended, const Hypothesis& hypothesis) {
  return stepped(extended.parameters, extended.theta, search_units(extended.parameters, extended.theta),
                 hypothesis.step);
}

std::vector<Hypothesis> screen(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                               const Progress& progress) {
  std::vector<Hypothesis> tangents;
  std::vector<Hypothesis> starts;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    for (const effects::Values& start : starts_of(stage.model, candidates[c])) {
      Hypothesis hypothesis;
      hypothesis.candidate = static_cast<int>(c);
      hypothesis.start = start;
      hypothesis.tangent = has_tangent(candidates[c], start);
      (hypothesis.tangent ? tangents : starts).push_back(std::move(hypothesis));
    }
  }
  progress("screening " + std::to_string(tangents.size()) + " linear candidates", 0.0);
  std::vector<Hypothesis> found = promises_of(stage, candidates, tangents, data);
  sort_by_promise(found);
  keep_where_family_promises(candidates, found, TiedPlaces(stage.model), starts);
  const Part part = part_of(stage, enough_to_tell(stage, data), data);
  screen_those(stage, candidates, data, part, progress, starts);
  found.insert(found.end(), starts.begin(), starts.end());
  sort_by_promise(found);
  look_again(stage, candidates, data, part, progress, found);
  return found;
}

}  // namespace plumbline::validation
