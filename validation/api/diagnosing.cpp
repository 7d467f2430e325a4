#include "validation/api/diagnosing.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/api/changed_model.h"
#include "validation/identify/diagnose/finish.h"
#include "validation/identify/diagnose/found_values.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/one_place.h"
#include "validation/report/result_json.h"

namespace plumbline::api {
namespace {

using validation::Diagnosis;
using validation::Verdict;

constexpr double kLittle = 0.02;  // share of the squared error that is not worth a look at the forces

/// Is an effect of this kind at the same place in the file already, from the model as given or added before?
bool has_one(const model::Model& given, const std::vector<model::AddedEffect>& added,
             const model::EffectUse& use) {
  return std::any_of(given.effects.begin(), given.effects.end(),
                     [&](const model::EffectUse& other) { return other.label() == use.label(); }) ||
         std::any_of(added.begin(), added.end(), [&](const model::AddedEffect& other) {
           return other.at == use.at && other.effect == use.law->declaration().name;
         });
}

/// The number of the model that was opened before, where what was named is more of the same: a mass, an
/// inertia.
model::AddedEffect* same_number(std::vector<model::AddedEffect>& added, const model::EffectUse& use) {
  const bool adds_up =
      dynamic_cast<const effects::StructureLaw*>(use.law.get()) != nullptr && use.law->parameter_count() == 1;
  const auto found = std::find_if(added.begin(), added.end(), [&](const model::AddedEffect& other) {
    return other.at == use.at && other.effect == use.law->declaration().name;
  });
  return adds_up && found != added.end() ? &*found : nullptr;
}

/// Both together as one number; the deviations are those of a sum of independent parts.
void add_up(const effects::Values& values, const effects::Values& deviations, model::AddedEffect& number) {
  number.values.front() += values.front();
  double& deviation = number.deviations.front();
  deviation = std::isfinite(deviation) ? std::hypot(deviation, deviations.front()) : deviations.front();
}

/// What the torques name comes first; predictions go on from there. An interruption keeps what is named.
Diagnosis diagnosed(const FromTorques& torques, const Loaded& loaded, const effects::Catalogue& catalogue,
                    const validation::Policy& options, const validation::Progress& progress) {
  if (!torques.stage || torques.stage->named.empty()) {
    return validation::diagnose(loaded.model, catalogue, *loaded.data, options, progress);
  }
  Diagnosis diagnosis = diagnosis_of(*torques.stage, loaded.model, *loaded.data, options, progress);
  if (diagnosis.accepted.empty()) {
    return validation::diagnose(loaded.model, catalogue, *loaded.data, options, progress);
  }
  progress(fmt::format("so far {}: {:.2f} to {:.2f} floors", diagnosis.ladder.back().name,
                       validation::judged(diagnosis.ladder.front().scores(), *loaded.data),
                       validation::judged(diagnosis.ladder.back().scores(), *loaded.data)),
           1.0);
  if (is_for_torques(diagnosis.ladder.back().scores(), options)) {
    return diagnosis;  // what they name comes first, and what more they ask for is all there is to say
  }
  const model::Model model = identified_model(*torques.stage, diagnosis.accepted.size());
  // Behind several effects, hundreds of floors away, no pairs are looked for (Policy::hopeless).
  validation::Policy further = options;
  further.firsts = further.linear_pairs = 0;
  join(validation::diagnose(model, catalogue, *loaded.data, further, progress), catalogue, *loaded.data,
       options, progress, diagnosis);
  return diagnosis;
}

/// The better of two, by what counts.
void take_better(std::optional<validation::WindowsFit> other, const Loaded& loaded,
                 std::optional<validation::WindowsFit>& best) {
  if (other && (!best || validation::judged(other->scores, *loaded.data) <
                             validation::judged(best->scores, *loaded.data))) {
    best = std::move(other);
  }
}

/// What was refused as a name but predicts better, on all windows.
std::optional<BestModel> unnamed_model(const Loaded& loaded, const Diagnosis& diagnosis,
                                       const validation::Progress& progress) {
  if (!diagnosis.unnamed) {
    return {};
  }
  progress("all windows for what is not named", 0.9);
  BestModel model;
  model.with_named = diagnosis.unnamed->beside_named;
  model.with_standard = false;
  model.unnamed = diagnosis.unnamed->effects;
  try {
    model.fit = validation::fitted_on_all(diagnosis.unnamed->stage, *loaded.data);
  } catch (const validation::Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return {};  // some windows are lost
  }
  return model;
}

/// Standard identification of a model, both ways of it: by the torques, and by windows from there.
class Standard {
 public:
  Standard(const Loaded& loaded, const FromTorques& torques, const validation::Policy& policy,
           const validation::Progress& progress)
      : loaded_(loaded),
        windows_(policy.windows),
        progress_(progress),
        by_torques_(torques.standard ? torques.standard
                                     : torque_identification(loaded.model, *loaded.data, progress)) {}

