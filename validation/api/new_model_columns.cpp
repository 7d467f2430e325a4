#include "validation/api/new_model_columns.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "simulator/model/kinds.h"
#include "simulator/trace/units.h"

namespace plumbline::api {
namespace {

using validation::ColumnLook;
using validation::ColumnRole;
using validation::LogLook;

/// Letters and digits alone, lower case.
std::string bare(const std::string& text) {
  std::string letters;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return letters;
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// What of a joint's name a column is likely to have: without the word `joint`, unless a number alone is
/// left.
std::string stem_of(const std::string& joint) {
  std::string stem = bare(joint);
  const std::string word = "joint";
  const std::size_t at = stem.find(word);
  if (at == std::string::npos) {
    return stem;
  }
  std::string rest = stem;
  rest.erase(at, word.size());
  constexpr std::size_t kTelling = 3;  // letters that do not turn up by chance
  const bool tells = rest.size() >= kTelling && !std::all_of(rest.begin(), rest.end(), is_digit);
  return tells ? rest : stem;
}

/// Where the stem begins in the bare name of a column; npos: it is not there. joint1 is not in joint10.
std::size_t find_stem(const std::string& column, const std::string& stem) {
  for (std::size_t at = column.find(stem); at != std::string::npos; at = column.find(stem, at + 1)) {
    const std::size_t end = at + stem.size();
    const bool number_goes_on = is_digit(stem.back()) && end < column.size() && is_digit(column[end]);
    if (!number_goes_on) {
      return at;
    }
  }
  return std::string::npos;
}

/// The role that the rest of the name gives a column that says nothing else: `hip_m`, `i_hip`.
ColumnRole role_of_rest(const std::string& rest) {
  static const std::set<std::string> positions{"", "q", "pos", "position", "m", "meas", "measured", "actual"};
  static const std::set<std::string> commands{"i", "cur", "current", "tau", "torque", "cmd", "command", "u"};
  return positions.count(rest) != 0  ? ColumnRole::position
         : commands.count(rest) != 0 ? ColumnRole::command
                                     : ColumnRole::other;
}

ColumnRole role_of(const ColumnLook& column, const std::string& rest) {
  return column.role == ColumnRole::other ? role_of_rest(rest) : column.role;
}

bool unit_fits(const ColumnLook& column, const std::string& unit) {
  return column.unit.empty() || column.unit_is_guess || units_agree(column.unit, unit);
}

/// Has this column numbers, and the unit of a position or of a command of the joint?
bool fits(const ColumnLook& column, ColumnRole role, const JointColumns& joint,
          const std::string& command_unit) {
  const bool numbers = column.text.empty() && column.values > 0;
  return numbers &&
         ((role == ColumnRole::position && unit_fits(column, model::position_unit(joint.angular))) ||
          (role == ColumnRole::command && unit_fits(column, command_unit_at(command_unit, joint.angular))));
}

/// What the column holds of the joint's name: all of it, else its stem; empty: neither.
std::string held_of(const std::string& column, const std::string& joint) {
  for (const std::string& name : {bare(joint), stem_of(joint)}) {
    if (find_stem(column, name) != std::string::npos) {
      return name;
    }
  }
  return "";
}

/// The joint whose name the column holds: as it stands, else the longest; nullptr: none.
JointColumns* owner_of(const std::string& column, std::vector<JointColumns>& joints) {
  JointColumns* owner = nullptr;
  std::size_t longest = 0;
  for (JointColumns& joint : joints) {
    if (column == joint.joint) {
      return &joint;
    }
    const std::string held = held_of(bare(column), joint.joint);
    if (held.size() > longest) {
      owner = &joint;
      longest = held.size();
    }
  }
  return owner;
}

std::string rest_of(const std::string& column, const std::string& joint) {
  if (column == joint) {
    return "";
  }
  std::string rest = bare(column);
  const std::string held = held_of(rest, joint);
  rest.erase(find_stem(rest, held), held.size());
  return rest;
}

void match_names(const LogLook& look, const std::string& command_unit, std::vector<JointColumns>& joints) {
  for (std::size_t c = 0; c < look.columns.size(); ++c) {
    const ColumnLook& column = look.columns[c];
    JointColumns* joint = owner_of(column.name, joints);
    if (joint == nullptr || static_cast<int>(c) == look.time) {
      continue;
    }
    const ColumnRole role = role_of(column, rest_of(column.name, joint->joint));
    if (!fits(column, role, *joint, command_unit)) {
      continue;
    }
    int& taken = role == ColumnRole::position ? joint->position : joint->command;
    const bool shorter =
        taken >= 0 && column.name.size() < look.columns[static_cast<std::size_t>(taken)].name.size();
    if (taken < 0 || shorter) {
      taken = static_cast<int>(c);
    }
  }
}

/// Columns PREFIXnumber by prefix and number.
using Numbered = std::map<std::string, std::map<int, int>>;

Numbered numbered_columns(const LogLook& look) {
  constexpr std::size_t kDigits = 4;  // more are no order number
  Numbered all;
  for (std::size_t c = 0; c < look.columns.size(); ++c) {
    const std::string name = bare(look.columns[c].name);
    std::size_t digits = 0;
    while (digits < name.size() && is_digit(name[name.size() - 1 - digits])) {
      ++digits;
    }
    if (digits > 0 && digits <= kDigits && static_cast<int>(c) != look.time) {
      const std::string prefix = name.substr(0, name.size() - digits);
      all[prefix].emplace(std::stoi(name.substr(name.size() - digits)), static_cast<int>(c));
    }
  }
  return all;
}

/// One set of numbered columns of this role, one for each joint; false: it is none.
bool take_numbered(const LogLook& look, const std::string& prefix, const std::map<int, int>& columns,
                   ColumnRole role, const std::string& command_unit, std::vector<JointColumns>& joints) {
  if (columns.size() != joints.size()) {
    return false;
  }
  std::size_t j = 0;
  for (const auto& [number, column] : columns) {
    const ColumnLook& one = look.columns[static_cast<std::size_t>(column)];
    if (role_of(one, prefix) != role || !fits(one, role, joints[j++], command_unit)) {
      return false;
    }
  }
  j = 0;
  for (const auto& [number, column] : columns) {
    JointColumns& joint = joints[j++];
    (role == ColumnRole::position ? joint.position : joint.command) = column;
    (role == ColumnRole::position ? joint.position_by_number : joint.command_by_number) = true;
  }
  return true;
}

void match_numbers(const LogLook& look, const std::string& command_unit, std::vector<JointColumns>& joints) {
  const Numbered all = numbered_columns(look);
  for (const ColumnRole role : {ColumnRole::position, ColumnRole::command}) {
    const bool named = std::any_of(joints.begin(), joints.end(), [&](const JointColumns& joint) {
      return (role == ColumnRole::position ? joint.position : joint.command) >= 0;
    });
    for (auto set = all.begin(); !named && set != all.end(); ++set) {
      if (take_numbered(look, set->first, set->second, role, command_unit, joints)) {
        break;
      }
    }
  }
}

}  // namespace

std::string command_unit_at(const std::string& command_unit, bool angular) {
  return command_unit == "N m" ? model::force_unit(angular) : command_unit;
}

void match_columns(const LogLook& look, const std::string& command_unit, std::vector<JointColumns>& joints) {
  match_names(look, command_unit, joints);
  match_numbers(look, command_unit, joints);
}

}  // namespace plumbline::api
