#include "simulator/model/correlations_section.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "simulator/model/effect_list.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

constexpr double kDigits = 1e6;

std::vector<std::string> read_labels(const YamlNode& list, const Model& model) {
  std::vector<std::string> labels;
  for (const YamlNode& item : list.items()) {
    const std::string label = item.text();
    const Quantity* value = find_value(model, label);
    if (value == nullptr) {
      item.refuse(quote(label),
                  "effect@place:parameter of the model" + nearest_names(label, value_names(model)));
    }
    if (!(value->uncertainty > 0.0)) {
      item.refuse(quote(label) + ", which states no uncertainty", "a value with an uncertainty");
    }
    if (std::find(labels.begin(), labels.end(), label) != labels.end()) {
      item.refuse(quote(label) + " twice", "each value once");
    }
    labels.push_back(label);
  }
  return labels;
}

}  // namespace

void read_correlations(const YamlNode& node, Model& model) {
  node.allow_keys({"of", "below_diagonal"});
  Correlations read;
  read.of = read_labels(node.at("of"), model);
  const auto count = static_cast<Eigen::Index>(read.of.size());
  read.matrix = Eigen::MatrixXd::Identity(count, count);
  const YamlNode below = node.at("below_diagonal");
  const std::vector<YamlNode> rows = below.items();
  if (static_cast<Eigen::Index>(rows.size()) + 1 != count) {
    below.refuse(std::to_string(rows.size()) + " rows",
                 std::to_string(count - 1) + ", one fewer than values");
  }
  for (Eigen::Index i = 1; i < count; ++i) {
    const YamlNode& row = rows[static_cast<std::size_t>(i - 1)];
    const std::vector<YamlNode> entries = row.items();
    if (static_cast<Eigen::Index>(entries.size()) != i) {
      row.refuse(std::to_string(entries.size()) + " numbers", std::to_string(i));
    }
    for (Eigen::Index j = 0; j < i; ++j) {
      read.matrix(i, j) = read.matrix(j, i) = entries[static_cast<std::size_t>(j)].number();
    }
  }
  if (Eigen::LLT<Eigen::MatrixXd>(read.matrix).info() != Eigen::Success) {
    below.refuse("correlations that no values can have together", "a positive definite matrix");
  }
  model.correlations = joined(model.correlations.without(read.of), read);
}

std::string correlations_text(const Correlations& correlations) {
  YAML::Emitter out;
  out << YAML::BeginMap << YAML::Key << "correlations" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "of" << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const std::string& label : correlations.of) {
    out << YAML::DoubleQuoted << label;
  }
  out << YAML::EndSeq << YAML::Key << "below_diagonal" << YAML::Value << YAML::BeginSeq;
  for (Eigen::Index i = 1; i < correlations.matrix.rows(); ++i) {
    out << YAML::Flow << YAML::BeginSeq;
    for (Eigen::Index j = 0; j < i; ++j) {
      out << number_text(std::round(kDigits * correlations.matrix(i, j)) / kDigits);
    }
    out << YAML::EndSeq;
  }
  out << YAML::EndSeq << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

Correlations correlations_of_uncertain(const Correlations& all, const Model& model) {
  std::vector<std::string> unknown;
  std::copy_if(all.of.begin(), all.of.end(), std::back_inserter(unknown), [&](const std::string& label) {
    const Quantity* value = find_value(model, label);
    return value == nullptr || !(value->uncertainty > 0.0);
  });
  Correlations some = all.without(unknown);
  some.matrix = writable_correlation(some.matrix);
  return some.of.size() > 1 ? some : Correlations{};
}

}  // namespace plumbline::model
