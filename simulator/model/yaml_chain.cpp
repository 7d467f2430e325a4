#include "simulator/model/yaml_chain.h"

#include <algorithm>
#include <filesystem>

#include "simulator/trace/number_text.h"

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

}  // namespace

std::vector<YamlNode> read_chain(const std::string& path, const std::string& format) {
  std::vector<YamlNode> chain{YamlNode::load(path)};
  std::vector<fs::path> seen{fs::weakly_canonical(path)};
  check_format(chain.back(), format);
  while (const auto base = chain.back().find("base")) {
    const std::string file = beside(chain.back().file(), base->text());
    std::error_code missing;
    if (!fs::is_regular_file(file, missing)) {
      base->refuse(quote(base->text()) + ", where there is no file",
                   "the path of a " + format.substr(0, format.find('/')) + " file, relative to this one");
    }
    const fs::path canonical = fs::weakly_canonical(file);
    if (std::find(seen.begin(), seen.end(), canonical) != seen.end()) {
      base->refuse(quote(base->text()) + ", which leads back to itself", "a chain of bases that ends");
    }
    seen.push_back(canonical);
    chain.push_back(YamlNode::load(file));
    check_format(chain.back(), format);
  }
  return chain;
}

std::optional<YamlNode> find_newest(const std::vector<YamlNode>& chain, const std::string& key) {
  for (const YamlNode& document : chain) {
    if (auto found = document.find(key)) {
      return found;
    }
  }
  return std::nullopt;
}

std::string beside(const std::string& file, const std::string& relative) {
  return (fs::path(file).parent_path() / relative).lexically_normal().string();
}

void begin_overlay(YAML::Emitter& out, const std::string& path, const std::string& format,
                   const std::string& base_file, const std::string& note) {
  std::error_code missing;
  if (fs::equivalent(path, base_file, missing)) {
    throw InputError({path, 0, ""}, "the base itself", "another file name for the overlay");
  }
  out << YAML::BeginMap;
  out << YAML::Key << "plumbline" << YAML::Value << format;
  emit_text(out, "base", relative_base(path, base_file));
  if (!note.empty()) {
    emit_text(out, "note", note);
  }
}

void emit_quantity(YAML::Emitter& out, const std::string& key, const QuantityText& quantity) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginMap;
  emit_number(out, "value", quantity.value);
  emit_text(out, "unit", quantity.unit);
  if (quantity.uncertainty > 0.0) {
    emit_number(out, "uncertainty", quantity.uncertainty);
  }
  emit_text(out, quantity.origin, quantity.text);
  out << YAML::EndMap;
}

}  // namespace plumbline::model
