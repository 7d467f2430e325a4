#include "validation/report/result_json.h"

#include "validation/identify/diagnose/own_parameters.h"
#include "validation/report/json_number.h"
#include "validation/report/sentences.h"

namespace plumbline::validation {
namespace {

/// 0: there is no trial of role test.
nlohmann::json test_or_null(double error) { return error > 0.0 ? nlohmann::json(error) : nlohmann::json(); }

nlohmann::json to_json(const RankRow& row) {
  return {{"effect", row.effect},
          {"at", row.at},
          {"score", row.score},
          {"held_out_after", row.held_out_after},
          {"train_after", row.train_after},
          {"refitted", row.refitted},
          {"selected_share", row.selected_share},
          {"judged_interval", {row.judged_low, row.judged_high}},
          {"remark", row.remark}};
}

nlohmann::json to_json(const PairRow& row) {
  return {{"effects",
           {{{"effect", row.first.effect}, {"at", row.first.at}},
            {{"effect", row.second.effect}, {"at", row.second.at}}}},
          {"train_after", row.train_after},
          {"held_out_after", row.held_out_after},
          {"selected_share", row.selected_share},
          {"remark", row.remark}};
}

nlohmann::json to_json(const Finding& finding) {
  nlohmann::json json{{"effect", finding.effect},
                      {"at", finding.at},
                      {"equation", finding.equation},
                      {"held_out_before", finding.held_out_before},
                      {"held_out_after", finding.held_out_after},
                      {"train_before", finding.train_before},
                      {"train_after", finding.train_after},
                      {"selected_share", finding.selected_share},
                      {"together_with", finding.together_with},
                      {"open_in_train", finding.open_in_train},
                      {"rivals", nlohmann::json::array()},
                      {"parameters", nlohmann::json::array()}};
  for (const Rival& rival : finding.rivals) {
    json["rivals"].push_back({{"effect", rival.name.effect},
                              {"at", rival.name.at},
                              {"correlation", rival.correlation},
                              {"same", rival.same}});
  }
  for (const ParameterValue& p : finding.parameters) {
    json["parameters"].push_back({{"name", p.name},
                                  {"unit", p.unit},
                                  {"value", p.value},
                                  {"standard_deviation", p.deviation},
                                  {"chosen", p.chosen}});
  }
  return json;
}

}  // namespace

nlohmann::json to_json(const std::vector<HorizonError>& errors) {
  nlohmann::json json = nlohmann::json::array();
  for (const HorizonError& one : errors) {
    json.push_back({{"trial", one.trial},
                    {"channel", one.channel},
                    {"role", to_string(one.role)},
                    {"unit", one.unit},
                    {"horizon", one.horizon},
                    {"rms", json_number(one.rms)},
                    {"windows", one.windows},
                    {"lost", one.lost}});
  }
  return json;
}

nlohmann::json to_json(const UnexplainedForce& force) {
  nlohmann::json json{{"trial", force.trial},
                      {"at", force.at},
                      {"of", force.of},
                      {"unit", force.unit},
                      {"rms", force.rms},
                      {"relative", force.relative},
                      {"sensors_alone", force.sensors},
                      {"below", force.below > 0.0 ? nlohmann::json(force.below) : nlohmann::json()},
                      {"words", force.words},
                      {"dependences", nlohmann::json::array()}};
  for (const Dependence& d : force.dependences) {
    json["dependences"].push_back({{"variable", d.variable},
                                   {"unit", d.unit},
                                   {"share", d.share},
                                   {"of_size", d.of_size},
                                   {"repeats", d.repeats},
                                   {"center", d.center},
                                   {"mean", d.mean}});
  }
  return json;
}

nlohmann::json to_json(const Comparison& comparison) {
  nlohmann::json json;
  json["train"] = comparison.scores.train;
  json["held_out"] = comparison.scores.held_out;
  json["test"] = test_or_null(comparison.scores.test);
  json["channels"] = nlohmann::json::array();
  for (const ChannelError& c : comparison.channels) {
    json["channels"].push_back({{"trial", c.trial},
                                {"name", c.name},
                                {"unit", c.unit},
                                {"role", to_string(c.role)},
                                {"rms", c.rms},
                                {"floor", c.floor},
                                {"ratio", c.ratio}});
  }
  json["windows"] = nlohmann::json::array();
  for (const WindowError& w : comparison.windows) {
    json["windows"].push_back({{"trial", w.trial},
                               {"from", w.from},
                               {"to", w.to},
                               {"ratio", w.ratio},
                               {"worst_channel", w.worst_channel}});
  }
  json["lost"] = nlohmann::json::array();
  for (const LostWindow& w : comparison.lost) {
    json["lost"].push_back({{"trial", w.trial}, {"from", w.from}, {"to", w.to}, {"reason", w.reason}});
  }
  json["switches"] = nlohmann::json::array();
  for (const SwitchTiming& s : comparison.switches) {
    json["switches"].push_back({{"trial", s.trial},
                                {"name", s.name},
                                {"closes", s.closes},
                                {"count", s.count},
                                {"mean", s.mean},
                                {"scatter", s.scatter},
                                {"floor", s.floor},
                                {"steady", s.is_steady()}});
  }
  json["phases"] = nlohmann::json::array();
  for (const PhaseError& p : comparison.phases) {
    json["phases"].push_back({{"trial", p.trial},
                              {"channel", p.channel},
                              {"unit", p.unit},
                              {"group", p.phase.group},
                              {"phase", p.phase.name},
                              {"share", p.share},
                              {"rms", p.rms},
                              {"mean", p.mean},
                              {"ratio", p.ratio}});
  }
  if (!comparison.predicted.empty()) {
    json["horizons"] = to_json(comparison.horizons);
    json["defects"] = to_json(comparison.defects);
  }
  return json;
}

nlohmann::json to_json(const std::vector<Defect>& defects) {
  nlohmann::json json = nlohmann::json::array();
  for (const Defect& one : defects) {
    json.push_back({{"trial", one.trial},
                    {"role", to_string(one.role)},
                    {"time", one.time},
                    {"at", one.at},
                    {"unit", one.unit},
                    {"jump", one.jump},
                    {"impulse", one.is_speed ? nlohmann::json(one.impulse) : nlohmann::json()},
                    {"deviations", json_number(one.deviations)}});
  }
  return json;
}

nlohmann::json to_json(const std::vector<LawShare>& laws) {
  nlohmann::json json = nlohmann::json::array();
  for (const LawShare& one : laws) {
    json.push_back({{"effect", one.effect}, {"at", one.at}, {"share", one.share}});
  }
  return json;
}

nlohmann::json to_json(const Diagnosis& diagnosis, const std::vector<UnexplainedForce>& left) {
  nlohmann::json json;
  json["at_one_place"] = nullptr;
  if (const std::optional<OnePlace>& place = diagnosis.at_one_place) {
    json["at_one_place"] = {{"at", place->at}, {"share", place->share}, {"laws", to_json(place->laws)}};
  }
  json["verdict"] = to_string(diagnosis.verdict);
  json["summary"] = summary(diagnosis);
  json["unexplained_share"] = diagnosis.unexplained_share;
  json["candidates"] = diagnosis.candidates;
  json["interrupted"] = diagnosis.interrupted;
  json["windows"] = diagnosis.windows;
  json["cut_windows"] = diagnosis.cut_windows;
  json["unused_windows"] = diagnosis.unused_windows;
  json["test_before"] = test_or_null(diagnosis.test_before);
  json["test_after"] = test_or_null(diagnosis.test_after);
  for (const char* key :
       {"accepted", "withdrawn", "model_parameters", "ranking", "leads", "pairs", "ladder"}) {
    json[key] = nlohmann::json::array();
  }
  for (const Finding& finding : diagnosis.accepted) {
    json["accepted"].push_back(to_json(finding));
  }
  for (const Named& one : diagnosis.withdrawn) {
    json["withdrawn"].push_back({{"effect", one.effect}, {"at", one.at}});
  }
  for (const RankRow& row : diagnosis.ranking) {
    json["ranking"].push_back(to_json(row));
  }
  for (const RankRow& row : diagnosis.leads) {
    json["leads"].push_back(to_json(row));
  }
  for (const PairRow& row : diagnosis.pairs) {
    json["pairs"].push_back(to_json(row));
  }
  for (const OwnParameter& own : own_values(diagnosis.final_stage)) {
    json["model_parameters"].push_back({{"parameter", own.label},
                                        {"unit", own.unit},
                                        {"stated", own.stated},
                                        {"stated_deviation", own.stated_deviation},
                                        {"value", own.value},
                                        {"shift", own.shift()}});
  }
  for (const Rung& rung : diagnosis.ladder) {
    json["ladder"].push_back({{"name", rung.name},
                              {"length", json_number(rung.length)},
                              {"train", rung.train()},
                              {"held_out", rung.held_out()},
                              {"predictive", rung.foretold()}});
  }
  json["unexplained_forces"] = nlohmann::json::array();
  for (const UnexplainedForce& one : left) {
    json["unexplained_forces"].push_back(to_json(one));
  }
  return json;
}

}  // namespace plumbline::validation
