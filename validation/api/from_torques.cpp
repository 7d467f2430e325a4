#include "validation/api/from_torques.h"

#include <algorithm>
#include <cmath>

#include "simulator/trace/error.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/diagnose/finish.h"
#include "validation/identify/diagnose/found_values.h"
#include "validation/identify/diagnose/rescore.h"
#include "validation/identify/diagnose/revise.h"
#include "validation/identify/predict/deviations.h"
#include "validation/identify/predict/lost_windows.h"

namespace plumbline::api {
namespace {

using validation::Data;
using validation::Diagnosis;
using validation::Finding;
using validation::FreeModel;
using validation::FreeValue;
using validation::Policy;
using validation::Progress;
using validation::Stage;
using validation::TorqueFinding;
using validation::TorqueStage;

Stage stage_of(const FreeModel& free, const Data& data) {
  Stage stage;
  stage.model = free.model;
  stage.parameters = validation::as_parameters(free);
  Eigen::VectorXd theta(static_cast<Eigen::Index>(free.values.size()));
  for (std::size_t i = 0; i < free.values.size(); ++i) {
    theta[static_cast<Eigen::Index>(i)] = free.values[i].value;
  }
  validation::PredictorPool pool(validation::identified(free), data);
  stage.estimate = validation::estimate_states(pool);
  stage.estimate.theta = theta;
  stage.estimate.predicted.theta = theta;
  return stage;
}

Finding finding_of(const TorqueFinding& named, int rung) {
  Finding finding;
  finding.effect = named.effect;
  finding.at = named.at;
  finding.rung = rung;
  finding.selected_share = named.share;
  const model::EffectUse& use = named.free.model.effects.back();
  finding.equation = use.law->declaration().equation;
  const int effect = static_cast<int>(named.free.model.effects.size()) - 1;
  for (const FreeValue& value : named.free.values) {
    if (value.id.effect == effect) {
      const auto index = static_cast<std::size_t>(value.id.parameter);
      finding.parameters.push_back(
          {use.law->declaration().parameters[index].name, value.unit, value.value, value.deviation, false});
    }
  }
  for (const validation::LawShare& rival : named.rivals) {
    finding.rivals.push_back({{rival.effect, rival.at}, 1.0, false});
  }
  return finding;
}

void add_rung(const std::string& name, const Stage& stage, Diagnosis& diagnosis) {
  validation::Rung rung;
  rung.name = name;
  rung.stage = stage;
  diagnosis.ladder.push_back(rung);
  diagnosis.final_stage = stage;
}

/// Prediction decides: of what the torques name one after the other, as many are kept as predict best, each
/// more only where the windows' error falls by Policy::material. Far from the measurements an effect that is
/// there may make the error larger as long as others are missing: the first that does is no end. Train and
/// held-out windows count together: there a few windows that run away decide on either.
void keep_what_predicts(const Policy& policy, Diagnosis& diagnosis) {
  const auto error = [&](std::size_t named) {
    const validation::Rung& rung = diagnosis.ladder[diagnosis.bare_rungs + named - 1];
    return std::hypot(rung.train(), rung.held_out());
  };
  std::size_t kept = 0;
  for (std::size_t named = 1; named <= diagnosis.accepted.size(); ++named) {
    kept = error(named) < (1.0 - policy.material) * error(kept) ? named : kept;
  }
  diagnosis.accepted.resize(kept);
  diagnosis.ladder.resize(diagnosis.bare_rungs + kept);
  diagnosis.final_stage = diagnosis.ladder.back().stage;
}

/// A named effect's values as windows have fitted them anew, where they moved them.
void take_values(const Diagnosis& further, Finding& finding) {
  const model::Model model = validation::fitted_model(further.final_stage);
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const model::EffectUse& use = model.effects[e];
    if (use.at != finding.at || use.law->declaration().name != finding.effect) {
      continue;
    }
    for (validation::ParameterValue& value : finding.parameters) {
      const int index = use.law->parameter_index(value.name);
      value.value = use.values[static_cast<std::size_t>(index)].value;
      const double deviation = validation::found_deviation(further, {static_cast<int>(e), index});
      value.deviation = std::isfinite(deviation) ? deviation : value.deviation;
    }
    return;
  }
}

/// Does a base float freely in some trial? Then the ground moves it, and no torque is recorded of that.
bool floats_freely(const model::Model& model, const Data& data) {
  const auto is_held = [](const validation::Trial& trial, const model::Joint& joint) {
    return std::any_of(trial.locks.begin(), trial.locks.end(),
                       [&](const model::Lock& lock) { return lock.at == joint.name; });
  };
  return std::any_of(data.trials.begin(), data.trials.end(), [&](const validation::Trial& trial) {
    const auto& joints = model.skeleton.joints;
    return std::any_of(joints.begin(), joints.end(),
                       [&](const model::Joint& joint) { return joint.floats && !is_held(trial, joint); });
  });
}

/// Low-passed torques may put something that hangs at a link where it cannot be, and then name the centre of
/// mass: windows are asked, too. `by_torques`: the answer of the torques with the model's numbers open as
/// they are stated; what was identified beside another name says little of them. An interruption leaves what
/// is named.
void ask_windows_for_payloads(const Stage& by_torques, const effects::Catalogue& catalogue, const Data& data,
                              const Policy& policy, const Progress& progress, Diagnosis& diagnosis) {
  const std::size_t rungs = diagnosis.ladder.size();
  const Stage found = diagnosis.final_stage;
  try {
    diagnosis.final_stage = by_torques;
    validation::name_payloads(catalogue, data, policy, progress, diagnosis);
    if (diagnosis.ladder.size() > rungs) {
      const Stage& named = diagnosis.final_stage;
      validation::PredictorPool pool(named.model, data);
      diagnosis.precision = validation::precision_of(pool, data.windows_of(validation::Role::train),
                                                     named.parameters, named.estimate);
      validation::compare_rungs(data, progress, diagnosis);
    }
  } catch (const validation::Stopped&) {
    diagnosis.interrupted = true;
  }
  if (diagnosis.ladder.size() == rungs) {
    diagnosis.final_stage = found;
  } else if (diagnosis.interrupted) {
    diagnosis.precision = {};  // it may be of the parameters before
  }
}

}  // namespace

