// Writes overlays: what `add` and `fit` leave behind.
#include <yaml-cpp/yaml.h>

#include <filesystem>

#include "simulator/model/effect_list.h"
#include "simulator/model/robot_reader.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/table.h"

namespace plumbline::model {
namespace {

namespace fs = std::filesystem;

std::string relative_base(const std::string& overlay, const std::string& base) {
  const fs::path folder = fs::weakly_canonical(fs::absolute(overlay)).parent_path();
  return fs::weakly_canonical(fs::absolute(base)).lexically_proximate(folder).generic_string();
}

void emit_text(YAML::Emitter& out, const char* key, const std::string& text) {
  out << YAML::Key << key << YAML::Value << YAML::DoubleQuoted << text;
}

void emit_number(YAML::Emitter& out, const char* key, double number) {
  out << YAML::Key << key << YAML::Value << number_text(number);
}

void emit_effect(YAML::Emitter& out, const AddedEffect& added, const effects::Law& law, const Model& base,
                 const std::string& note) {
  out << YAML::BeginMap;
  emit_text(out, "effect", added.effect);
  emit_text(out, "at", added.at);
  if (added.again) {
    out << YAML::Key << "again" << YAML::Value << true;
  }
  out << YAML::Key << "values" << YAML::Value << YAML::BeginMap;
  for (int i = 0; i < law.parameter_count(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    out << YAML::Key << law.declaration().parameters[index].name << YAML::Value << YAML::Flow
        << YAML::BeginMap;
    emit_number(out, "value", added.values[index]);
    emit_text(out, "unit", parameter_unit(base, law, added.at, i));
    emit_text(out, "assumed", note.empty() ? "a start value, not measured" : note);
    out << YAML::EndMap;
  }
  out << YAML::EndMap << YAML::EndMap;
}

void emit_value(YAML::Emitter& out, const NewValue& value) {
  out << YAML::Key << YAML::DoubleQuoted << value.at_key << YAML::Value << YAML::Flow << YAML::BeginMap;
  emit_number(out, "value", value.value);
  emit_text(out, "unit", value.unit);
  if (value.uncertainty > 0.0) {
    emit_number(out, "uncertainty", value.uncertainty);
  }
  emit_text(out, "source", value.source);
  out << YAML::EndMap;
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
                   const std::string& note, const effects::Catalogue& catalogue) {
  Model model = read_model(base_file, catalogue);
  std::error_code missing;
  if (fs::equivalent(path, base_file, missing)) {
    throw InputError({path, 0, ""}, "the base itself", "another file name for the overlay");
  }
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "plumbline" << YAML::Value << "model/1";
  emit_text(out, "base", relative_base(path, base_file));
  if (!note.empty()) {
    emit_text(out, "note", note);
  }
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
      emit_value(out, value);
    }
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
  const std::string text = std::string(out.c_str()) + "\n";
  apply_overlay(YamlNode::parse(text, path), catalogue, model);  // refuse before anything is written
  write_text_atomically(path, text);
}

}  // namespace plumbline::model