  /// Of everything, or of the drives with the bodies as stated: what predicts better.
  std::optional<validation::WindowsFit> of(const model::Model& model) const {
    const validation::FreeModel* start = by_torques_ ? &by_torques_->free : nullptr;
    std::optional<validation::WindowsFit> best;
    for (const validation::Freed freed : {validation::Freed::drives, validation::Freed::all}) {
      take_better(validation::standard_by_windows(model, freed, start, *loaded_.data, windows_, progress_),
                  loaded_, best);
    }
    return best;
  }

  std::optional<validation::WindowsFit> alone() const {
    std::optional<validation::WindowsFit> fit = of(loaded_.model);
    if (by_torques_) {
      take_better(validation::as_windows_fit(by_torques_->free, by_torques_->after), loaded_, fit);
    }
    return fit;
  }

 private:
  const Loaded& loaded_;
  std::size_t windows_;
  const validation::Progress& progress_;
  std::optional<validation::StandardFit> by_torques_;
};

/// Is a law named that standard identification does not have?
bool is_beyond_standard(const Diagnosis& diagnosis) {
  return std::any_of(
      diagnosis.accepted.begin(), diagnosis.accepted.end(),
      [](const validation::Finding& finding) { return !validation::is_freed(finding.effect); });
}

bool is_standard_alone(const BestModel& best) {
  return best.with_standard && !best.with_named && best.unnamed.empty();
}

/// The best model found beside an answer that leaves more than the floor: of what was refused as a name, of
/// standard identification, and of that on top of what was named. So no answer is worse than any of them.
/// Where two are as good the first stands. Names without which standard identification predicts better than
/// with them are withdrawn.
void find_best(const Loaded& loaded, const FromTorques& torques, const validation::Policy& policy,
               const validation::Progress& progress, Answer& answer) {
  const Diagnosis& diagnosis = answer.diagnosis;
  const validation::Scores& found = diagnosis.ladder.back().scores();
  if (std::max(found.train, validation::judged(found, *loaded.data)) < policy.finished) {
    return;
  }
  double least = validation::judged(found, *loaded.data);
  const auto take = [&](BestModel model) {
    if (validation::judged(model.fit.scores, *loaded.data) < least) {
      least = (1.0 - policy.simpler) * validation::judged(model.fit.scores, *loaded.data);
      answer.best = std::move(model);
    }
  };
  if (std::optional<BestModel> model = unnamed_model(loaded, diagnosis, progress)) {
    take(std::move(*model));
  }
  const Standard standard(loaded, torques, policy, progress);
  if (answer.best || !diagnosis.accepted.empty()) {
    const BestModel base = answer.best.value_or(BestModel{{}, true, false, {}});
    if (std::optional<validation::WindowsFit> fit = standard.of(
            validation::fitted_model(answer.best ? answer.best->fit.stage : diagnosis.final_stage))) {
      take({std::move(*fit), base.with_named, true, base.unnamed});
    }
  }
  if (std::optional<validation::WindowsFit> fit = standard.alone()) {
    constexpr std::size_t kSome = 8;  // windows of a role
    answer.standard = StandardRung{fit->scores, fit->values, fit->at_limits,
                                   validation::kind_shares(*fit, loaded.data->thinned(kSome))};
    take({std::move(*fit), false, true, {}});
  }
  const bool is_behind = answer.best && is_standard_alone(*answer.best) &&
                         validation::judged(answer.best->fit.scores, *loaded.data) <
                             (1.0 - policy.material) * validation::judged(found, *loaded.data);
  if (is_behind && is_beyond_standard(diagnosis)) {
    validation::withdraw_names(*loaded.data, policy, answer.diagnosis);
  }
}

}  // namespace

Diagnosis with_best(const Answer& answer) {
  Diagnosis diagnosis = answer.diagnosis;
  if (answer.best) {
    diagnosis.final_stage = answer.best->fit.stage;
    diagnosis.precision = answer.best->fit.precision;
  }
  return diagnosis;
}

Answer diagnose(const Loaded& loaded, const effects::Catalogue& catalogue, const validation::Policy& options,
                const validation::Progress& progress) {
  Answer answer;
  try {
    const FromTorques torques = ask_torques(loaded.model, catalogue, *loaded.data, options, progress);
    answer.diagnosis = diagnosed(torques, loaded, catalogue, options, progress);
    if (torques.stage) {
      answer.torque_cutoff = torques.stage->cutoff;
      // What windows have named since, the torques were not asked beside.
      if (answer.diagnosis.accepted.size() <= torques.stage->named.size()) {
        answer.open = torques.stage->open;
      }
      if (!answer.diagnosis.at_one_place) {
        answer.diagnosis.at_one_place = validation::at_one_place(answer.open, loaded.model, options);
      }
    }
    if (!answer.diagnosis.interrupted && !answer.diagnosis.ladder.empty()) {
      find_best(loaded, torques, options, progress, answer);
    }
  } catch (const validation::Stopped&) {
    answer.diagnosis.interrupted = true;  // what is finished stands
  }
  const Diagnosis& diagnosis = answer.diagnosis;
  if (!diagnosis.interrupted && !diagnosis.ladder.empty() &&
      (diagnosis.unexplained_share > kLittle || diagnosis.verdict == Verdict::unexplained)) {
    answer.left = validation::unexplained_forces(diagnosis.final_stage, *loaded.data);
  }
  return answer;
}

namespace {

/// Friction is what a user looks for by name. Where it is: how much, a gain that moves along takes its share
/// of.
std::string told_friction(const validation::KindShare& kind) {
  std::string told;
  for (const validation::ToldValue& one : kind.told) {
    if (kind.kind == "friction") {
      told += (told.empty() ? "; other than stated by two deviations: " : ", ") +
              one.label.substr(0, one.label.find(':'));
    }
  }
  return told;
}

}  // namespace

std::string best_sentence(const Answer& answer) {
  if (!answer.best || !answer.diagnosis.accepted.empty()) {
    return "";
  }
  const validation::Scores& given = answer.diagnosis.ladder.front().scores();
  const validation::Scores& best = answer.best->fit.scores;
  const bool is_held_out = given.held_out > 0.0;
  std::string with = answer.best->with_standard ? "all that standard identification frees, together" : "";
  for (const validation::Named& one : answer.best->unnamed) {
    with += fmt::format("{}{} at {}", with.empty() ? "" : ", and ", one.effect, one.at);
  }
  std::string said = fmt::format(
      "No effect is named. The best model found has {}: the {} error falls from {:.2f} to {:.2f} times the "
      "floor.",
      with, is_held_out ? "held-out" : "train", is_held_out ? given.held_out : given.train,
      is_held_out ? best.held_out : best.train);
  if (is_standard_alone(*answer.best) && answer.standard) {
    std::string kinds;
    constexpr double kNoticeable = 1.05;  // of what is left
    for (const validation::KindShare& one : answer.standard->rests_on) {
      if (one.without < kNoticeable * (is_held_out ? best.held_out : best.train)) {
        continue;
      }
      kinds += fmt::format("{}{} ({:.4g} floors with it as stated{})", kinds.empty() ? "" : ", ", one.kind,
                           one.without, told_friction(one));
    }
    said += kinds.empty() ? " It rests on no one kind of value: with any as stated the others make up for it."
                          : fmt::format(" It rests on {}.", kinds);
  }
  return said;
}

nlohmann::json to_json(const Answer& answer) {
  nlohmann::json json = validation::to_json(answer.diagnosis, answer.left);
  const std::string said = best_sentence(answer);
  if (!said.empty()) {
    json["summary"] = said + " " + json["summary"].get<std::string>();
  }
  const auto errors = [](const validation::Scores& scores) {
    return nlohmann::json{{"train", scores.train}, {"held_out", scores.held_out}};
  };
  json["standard"] = nullptr;
  if (answer.standard) {
    json["standard"] = errors(answer.standard->scores);
    json["standard"]["values"] = answer.standard->values;
    json["standard"]["at_limits"] = answer.standard->at_limits;
    json["standard"]["rests_on"] = nlohmann::json::array();
    for (const validation::KindShare& one : answer.standard->rests_on) {
      nlohmann::json told = nlohmann::json::array();
      for (const validation::ToldValue& value : one.told) {
        told.push_back({{"parameter", value.label},
                        {"unit", value.unit},
                        {"stated", value.stated},
                        {"value", value.value},
                        {"standard_deviation", value.deviation}});
      }
      json["standard"]["rests_on"].push_back(
          {{"kind", one.kind},
           {"without", std::isfinite(one.without) ? nlohmann::json(one.without) : nullptr},
           {"told", told}});
    }
  }
  json["best_model"] = nullptr;
  if (answer.best) {
    json["best_model"] = errors(answer.best->fit.scores);
    json["best_model"]["with_named_effects"] = answer.best->with_named;
    json["best_model"]["with_standard_identification"] = answer.best->with_standard;
    json["best_model"]["unnamed"] = nlohmann::json::array();
    for (const validation::Named& one : answer.best->unnamed) {
      json["best_model"]["unnamed"].push_back({{"effect", one.effect}, {"at", one.at}});
    }
    json["best_model"]["values"] = answer.best->fit.values;
    json["best_model"]["at_limits"] = answer.best->fit.at_limits;
  }
  json["open"] = validation::to_json(answer.open);
  return json;
}

void save(const Answer& answer, const model::Model& given, const std::string& file) {
  save(with_best(answer), given, file);
}

void save(const Diagnosis& diagnosis, const model::Model& given, const std::string& file) {
  std::vector<model::AddedEffect> added;
  std::vector<model::NewValue> values;
  validation::Stage stage = diagnosis.final_stage;
  stage.model = validation::fitted_model(stage);
  const std::size_t own = given.effects.size();
  for (std::size_t e = own; e < stage.model.effects.size(); ++e) {
    const model::EffectUse& use = stage.model.effects[e];
    const effects::Values numbers = use.numbers();
    if (use.law->is_null(numbers.data())) {
      continue;
    }
    const effects::Values deviations = validation::found_deviations(diagnosis, static_cast<int>(e));
    if (model::AddedEffect* number = same_number(added, use)) {
      add_up(numbers, deviations, *number);
    } else {
      added.push_back({use.law->declaration().name, use.at, numbers, has_one(given, added, use), deviations});
    }
  }
  for (const validation::FreeParameter& parameter : moved_from(given, stage)) {
    const double deviation = validation::found_deviation(diagnosis, parameter.id);
    values.push_back({parameter.label, value_at(stage.model, parameter.id),
                      std::isfinite(deviation) ? deviation : 0.0, parameter.unit, "diagnose"});
  }
  model::write_overlay(
      file, given.file, added, values, "written by plumbline diagnose", model::known_effects(),
      validation::correlations_of(stage.parameters, stage.estimate.theta, diagnosis.precision));
}

}  // namespace plumbline::api