std::optional<validation::StandardFit> torque_identification(const model::Model& model, const Data& data,
                                                             const Progress& progress) {
  if (floats_freely(model, data)) {
    return {};
  }
  try {
    return validation::standard_fit(model, data, {}, progress);
  } catch (const InputError&) {
    return {};  // hidden states, feet on the ground, or positions that no sensor shows
  }
}

bool is_for_torques(const validation::Scores& scores, const Policy& policy) {
  constexpr double kFarther = 5.0;
  return scores.train > kFarther * policy.hopeless;
}

FromTorques ask_torques(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                        const Policy& policy, const Progress& progress) {
  FromTorques answer;
  // One joint has little of what torques tell apart. And nearer the windows' own search is quicker: 7 s in
  // place of more than a minute at 40 floors.
  if (model.motors.size() < 2 || floats_freely(model, data)) {
    return answer;
  }
  if (!is_for_torques(validation::compare(model, data.thinned(policy.windows)).scores, policy)) {
    return answer;
  }
  answer.standard = torque_identification(model, data, progress);
  if (answer.standard) {
    answer.stage =
        validation::torque_stage(model, catalogue, data, answer.standard->cutoff, policy, progress);
  }
  return answer;
}

Diagnosis diagnosis_of(const TorqueStage& stage, const model::Model& model, const Data& data,
                       const Policy& policy, const Progress& progress) {
  Diagnosis diagnosis;
  const Data kept = validation::without_lost(model, data, diagnosis.lost);
  progress("predictions of what the torques name", 0.9);
  validation::PredictorPool pool(model, kept);
  add_rung("as given", {model, {}, validation::estimate_states(pool)}, diagnosis);
  if (!stage.own.values.empty()) {
    const Stage own = stage_of(stage.own, kept);
    // Torques may ask for values with which nothing can be predicted.
    if (validation::is_finite(own.estimate)) {
      add_rung("model parameters fitted", own, diagnosis);
    }
  }
  diagnosis.bare_rungs = diagnosis.ladder.size();
  for (const TorqueFinding& named : stage.named) {
    diagnosis.accepted.push_back(finding_of(named, static_cast<int>(diagnosis.ladder.size())));
    add_rung("+ " + named.label(), stage_of(named.free, kept), diagnosis);
  }
  diagnosis.windows = kept.windows.size();
  validation::compare_rungs(kept, progress, diagnosis);
  keep_what_predicts(policy, diagnosis);
  validation::conclude(kept, policy, diagnosis);
  diagnosis.test_before = validation::test_error(model, data);
  diagnosis.test_after = validation::test_error(validation::fitted_model(diagnosis.final_stage), data);
  return diagnosis;
}

model::Model identified_model(const TorqueStage& stage, std::size_t named) {
  const FreeModel& free = named == 0 ? stage.own : stage.named[named - 1].free;
  model::Model model = validation::identified(free);
  const auto first = static_cast<int>(model.effects.size() - named);
  for (const FreeValue& value : free.values) {
    // Nobody has stated what was named: windows may find of it what they ask for.
    const double own = value.id.effect < first ? 0.0 : std::abs(value.value);
    model.effects[static_cast<std::size_t>(value.id.effect)]
        .values[static_cast<std::size_t>(value.id.parameter)]
        .uncertainty = std::max(value.deviation, own);
  }
  return model;
}

void join(Diagnosis further, const effects::Catalogue& catalogue, const Data& data, const Policy& policy,
          const Progress& progress, Diagnosis& first) {
  if (further.ladder.empty()) {
    first.interrupted = further.interrupted;
    return;
  }
  Stage& stage = further.final_stage;
  const bool is_open = !stage.parameters.empty() && stage.estimate.x0.size() == data.windows.size();
  if (is_open && !further.interrupted && further.precision.deviations.size() == 0) {
    validation::PredictorPool pool(stage.model, data);
    further.precision = validation::precision_of(pool, data.windows_of(validation::Role::train),
                                                 stage.parameters, stage.estimate);
  }
  for (Finding& finding : first.accepted) {
    take_values(further, finding);
  }
  const Stage by_torques = first.ladder.back().stage;
  const bool is_all = further.accepted.empty();
  const auto before = static_cast<int>(first.ladder.size()) - 1;  // "as given" there is the last rung here
  for (Finding& finding : further.accepted) {
    finding.rung += finding.rung >= 0 ? before : 0;
  }
  further.accepted.insert(further.accepted.begin(), first.accepted.begin(), first.accepted.end());
  further.ladder.erase(further.ladder.begin());
  further.ladder.insert(further.ladder.begin(), first.ladder.begin(), first.ladder.end());
  further.bare_rungs = first.bare_rungs;
  further.test_before = first.test_before;
  first = std::move(further);
  if (is_all && !first.interrupted && by_torques.estimate.x0.size() == data.windows.size()) {
    ask_windows_for_payloads(by_torques, catalogue, data, policy, progress, first);
  }
  validation::conclude(data, policy, first);
}

}  // namespace plumbline::api
