#include "tests/battery/result_json.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace plumbline::battery {
namespace {

std::vector<std::string> names_of(const Case& one) {
  std::vector<std::string> names;
  for (const Row& row : one.rows) {
    names.push_back(name_of(row));
  }
  return names;
}

nlohmann::json recovered_json(const Result& r) {
  nlohmann::json list = nlohmann::json::array();
  for (const Recovered& one : r.recovered) {
    list.push_back({{"parameter", one.name},
                    {"true", one.truth},
                    {"value", one.value},
                    {"standard_deviation", one.deviation},
                    {"inside", one.is_inside()}});
  }
  return list;
}

/// One hidden effect, named first.
bool is_named(const Result& r) { return r.one.rows.size() == 1 && r.first == name_of(r.one.rows.front()); }

}  // namespace

nlohmann::json to_json(const Result& r) {
  return {{"case", r.one.name},
          {"robot", r.one.robot},
          {"kind", to_string(r.one.kind)},
          {"hidden", names_of(r.one)},
          {"strength", to_string(r.one.strength)},
          {"with", r.with},
          {"removed", r.one.removed},
          {"bare_held_out", r.bare},
          {"visible", r.visible},
          {"verdict", r.verdict},
          {"first_named", r.first},
          {"others_named", r.others},
          {"set_size", r.set_size},
          {"recovered", recovered_json(r)},
          {"right", r.right},
          {"in_set", r.in_set},
          {"alone", r.alone},
          {"invented", r.invented},
          {"shown", r.shown},
          {"held_out_before", r.before},
          {"held_out_after", r.after},
          {"seconds", r.seconds},
          {"processor_seconds", r.processor_seconds},
          {"error", r.error}};
}

Result result_from(const nlohmann::json& json) {
  Result r;
  try {
    r.one = case_of(json.at("case"));
    r.with = json.at("with");
    r.bare = json.at("bare_held_out");
    r.visible = json.at("visible");
    r.verdict = json.at("verdict");
    r.first = json.at("first_named");
    r.others = json.at("others_named");
    r.set_size = json.at("set_size");
    r.right = json.at("right");
    r.in_set = json.at("in_set");
    // Files of versions before foreign worlds do not say these.
    r.alone = json.value("alone", r.right && is_named(r));
    r.invented = json.value("invented", 0);
    r.shown = json.value("shown", 0.0);
    r.before = json.at("held_out_before");
    r.after = json.at("held_out_after");
    r.seconds = json.at("seconds");
    r.processor_seconds = json.at("processor_seconds");
    r.error = json.at("error");
    for (const nlohmann::json& one : json.at("recovered")) {
      r.recovered.push_back(
          {one.at("parameter"), one.at("true"), one.at("value"), one.at("standard_deviation")});
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(error.what());
  }
  return r;
}

}  // namespace plumbline::battery
