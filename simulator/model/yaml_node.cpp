#include "simulator/model/yaml_node.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

#include "simulator/trace/file_text.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

int line_of(const YAML::Mark& mark) { return mark.is_null() ? 0 : mark.line + 1; }

/// Lets a parser run without keeping anything.
class IgnoreEvents final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {}
  void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {}
  void OnMapEnd() override {}
};

/// YAML::LoadAll() would not end on some texts (",a: b"), because
/// yaml-cpp's parser does not move past a token that begins no document.
bool has_second_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  IgnoreEvents ignore;
  return parser.HandleNextDocument(ignore) && parser.HandleNextDocument(ignore);
}

YAML::Node only_document(const std::string& text, const std::string& file) {
  try {
    YAML::Node document = YAML::Load(text);
    if (has_second_document(text)) {
      throw InputError({file, 0, ""}, "more than one YAML document", "one");
    }
    return document;
  } catch (const YAML::Exception& error) {
    throw InputError({file, line_of(error.mark), ""}, "text that is no YAML (" + error.msg + ")",
                     "a whole YAML file");
  }
}

std::optional<double> infinity_of(const std::string& text) {
  static const std::set<std::string> positive{".inf", ".Inf", ".INF", "+.inf", "+.Inf", "+.INF"};
  static const std::set<std::string> negative{"-.inf", "-.Inf", "-.INF"};
  if (positive.count(text) != 0) {
    return std::numeric_limits<double>::infinity();
  }
  return negative.count(text) != 0 ? std::optional<double>(-std::numeric_limits<double>::infinity())
                                   : std::nullopt;
}

}  // namespace

void check_format(const YamlNode& root, const std::string& format) {
  const auto line = root.find("plumbline");
  if (!line) {
    root.refuse("no version line", quote("plumbline: " + format) + " as the first line");
  }
  if (line->text() != format) {
    line->refuse("`plumbline: " + format + "`");
  }
}

std::string quote(const std::string& text) { return "\"" + text + "\""; }

YamlNode::YamlNode(const YAML::Node& node, std::string file, int line, std::string key)
    : node_(node), file_(std::move(file)), line_(line), key_(std::move(key)) {}

YamlNode YamlNode::load(const std::string& path) { return parse(read_text(path), path); }

YamlNode YamlNode::parse(const std::string& text, const std::string& file) {
  YamlNode root(only_document(text, file), file, 1, "");
  if (!root.is_map()) {
    root.refuse("a map of keys, beginning with `plumbline: ...`");
  }
  return root;
}

YamlNode YamlNode::child(const YAML::Node& node, int line, const std::string& key) const {
  return {node, file_, line > 0 ? line : line_, key_.empty() ? key : key_ + "." + key};
}

void YamlNode::refuse(const std::string& found, const std::string& expected) const {
  throw InputError(place(), found, expected);
}

std::string YamlNode::found() const {
  if (node_.IsMap()) {
    return "a map";
  }
  if (node_.IsSequence()) {
    return "a list";
  }
  return node_.IsScalar() ? quote(node_.Scalar()) : "nothing";
}

std::vector<std::pair<std::string, YamlNode>> YamlNode::entries() const {
  if (!node_.IsMap()) {
    refuse("a map");
  }
  std::vector<std::pair<std::string, YamlNode>> pairs;
  std::set<std::string> seen;
  for (const auto& pair : node_) {
    const int line = line_of(pair.first.Mark());
    if (!pair.first.IsScalar() || pair.first.Scalar().empty()) {
      child(pair.first, line, "key").refuse("a name as key");
    }
    const std::string& name = pair.first.Scalar();
    YamlNode value = child(pair.second, line, name);
    if (!seen.insert(name).second) {
      value.refuse("this key twice", "each key once");
    }
    pairs.emplace_back(name, std::move(value));
  }
  return pairs;
}

std::vector<YamlNode> YamlNode::items() const {
  if (!node_.IsSequence()) {
    refuse("a list");
  }
  std::vector<YamlNode> list;
  for (const auto& item : node_) {
    list.push_back(child(item, line_of(item.Mark()), std::to_string(list.size() + 1)));
  }
  return list;
}

void YamlNode::allow_keys(const std::vector<std::string>& known) const {
  for (const auto& [name, value] : entries()) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      value.refuse("an unknown key", "a known key" + nearest_names(name, known));
    }
  }
}

std::optional<YamlNode> YamlNode::find(const std::string& key) const {
  for (auto& [name, value] : entries()) {
    if (name == key) {
      return value;
    }
  }
  return std::nullopt;
}

YamlNode YamlNode::at(const std::string& key) const {
  if (const std::optional<YamlNode> value = find(key)) {
    return *value;
  }
  refuse("no " + quote(key), "the key " + quote(key));
}

std::string YamlNode::text() const {
  if (!node_.IsScalar() || node_.Scalar().find_first_not_of(" \t\r\n") == std::string::npos) {
    refuse("a text");
  }
  return node_.Scalar();
}

bool YamlNode::flag() const {
  const std::string given = node_.IsScalar() ? node_.Scalar() : "";
  if (given != "true" && given != "false") {
    refuse("true or false");
  }
  return given == "true";
}

double YamlNode::number() const {
  const std::optional<double> value = node_.IsScalar() ? parse_number(node_.Scalar()) : std::nullopt;
  if (!value) {
    refuse("a finite number");
  }
  return *value;
}

double YamlNode::number_or_infinity() const {
  const std::optional<double> infinite = node_.IsScalar() ? infinity_of(node_.Scalar()) : std::nullopt;
  return infinite ? *infinite : number();
}

}  // namespace plumbline::model
