// How a trial.yaml names a column of its data.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {

template <typename Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Item& item : items) {
    names.push_back(item.name);
  }
  return names;
}

/// Refuses a name that is no sensor of the model.
void check_sensor(const model::YamlNode& node, const std::string& name, const model::Model& model);

/// {topic, column, unit, scale, offset}, and keys that the caller reads.
ColumnUse read_column(const model::YamlNode& node, const std::string& expected_unit, const std::string& owner,
                      const std::vector<std::string>& further_keys = {});

/// The same without scale and offset, for an entry that names several columns.
ColumnUse read_named_column(const model::YamlNode& node, const model::YamlNode& name,
                            const std::string& expected_unit, const std::string& owner);

/// A quantity of zero or more; none where the key is absent.
std::optional<double> read_not_negative(const model::YamlNode& node, const std::string& key,
                                        const std::string& unit, const std::string& owner);

/// `unwrap`: true for an angle, or after what the column wraps around.
void read_wrap(const model::YamlNode& node, const std::string& expected_unit, const std::string& owner,
               ColumnUse& use);

}  // namespace plumbline::validation
