#include "validation/report/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "simulator/model/robot_file.h"
#include "validation/identify/compare/rung_name.h"
#include "validation/identify/predict/zero_errors.h"
#include "validation/report/encode.h"
#include "validation/report/model_json.h"
#include "validation/report/parameters_json.h"
#include "validation/report/result_json.h"
#include "validation/report/temperatures.h"
#include "validation/report/traces.h"
#include "validation/report/whole_trials.h"

namespace plumbline::validation {
namespace {

using nlohmann::json;

/// Without the effects that change nothing: openings for numbers that stayed as stated.
model::Model without_null_effects(model::Model model) {
  const auto is_null = [](const model::EffectUse& use) { return use.law->is_null(use.numbers().data()); };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), is_null),
                      model.effects.end());
  return model;
}

/// A role without trials has no error.
json scores_json(const Rung& rung, const Data& data) {
  return {{"name", rung.name},
          {"train", data.has(Role::train) ? json(rung.train()) : json()},
          {"held_out", data.has(Role::held_out) ? json(rung.held_out()) : json()}};
}

std::vector<Drawn> drawn_models(const ReportContent& content, const Data& data, const Progress& progress) {
  std::vector<const Rung*> rungs{&content.ladder.front()};
  if (content.ladder.size() > 1) {
    rungs.push_back(&content.ladder.back());
  }
  std::vector<Drawn> drawn;
  drawn.reserve(rungs.size());
  for (const Rung* rung : rungs) {
    drawn.push_back({&rung->stage, compare(fitted_model(rung->stage), data, rung->stage.estimate),
                     predicted_traces(rung->stage, data, progress)});
  }
  return drawn;
}

/// What the switch calls a drawn model: the last one by all that was added, not by the ladder's last step.
std::string drawn_name(const ReportContent& content, bool first) {
  std::string name;
  if (!first && content.diagnosis.is_object()) {
    for (const json& finding : content.diagnosis.at("accepted")) {
      name += (name.empty() ? "+ " : " + ") + finding.at("effect").get<std::string>() + "@" +
              finding.at("at").get<std::string>();
    }
  }
  return !name.empty() ? name : first ? content.ladder.front().name : content.ladder.back().name;
}

json forces_json(const Stage& stage, const Data& data) {
  json list = json::array();
  for (const UnexplainedForce& force : unexplained_forces(stage, data)) {
    list.push_back(to_json(force));
  }
  return list;
}

/// How far off the stage's predictions are after a while.
json horizons_json(const Stage& stage, const Data& data) {
  PredictorPool pool(fitted_model(stage), data);
  return to_json(horizon_errors(pool, {}, stage.estimate));
}

/// By model of the ladder, by trial.
json whole_json(const ReportContent& content, const Data& data, const Progress& progress) {
  json list = json::array();
  for (const Rung& rung : content.ladder) {
    progress("whole trials: " + rung.name, 0.1);
    json trials = json::array();
    for (const WholeTrial& trial : whole_trials(fitted_model(rung.stage), data)) {
      trials.push_back(to_json(trial));
    }
    list.push_back(trials);
  }
  return list;
}

json published_json(const model::Model& given) {
  json list = json::array();
  const std::string file = given.lineage.empty() ? "" : reference_beside(given.lineage.front());
  if (!file.empty()) {
    for (const ReferenceValue& value : read_reference(file)) {
      list.push_back(to_json(value));
    }
  }
  return list;
}

}  // namespace

std::vector<Rung> lineage_ladder(const model::Model& model, const effects::Catalogue& catalogue,
                                 const Data& data, const Progress& progress) {
  std::vector<Rung> ladder;
  EffectNames known;
  for (std::size_t i = 0; i < model.lineage.size(); ++i) {
    const std::string& file = model.lineage[i];
    progress("comparing " + std::filesystem::path(file).filename().string(),
             static_cast<double>(i) / static_cast<double>(model.lineage.size()));
    const model::Model bare = model::read_model(file, catalogue);
    const model::Model one = with_zero_errors(bare, data);
    PredictorPool pool(one, data);
    ladder.push_back({rung_name(bare, known), {one, {}, estimate_states(pool)}});
    known = effect_names(bare);
  }
  return ladder;
}

std::vector<Rung> on_whole_windows(std::vector<Rung> ladder, const Data& data, const Progress& progress) {
  for (Rung& rung : ladder) {
    if (std::isinf(rung.length)) {
      continue;
    }
    if (&rung != &ladder.front() && &rung != &ladder.back()) {
      rung.name += fmt::format(" (windows of {:.3g} s)", rung.length);
      continue;
    }
    progress("whole windows: " + rung.name, 0.0);
    const Eigen::VectorXd theta = rung.stage.estimate.theta;
    PredictorPool pool(fitted_model(rung.stage), data);
    rung.stage.estimate = estimate_states(pool);
    rung.stage.estimate.theta = theta;
    rung.length = std::numeric_limits<double>::infinity();
  }
  return ladder;
}

json report_json(const ReportContent& content, const Data& data, const Progress& progress) {
  const std::vector<Drawn> drawn = drawn_models(content, data, progress);
  const Stage& last = *drawn.back().stage;
  const auto details = detailed_spans(data, drawn, content.drawing);
  const Eigen::Index points = points_of_curve(data, drawn.size(), content.drawing);
  json report{{"format", "plumbline report/1"},
              {"robot", content.given.robot},
              {"model", content.given.file},
              {"drawn", json::array()},
              {"ladder", json::array()},
              {"whole_trials", whole_json(content, data, progress)},
              {"published", published_json(content.given)},
              {"horizons", json::array()},
              {"defects", json::array()},
              {"trials", json::array()},
              {"diagnosis", content.diagnosis},
              {"unexplained", json::array()},
              {"estimates", nullptr},
              {"values", model_json(without_null_effects(fitted_model(last)))},
              {"repeat", repeat_json(content.repetition, content.given, data.trials)}};
  for (const Rung& rung : content.ladder) {
    report["ladder"].push_back(scores_json(rung, data));
  }
  progress("how sure the parameters are", 0.3);
  report["estimates"] = parameters_json(content.given, last, content.precision, data);
  for (std::size_t d = 0; d < drawn.size(); ++d) {
    progress("the force that is not explained", 0.4 + 0.2 * static_cast<double>(d));
    report["drawn"].push_back(drawn_name(content, d == 0));
    report["unexplained"].push_back(forces_json(*drawn[d].stage, data));
    report["horizons"].push_back(horizons_json(*drawn[d].stage, data));
    report["defects"].push_back(to_json(defects(fitted_model(*drawn[d].stage), data)));
  }
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    progress("drawing " + data.trials[t].name,
             0.8 + 0.2 * static_cast<double>(t) / static_cast<double>(data.trials.size()));
    if (data.stop != nullptr && data.stop->raised) {
      throw Stopped();
    }
    const std::vector<Block> blocks =
        drawing_blocks(data.trials[t].samples(), details[t], points, content.drawing.detail);
    report["trials"].push_back(trial_json(data, t, drawn, blocks));
    report["trials"].back()["temperatures"] = temperatures_json(fitted_model(last), data.trials[t], blocks);
  }
  return report;
}

}  // namespace plumbline::validation
