// Files that change a few values of another file, their `base`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// The documents from the named file down to the one without a `base`. Each must say `plumbline: <format>`.
/// Throws InputError where one does not, where a base is no file, and where bases go round in a circle.
std::vector<YamlNode> read_chain(const std::string& path, const std::string& format);

/// The value of a key in the newest document of a chain that states it.
std::optional<YamlNode> find_newest(const std::vector<YamlNode>& chain, const std::string& key);

/// A path that is written relative to the file `file`.
std::string beside(const std::string& file, const std::string& relative);

/// Begins the text of a file `path` that changes `base_file`: format, base (relative to `path`) and note, in
/// a map that is left open. Throws InputError when the two are one file.
void begin_overlay(YAML::Emitter& out, const std::string& path, const std::string& format,
                   const std::string& base_file, const std::string& note);

/// A quantity on one line, `key: {value, unit, <origin>: text}`; origin is `source` or `assumed`. An
/// uncertainty of 0 is left out.
struct QuantityText {
  double value = 0.0;
  std::string unit;
  double uncertainty = 0.0;
  const char* origin = "assumed";
  std::string text;
};
void emit_quantity(YAML::Emitter& out, const std::string& key, const QuantityText& quantity);

}  // namespace plumbline::model
