// A node of a YAML file that knows where it stands: file, line and the keys that lead to it.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulator/trace/error.h"

namespace plumbline::model {

/// Every reading function throws InputError (file, line, key, found, expected) when the content is not as
/// asked.
class YamlNode {
 public:
  /// The single document of a file, which must be a map.
  static YamlNode load(const std::string& path);
  /// The same from text; `file` is used in messages.
  static YamlNode parse(const std::string& text, const std::string& file);

  const std::string& file() const { return file_; }
  int line() const { return line_; }
  const std::string& key() const { return key_; }

  /// Refuses keys of this map that are not in the list, with the nearest known names.
  void allow_keys(const std::vector<std::string>& known) const;
  bool has(const std::string& key) const { return find(key).has_value(); }
  std::optional<YamlNode> find(const std::string& key) const;
  YamlNode at(const std::string& key) const;

  /// The pairs of a map in file order; duplicate keys are refused.
  std::vector<std::pair<std::string, YamlNode>> entries() const;
  /// The items of a list.
  std::vector<YamlNode> items() const;

  bool is_map() const { return node_.IsMap(); }
  /// A text that is not empty.
  std::string text() const;
  /// true or false.
  bool flag() const;
  /// A finite number.
  double number() const;
  /// A finite number, or .inf / -.inf.
  double number_or_infinity() const;

  /// What stands here, for messages: the quoted text, "a map", "a list", "nothing".
  std::string found() const;
  Place_in_file place() const { return {file_, line_, key_}; }
  [[noreturn]] void refuse(const std::string& expected) const { refuse(found(), expected); }
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;

 private:
  YamlNode(const YAML::Node& node, std::string file, int line, std::string key);
  YamlNode child(const YAML::Node& node, int line, const std::string& key) const;

  YAML::Node node_;
  std::string file_;
  int line_ = 0;
  std::string key_;
};

/// Refuses a file whose `plumbline:` line is missing or not exactly `format`.
void check_format(const YamlNode& root, const std::string& format);

/// "a" in quotation marks.
std::string quote(const std::string& text);

}  // namespace plumbline::model
