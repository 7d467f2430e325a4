#include "validation/identify/trial/trial_from_log.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "simulator/model/kinds.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"
#include "validation/identify/trial/new_folder.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

constexpr int kSentenceDigits = 4;

std::string number(double value) { return number_text(value, kSentenceDigits); }

/// A text as YAML takes it between double quotes.
std::string quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20;
    safe += c == '"' || c == '\\' ? "\\" : "";
    safe += is_control ? ' ' : c;
  }
  return safe + "\"";
}

/// As it stands, where YAML reads it back as that text in a flow map.
std::string yaml_text(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '/' || c == '.'; };
  const bool is_word = !text.empty() && std::all_of(text.begin(), text.end(), plain) &&
                       std::isalpha(static_cast<unsigned char>(text.front())) != 0;
  static const std::set<std::string> spoken_for{"y", "n", "yes", "no", "on", "off", "true", "false", "null"};
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return is_word && spoken_for.count(lower) == 0 ? text : quoted(text);
}

/// A name that a model may give, from a column's.
std::string legal_name(const std::string& column) {
  std::string name;
  for (const char c : column) {
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' ? c : '_';
  }
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
    name.insert(0, "c");
  }
  return name;
}

/// Longest common run of letters and digits, lower case: how near two names are.
std::size_t likeness(const std::string& a, const std::string& b) {
  const auto bare = [](const std::string& text) {
    std::string letters;
    for (const char c : text) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    return letters;
  };
  const std::string left = bare(a);
  const std::string right = bare(b);
  std::size_t longest = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < right.size(); ++j) {
      std::size_t n = 0;
      while (i + n < left.size() && j + n < right.size() && left[i + n] == right[j + n]) {
        ++n;
      }
      longest = std::max(longest, n);
    }
  }
  return longest;
}

/// Something of the model that wants a column.
struct Wanted {
  std::string name, unit;
  ColumnRole role;
};

class Writer {
 public:
  Writer(const LogLook& look, const model::Model* model) : look_(look), model_(model) {}

  std::string text(const std::string& data, const std::string& model_file) {
    out_ << "# Made from " << fs::path(look_.file).filename().string()
         << ". What is marked as a guess, and every sign, wants a look.\n"
         << "plumbline: trial/1\n"
         << "title: " << quoted(fs::path(look_.file).stem().string() + ": what was done, in a few words")
         << "\n\n"
         << "model: " << yaml_text(model_file)
         << "          # the robot's model file, relative to this file\n"
         << "role: train               # or held-out: another kind of motion, never fitted\n\n"
         << "data: " << yaml_text(data) << "\n";
    if (!look_.topics.empty()) {
      out_ << "topic: " << yaml_text(look_.topics.front())
           << "          # of the bag: whose messages are the rows; a column may name another\n";
    }
    write_table();
    write_time();
    choose();
    write_commands();
    write_measured();
    write_rest();
    return out_.str();
  }

 private:
  void write_table() {
    out_ << "\n# " << look_.rows << " rows, " << look_.columns.size() << " columns:\n";
    for (const ColumnLook& column : look_.columns) {
      out_ << "#   " << column.name << (column.unit.empty() ? "" : " [" + column.unit + "]")
           << (column.unit_is_guess ? " (unit guessed)" : "") << ": " << number(column.lowest) << " to "
           << number(column.highest);
      if (column.step > 0.0) {
        out_ << ", steps of " << number(column.step);
      }
      if (column.missing > 0) {
        out_ << ", " << column.missing << " cells without a number"
             << (column.text.empty() ? "" : " such as " + quoted(column.text));
      }
      out_ << "; " << to_string(column.role) << (column.why.empty() ? "" : ": " + column.why) << "\n";
    }
    for (const std::string& remark : look_.remarks) {
      out_ << "# " << remark << "\n";
    }
    out_ << "\n";
  }

  /// Of a bag without the topic that the trial names, of another topic without its slash.
  std::string own_name(const std::string& name) const {
    if (look_.topics.empty()) {
      return name;
    }
    const std::string& first = look_.topics.front();
    return name.rfind(first + ".", 0) == 0 ? name.substr(first.size() + 1)
                                           : name.substr(name.find_first_not_of('/'));
  }

