// Writes overlays: what `add` and `fit` leave behind.
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "simulator/model/correlations_section.h"
#include "simulator/model/effect_list.h"
#include "simulator/model/robot_reader.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/trace/error.h"
#include "simulator/trace/table.h"

namespace plumbline::model {
namespace {

void emit_effect(YAML::Emitter& out, const AddedEffect& added, const effects::Law& law, const Model& base,
                 const std::string& note) {
  out << YAML::BeginMap;
  out << YAML::Key << "effect" << YAML::Value << YAML::DoubleQuoted << added.effect;
  out << YAML::Key << "at" << YAML::Value << YAML::DoubleQuoted << added.at;
  if (added.again) {
    out << YAML::Key << "again" << YAML::Value << true;
  }
  out << YAML::Key << "values" << YAML::Value << YAML::BeginMap;
  for (int i = 0; i < law.parameter_count(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const double deviation = index < added.deviations.size() ? added.deviations[index] : std::nan("");
    const bool found = std::isfinite(deviation);
    emit_quantity(out, law.declaration().parameters[index].name,
                  {added.values[index], parameter_unit(base, law, added.at, i), found ? deviation : 0.0,
                   found ? "source" : "assumed", note.empty() ? "a start value, not measured" : note});
  }
  out << YAML::EndMap << YAML::EndMap;
}

const effects::Law& law_of(const AddedEffect& added, const effects::Catalogue& catalogue, const Model& base) {
  const auto law = catalogue.find(added.effect);
  if (law == nullptr) {
    std::vector<std::string> names;
    for (const auto& known : catalogue.laws()) {
      names.push_back(known->declaration().name);
    }
    throw InputError({base.file, 0, "effect"}, "\"" + added.effect + "\"",
                     "an effect of the catalogue" + nearest_names(added.effect, names));
  }
  base.resolve(*law, added.at);
  if (static_cast<int>(added.values.size()) != law->parameter_count()) {
    throw std::invalid_argument("effect " + added.effect + " added with " +
                                std::to_string(added.values.size()) + " values instead of " +
                                std::to_string(law->parameter_count()));
  }
  return *law;
}

}  // namespace

void write_overlay(const std::string& path, const std::string& base_file,
                   const std::vector<AddedEffect>& added, const std::vector<NewValue>& values,
                   const std::string& note, const effects::Catalogue& catalogue,
                   const Correlations& correlations) {
  Model model = read_model(base_file, catalogue);
  YAML::Emitter out;
  begin_overlay(out, path, "model/1", base_file, note);
  if (!added.empty()) {
    out << YAML::Key << "effects" << YAML::Value << YAML::BeginSeq;
    for (const AddedEffect& effect : added) {
      emit_effect(out, effect, law_of(effect, catalogue, model), model, note);
    }
    out << YAML::EndSeq;
  }
  if (!values.empty()) {
    out << YAML::Key << "values" << YAML::Value << YAML::BeginMap;
    for (const NewValue& value : values) {
      emit_quantity(out, value.at_key, {value.value, value.unit, value.uncertainty, "source", value.source});
    }
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
  std::string text = std::string(out.c_str()) + "\n";
  apply_overlay(YamlNode::parse(text, path), catalogue, model);  // refuse before anything is written
  const Correlations written = correlations_of_uncertain(correlations, model);
  if (!written.empty()) {
    text += correlations_text(written);
    read_correlations(YamlNode::parse(text, path).at("correlations"), model);
  }
  write_text_atomically(path, text);
}

}  // namespace plumbline::model
