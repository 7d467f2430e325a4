#include "validation/api/diagnosing.h"

#include <algorithm>
#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/diagnose/found_values.h"
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
  const model::Model model = identified_model(*torques.stage, diagnosis.accepted.size());
  // Behind several effects, hundreds of floors away, no pairs are looked for (Policy::hopeless).
  validation::Policy further = options;
  further.firsts = further.linear_pairs = 0;
  join(validation::diagnose(model, catalogue, *loaded.data, further, progress), *loaded.data, options,
       diagnosis);
  return diagnosis;
}

double counts(const validation::Scores& scores, const Loaded& loaded) {
  return loaded.data->has(validation::Role::held_out) ? scores.held_out : scores.train;
}

/// The better of two, by what counts.
void take_better(std::optional<validation::WindowsFit> other, const Loaded& loaded,
                 std::optional<validation::WindowsFit>& best) {
  if (other && (!best || counts(other->scores, loaded) < counts(best->scores, loaded))) {
    best = std::move(other);
  }
}

/// Standard identification beside an answer that leaves more than the floor, alone and with what was named,
/// so that no answer is worse than it. Both ways of it: by the torques, and by windows from there.
void hold_against_standard(const Loaded& loaded, const FromTorques& torques, const validation::Policy& policy,
                           const validation::Progress& progress, Answer& answer) {
  const validation::Scores& found = answer.diagnosis.ladder.back().scores();
  if (std::max(found.train, counts(found, loaded)) < policy.finished) {
    return;
  }
  const std::optional<validation::StandardFit> by_torques =
      torques.standard ? torques.standard : torque_identification(loaded.model, *loaded.data, progress);
  const validation::FreeModel* start = by_torques ? &by_torques->free : nullptr;
  const auto fit = [&](const model::Model& model) {
    return validation::standard_by_windows(model, start, *loaded.data, policy.windows, progress);
  };
  std::optional<validation::WindowsFit> alone = fit(loaded.model);
  if (by_torques) {
    take_better(validation::as_windows_fit(by_torques->free, by_torques->after), loaded, alone);
  }
  if (alone) {
    answer.standard = StandardRung{alone->scores, alone->values, alone->at_limits};
  }
  std::optional<validation::WindowsFit> both;
  if (!answer.diagnosis.accepted.empty()) {
    both = fit(validation::fitted_model(answer.diagnosis.final_stage));
  }
  const bool is_both = both && (!alone || counts(both->scores, loaded) <
                                              (1.0 + policy.simpler) * counts(alone->scores, loaded));
  std::optional<validation::WindowsFit>& best = is_both ? both : alone;
  if (best && counts(best->scores, loaded) < (1.0 - policy.material) * counts(found, loaded)) {
    answer.best = BestModel{std::move(*best), is_both};
  }
}

/// The diagnosis with the best model found as its last stage.
Diagnosis with_best(const Answer& answer) {
  Diagnosis diagnosis = answer.diagnosis;
  if (answer.best) {
    diagnosis.final_stage = answer.best->fit.stage;
    diagnosis.precision = answer.best->fit.precision;
  }
  return diagnosis;
}

}  // namespace

Answer diagnose(const Loaded& loaded, const effects::Catalogue& catalogue, const validation::Policy& options,
                const validation::Progress& progress) {
  Answer answer;
  try {
    const FromTorques torques = ask_torques(loaded.model, catalogue, *loaded.data, options, progress);
    answer.diagnosis = diagnosed(torques, loaded, catalogue, options, progress);
    if (torques.stage) {
      answer.torque_cutoff = torques.stage->cutoff;
      answer.open = torques.stage->open;
    }
    if (!answer.diagnosis.interrupted && !answer.diagnosis.ladder.empty()) {
      hold_against_standard(loaded, torques, options, progress, answer);
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

nlohmann::json to_json(const Answer& answer) {
  nlohmann::json json = validation::to_json(answer.diagnosis, answer.left);
  const auto errors = [](const validation::Scores& scores) {
    return nlohmann::json{{"train", scores.train}, {"held_out", scores.held_out}};
  };
  json["standard"] = nullptr;
  if (answer.standard) {
    json["standard"] = errors(answer.standard->scores);
    json["standard"]["values"] = answer.standard->values;
    json["standard"]["at_limits"] = answer.standard->at_limits;
  }
  json["best_model"] = nullptr;
  if (answer.best) {
    json["best_model"] = errors(answer.best->fit.scores);
    json["best_model"]["with_named_effects"] = answer.best->with_named;
    json["best_model"]["values"] = answer.best->fit.values;
    json["best_model"]["at_limits"] = answer.best->fit.at_limits;
  }
  json["open"] = nlohmann::json::array();
  for (const validation::TorqueShare& one : answer.open) {
    json["open"].push_back({{"effect", one.effect}, {"at", one.at}, {"share", one.share}});
  }
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
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    const auto& parameter = stage.parameters[p];
    if (parameter.id.effect < static_cast<int>(own)) {
      const double deviation = validation::found_deviation(diagnosis, parameter.id);
      values.push_back({parameter.label, stage.estimate.theta[static_cast<Eigen::Index>(p)],
                        std::isfinite(deviation) ? deviation : 0.0, parameter.unit, "diagnose"});
    }
  }
  model::write_overlay(file, given.file, added, values, "written by plumbline diagnose",
                       model::known_effects());
}

}  // namespace plumbline::api