  /// `column: NAME`, of a bag without the topic that the trial names, or with one of its own.
  std::string column_key(const std::string& name) const {
    for (const std::string& topic : look_.topics) {
      if (name.rfind(topic + ".", 0) == 0) {
        const std::string own = topic == look_.topics.front() ? "" : "topic: " + yaml_text(topic) + ", ";
        return own + "column: " + yaml_text(name.substr(topic.size() + 1));
      }
    }
    return "column: " + yaml_text(name);
  }

  void write_time() {
    if (look_.time < 0) {
      out_ << "time: {rate: {value: 1000, unit: Hz}}  # no column rises like a time: state the rate\n\n";
      return;
    }
    const ColumnLook& time = look_.columns[static_cast<std::size_t>(look_.time)];
    out_ << "time: {" << column_key(time.name) << ", unit: " << time.unit << "}"
         << (time.unit_is_guess ? "  # unit guessed" : "") << "\n"
         << "# " << number(look_.duration) << " s; steps of " << number(1e3 * look_.shortest_step) << " to "
         << number(1e3 * look_.longest_step) << " ms, the median " << number(1e3 * look_.median_step)
         << " ms";
    if (look_.longest_step > 1.01 * look_.median_step || look_.shortest_step < 0.99 * look_.median_step) {
      out_ << ":\n# resampled at the median step. Add `resample: {value: " << number(1e3 * look_.median_step)
           << ", unit: ms}` for a period of your own, or `resample: even`\n"
              "# where the samples were even and only their stamps jitter";
    }
    out_ << ".\n";
    if (look_.gaps > 0) {
      out_ << "# " << look_.gaps << " gaps of more than five steps: no part of the trial.\n";
    }
    if (look_.not_rising > 0) {
      out_ << "rows: {bad: leave_out}  # " << look_.not_rising
           << " rows have a time that is not above that of the row before\n";
    }
    const bool any_missing =
        std::any_of(look_.columns.begin(), look_.columns.end(),
                    [](const ColumnLook& one) { return one.missing > 0 && one.text.empty(); });
    if (any_missing) {
      out_ << "missing: fill             # cells without a number are bridged; long runs are no part of the "
              "trial\n";
    }
    out_ << "\n";
  }

  std::vector<Wanted> wanted() const {
    std::vector<Wanted> all;
    for (const model::Motor& motor : model_->motors) {
      all.push_back({motor.name, motor.command_unit, ColumnRole::command});
    }
    for (const model::Sensor& sensor : model_->sensors) {
      if (sensor.reading == model::PointReading::orientation) {
        continue;  // has a quaternion's four columns
      }
      if (sensor.reading == model::PointReading::accelerometer) {
        all.push_back({sensor.name, model::reading_unit(*model_, sensor.name), ColumnRole::other});
        continue;
      }
      all.push_back({sensor.name, model::reading_unit(*model_, sensor.name),
                     sensor.is_force_plate() ? ColumnRole::force
                     : sensor.rate || sensor.reading == model::PointReading::gyroscope
                         ? ColumnRole::rate
                         : ColumnRole::position});
    }
    for (const model::ContactSwitch& contact : model_->switches) {
      all.push_back({contact.name, "1", ColumnRole::contact});
    }
    return all;
  }

  /// Which column is whose: with a model the nearest names first, then what is left in the file's order.
  void choose() {
    if (model_ == nullptr) {
      for (std::size_t i = 0; i < look_.columns.size(); ++i) {
        const ColumnLook& column = look_.columns[i];
        const bool measured = column.role == ColumnRole::position || column.role == ColumnRole::contact ||
                              column.role == ColumnRole::force;
        if ((measured || column.role == ColumnRole::command) && column.text.empty() && column.values > 1) {
          chosen_.push_back({legal_name(own_name(column.name)), column.role, static_cast<int>(i)});
        }
      }
      return;
    }
    const std::vector<Wanted> all = wanted();
    std::vector<int> of(all.size(), -1);
    std::set<std::size_t> taken;
    for (const bool by_name : {true, false}) {
      while (true) {
        std::size_t best = 0;
        std::size_t item = 0;
        std::size_t column = 0;
        for (std::size_t w = 0; w < all.size(); ++w) {
          for (std::size_t c = 0; c < look_.columns.size() && of[w] < 0; ++c) {
            if (taken.count(c) != 0 || !fits(all[w], look_.columns[c])) {
              continue;
            }
            constexpr std::size_t kAlike = 2;  // letters in a row
            const std::size_t like = likeness(all[w].name, look_.columns[c].name);
            const std::size_t score = by_name ? (like >= kAlike ? like : 0) : 1;
            if (score > best) {
              best = score;
              item = w;
              column = c;
            }
          }
        }
        if (best == 0) {
          break;
        }
        of[item] = static_cast<int>(column);
        taken.insert(column);
      }
    }
    for (std::size_t w = 0; w < all.size(); ++w) {
      chosen_.push_back({all[w].name, all[w].role, of[w]});
    }
  }

