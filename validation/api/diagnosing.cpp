#include "validation/api/diagnosing.h"

#include <algorithm>
#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/diagnose/found_values.h"
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
  join(validation::diagnose(model, catalogue, *loaded.data, options, progress), *loaded.data, options,
       diagnosis);
  return diagnosis;
}

}  // namespace

Answer diagnose(const Loaded& loaded, const effects::Catalogue& catalogue, const validation::Policy& options,
                const validation::Progress& progress) {
  Answer answer;
  try {
    const FromTorques torques = ask_torques(loaded.model, catalogue, *loaded.data, options, progress);
    answer.standard = torques.standard;
    answer.diagnosis = diagnosed(torques, loaded, catalogue, options, progress);
    if (torques.stage) {
      answer.torque_cutoff = torques.stage->cutoff;
      answer.open = torques.stage->open;
    }
  } catch (const validation::Stopped&) {
    answer.diagnosis.interrupted = true;
  }
  const Diagnosis& diagnosis = answer.diagnosis;
  if (!diagnosis.interrupted && !diagnosis.ladder.empty() &&
      (diagnosis.unexplained_share > kLittle || diagnosis.verdict == Verdict::unexplained)) {
    answer.left = validation::unexplained_forces(diagnosis.final_stage, *loaded.data);
  }
  return answer;
}

nlohmann::json to_json(const Answer& answer) { return validation::to_json(answer.diagnosis, answer.left); }

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