  static bool fits(const Wanted& wanted, const ColumnLook& column) {
    return column.role == wanted.role && column.text.empty() &&
           (column.unit.empty() || column.unit_is_guess || units_agree(column.unit, wanted.unit));
  }

  struct Choice {
    std::string name;
    ColumnRole role;
    int column;  ///< -1: none fits
  };

  void write_choice(const Choice& choice) {
    if (choice.column < 0) {
      out_ << "  # " << choice.name << ": {column: ..., unit: ...}   # no column looks like it\n";
      return;
    }
    const ColumnLook& column = look_.columns[static_cast<std::size_t>(choice.column)];
    std::string unit = column.unit;
    if (model_ != nullptr && column.unit_is_guess) {
      const std::string known =
          choice.role == ColumnRole::command   ? model_->find_motor(choice.name)->command_unit
          : choice.role == ColumnRole::contact ? "1"
                                               : model::reading_unit(*model_, choice.name);
      unit = units_agree(unit, known) ? unit : known;
    }
    out_ << "  " << choice.name << ": {" << column_key(column.name) << ", unit: "
         << (unit == "1"    ? "\"1\""
             : unit.empty() ? "\"?\""
                            : unit)
         << "}" << (column.unit_is_guess ? "   # unit guessed" : "") << "\n";
  }

  bool any_chosen(bool commands) const {
    return std::any_of(chosen_.begin(), chosen_.end(), [&](const Choice& one) {
      return one.column >= 0 && (one.role == ColumnRole::command) == commands;
    });
  }

  void write_commands() {
    const ColumnLook* reference = look_.find(ColumnRole::reference);
    const bool any_motor = model_ == nullptr || !model_->motors.empty();
    if (any_chosen(true) || (any_motor && reference == nullptr)) {
      out_ << "commands:                 # what each motor was told (or gave), held over each sample\n";
      if (!any_chosen(true)) {
        out_ << "  motor: {column: ..., unit: N m}   # no column looks like a command\n";
      }
      for (const Choice& choice : chosen_) {
        if (choice.role == ColumnRole::command) {
          write_choice(choice);
        }
      }
      out_ << "\n";
    } else if (any_motor) {
      const std::string motor = model_ != nullptr ? model_->motors.front().name : "motor";
      out_ << "# No column looks like a command, but " << reference->name << " looks like a reference:\n"
           << "controllers:\n"
           << "  - kind: pd              # command = position_gain (reference - measured) - velocity_gain "
              "d(measured)/dt\n"
           << "    motor: " << motor << "\n    sensor: "
           << (model_ != nullptr && !model_->sensors.empty() ? model_->sensors.front().name : "sensor")
           << "\n"
           << "    reference: {column: " << yaml_text(reference->name) << ", unit: " << reference->unit
           << "}\n"
           << "    position_gain: {value: 1, unit: N m/rad, assumed: \"put the gain here\"}\n"
           << "    velocity_gain: {value: 0, unit: N m s/rad, assumed: \"put the gain here\"}\n\n";
    }
  }

  /// Names of four columns that differ in their last letter alone, w x y z; empty: there are none.
  std::vector<std::string> quaternion_columns() const {
    const auto named = [&](const std::string& name) {
      return std::any_of(look_.columns.begin(), look_.columns.end(),
                         [&](const ColumnLook& one) { return one.name == name && one.text.empty(); });
    };
    for (const ColumnLook& column : look_.columns) {
      for (const char* letters : {"wxyz", "WXYZ", "0123"}) {
        if (column.name.empty() || column.name.back() != letters[0]) {
          continue;
        }
        const std::string stem = column.name.substr(0, column.name.size() - 1);
        const std::vector<std::string> all{column.name, stem + letters[1], stem + letters[2],
                                           stem + letters[3]};
        if (std::all_of(all.begin(), all.end(), named)) {
          return all;
        }
      }
    }
    return {};
  }

  void write_orientations() {
    for (const model::Sensor& sensor : model_ == nullptr ? std::vector<model::Sensor>{} : model_->sensors) {
      if (sensor.reading != model::PointReading::orientation || sensor.axis != 0) {
        continue;
      }
      const std::vector<std::string> columns = quaternion_columns();
      if (columns.empty()) {
        out_ << "  # " << sensor.group
             << ": {columns: [w, x, y, z], unit: \"1\"}   # no four look like a quaternion\n";
        continue;
      }
      out_ << "  " << sensor.group << ": {columns: [";
      for (std::size_t i = 0; i < columns.size(); ++i) {
        out_ << (i > 0 ? ", " : "") << yaml_text(columns[i]);
      }
      out_ << "], unit: \"1\"}\n";
    }
  }

  void write_measured() {
    out_ << "measured:                 # what was measured: sensor of the model -> column\n";
    write_orientations();
    for (const Choice& choice : chosen_) {
      if (choice.role != ColumnRole::command) {
        write_choice(choice);
      }
    }
    if (!any_chosen(false)) {
      out_ << "  sensor: {column: ..., unit: rad}   # no column looks like a position\n";
    }
    out_ << "\n";
  }

  void write_rest() {
    for (const ColumnLook& column : look_.columns) {
      if (column.role == ColumnRole::rate) {
        out_ << "# " << column.name << (column.unit.empty() ? "" : " [" + column.unit + "]")
             << " looks like a rate: it can be a channel of a sensor with `rate: true` in the model.\n";
      }
    }
    out_ << R"(
# What else a channel may say: scale: -1 (another sign, or the size of a count), offset: {value: 90, unit: deg},
# unwrap: true (an angle that begins anew after a turn), resolution: {...} and noise: {...} in place of the
# model's, offset_uncertainty: {value: 1, unit: deg} (its zero is not well known).
# What else the trial may say:
# section: {from: {value: 1, unit: s}, to: {value: 9, unit: s}}          # or a list of these
# leave_out: [{from: {value: 4.2, unit: s}, to: {value: 4.9, unit: s}}]  # somebody pushed it
# locked: {other_joint: {value: 0, unit: deg}}
# events: [2.5 s]                                                        # it was struck
)";
  }

  const LogLook& look_;
  const model::Model* model_;
  std::vector<Choice> chosen_;
  std::ostringstream out_;
};

}  // namespace

std::string trial_text(const LogLook& look, const model::Model* model, const std::string& data,
                       const std::string& model_file) {
  return Writer(look, model).text(data, model_file);
}

LogLook look_at_log(const std::string& log, const std::vector<std::string>& topics) {
  if (!topics.empty() && !is_bag(log)) {
    throw InputError({log, 0, ""}, "a topic of a file that is no bag", "a bag (.mcap, .db3)");
  }
  LogQuestion question;
  question.topics = topics;
  return look_at(read_log(log, question));
}

LogLook new_trial_from_log(const std::string& folder, const std::string& log, const model::Model* model,
                           const std::vector<std::string>& topics) {
  const LogLook look = look_at_log(log, topics);
  const fs::path target = fs::absolute(folder).lexically_normal();
  const auto from_there = [&](const std::string& path) {
    return fs::proximate(fs::absolute(path).lexically_normal(), target).string();
  };
  const std::string text =
      trial_text(look, model, from_there(log), model == nullptr ? "../model.yaml" : from_there(model->file));
  write_new_folder(folder, [&](const std::string& temporary) {
    write_text_atomically((fs::path(temporary) / "trial.yaml").string(), text);
  });
  return look;
}

}  // namespace plumbline::validation
