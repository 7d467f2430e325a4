#include "validation/identify/trial/write_trial.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>

#include "simulator/model/effect_list.h"
#include "simulator/model/kinds.h"
#include "simulator/model/rotation_vector.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/table.h"
#include "simulator/trace/units.h"
#include "validation/identify/trial/new_folder.h"
#include "validation/identify/trial/physical_number.h"
#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

constexpr int kFileDigits = 15;  // 0.003 stays 0.003, and 1e-15 is far below every sensor
constexpr const char* kGainSource = "taken over from the trial that this one was made from";

std::string or_else(const std::string& text, const std::string& fallback) {
  return text.empty() ? fallback : text;
}

/// A place of the model without a line in any file.
std::string unit_of_place(const model::Model& model, const std::string& name) {
  const model::Motor* motor = model.find_motor(name);
  const model::Coordinate* coordinate = model.find_coordinate(name);
  return position_unit(motor != nullptr ? motor->angular : coordinate == nullptr || coordinate->angular);
}

std::string command_unit(const model::Model& model, const std::string& name) {
  const model::Motor* motor = model.find_motor(name);
  return motor == nullptr ? "N m" : motor->command_unit;
}

/// Fills the data table and writes trial.yaml's entries beside.
class TrialWriter {
 public:
  TrialWriter(const Trial& trial, const model::Model& model, const fs::path& folder)
      : trial_(trial), model_(model), folder_(folder) {}

  std::string yaml() {
    out_ << YAML::BeginMap;
    entry("plumbline", "trial/1");
    entry("title", or_else(trial_.title, trial_.name));
    entry("model", fs::proximate(fs::absolute(trial_.model_file), folder_).string());
    entry("role", to_string(trial_.role));
    entry("data", "data.csv");
    out_ << YAML::Key << "time" << YAML::Value;
    column("t", "s", trial_.time);
    write_stretches();
    if (trial_.clock_shift_uncertainty > 0.0) {
      quantity("clock_shift_uncertainty", trial_.clock_shift_uncertainty, "s", "");
    }
    write_commands();
    write_measured();
    write_locks();
    write_terrain();
    write_configuration();
    write_controllers();
    write_events();
    out_ << YAML::EndMap;
    return std::string(out_.c_str()) + "\n";
  }

  const Table& table() const { return table_; }

 private:
  void entry(const char* key, const std::string& value) { out_ << YAML::Key << key << YAML::Value << value; }

  /// The column goes to the table, its name and unit to trial.yaml; the map stays open.
  void begin_column(const std::string& name, const std::string& unit, const Eigen::VectorXd& si) {
    table_.columns.push_back({name, unit, si / to_si_factor(unit)});
    out_ << YAML::Flow << YAML::BeginMap << YAML::Key << "column" << YAML::Value << name << YAML::Key
         << "unit" << YAML::Value << unit;
  }

  void column(const std::string& name, const std::string& unit, const Eigen::VectorXd& si) {
    begin_column(name, unit, si);
    out_ << YAML::EndMap;
  }

  /// As a quaternion w x y z in four columns.
  void write_orientation(const std::string& name, std::size_t first) {
    Eigen::MatrixX4d q(trial_.samples(), 4);
    for (Eigen::Index k = 0; k < q.rows(); ++k) {
      Eigen::Vector3d r;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        r[static_cast<Eigen::Index>(axis)] = trial_.measured[first + axis].values[k];
      }
      const Eigen::Quaterniond turn(model::rotation_of(r));
      q.row(k) << turn.w(), turn.x(), turn.y(), turn.z();
    }
    out_ << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "columns"
         << YAML::Value << YAML::Flow << YAML::BeginSeq;
    for (int i = 0; i < 4; ++i) {
      const std::string column = name + "_" + "wxyz"[i];
      table_.columns.push_back({column, "1", q.col(i)});
      out_ << column;
    }
    out_ << YAML::EndSeq;
    floors(trial_.measured[first], "rad");
    out_ << YAML::EndMap;
  }

  void floors(const Measured& measured, const std::string& unit) {
    if (measured.resolution) {
      quantity("resolution", *measured.resolution, unit, "");
    }
    if (measured.noise) {
      quantity("noise", *measured.noise, unit, "");
    }
    if (measured.offset_uncertainty > 0.0) {
      quantity("offset_uncertainty", measured.offset_uncertainty, unit, "");
    }
  }

  void write_sensor(const Measured& measured) {
    const std::string unit = model::reading_unit(model_, measured.sensor);
    out_ << YAML::Key << measured.sensor << YAML::Value;
    begin_column(or_else(measured.column, model::reading_column(*model_.find_sensor(measured.sensor))),
                 or_else(measured.unit, unit), measured.values);
    floors(measured, unit);
    out_ << YAML::EndMap;
  }

  void quantity(const char* key, double value, const std::string& unit, const std::string& source) {
    out_ << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "value"
         << YAML::Value << number_text(value) << YAML::Key << "unit" << YAML::Value << unit;
    if (!source.empty()) {
      entry("source", source);
    }
    out_ << YAML::EndMap;
  }

  /// What lies between two stretches is left out; where no sample does, a time between two samples is.
  void write_stretches() {
    if (trial_.stretches.size() < 2) {
      return;
    }
    constexpr double kBehind = 0.25;  // samples
    out_ << YAML::Key << "leave_out" << YAML::Value << YAML::BeginSeq;
    for (std::size_t i = 0; i + 1 < trial_.stretches.size(); ++i) {
      out_ << YAML::Flow << YAML::BeginMap;
      quantity("from", trial_.time[trial_.stretches[i].end - 1] + kBehind * trial_.period, "s", "");
      quantity("to", trial_.time[trial_.stretches[i + 1].first] - kBehind * trial_.period, "s", "");
      out_ << YAML::EndMap;
    }
    out_ << YAML::EndSeq;
  }

  void write_commands() {
    if (trial_.commands.empty()) {
      return;  // of a robot without motors
    }
    out_ << YAML::Key << "commands" << YAML::Value << YAML::BeginMap;
    for (const Command& command : trial_.commands) {
      out_ << YAML::Key << command.motor << YAML::Value;
      const std::string unit = command_unit(model_, command.motor);
      begin_column(or_else(command.column, "u_" + command.motor), or_else(command.unit, unit),
                   command.values);
      if (command.before) {
        quantity("before", *command.before, unit, "");
      }
      out_ << YAML::EndMap;
    }
    out_ << YAML::EndMap;
  }

  void write_measured() {
    out_ << YAML::Key << "measured" << YAML::Value << YAML::BeginMap;
    for (std::size_t c = 0; c < trial_.measured.size(); ++c) {
      const model::Sensor& sensor = *model_.find_sensor(trial_.measured[c].sensor);
      if (sensor.reading != model::PointReading::orientation) {
        write_sensor(trial_.measured[c]);
      } else if (sensor.axis == 0) {
        write_orientation(sensor.group, c);
      }
    }
    for (const SwitchRecord& record : trial_.switches) {
      out_ << YAML::Key << record.name << YAML::Value;
      column(or_else(record.column, "contact_" + record.name), "1", record.values);
    }
    out_ << YAML::EndMap;
  }

  void write_locks() {
    if (trial_.locks.empty()) {
      return;
    }
    out_ << YAML::Key << "locked" << YAML::Value << YAML::BeginMap;
    for (const Lock& lock : trial_.locks) {
      quantity(lock.at.c_str(), lock.value, unit_of_place(model_, lock.at), "");
    }
    out_ << YAML::EndMap;
  }

  void write_terrain() {
    const contact::Terrain& terrain = trial_.terrain;
    if (terrain.platforms().empty() && terrain.floor() == 0.0) {
      return;
    }
    out_ << YAML::Key << "terrain" << YAML::Value << YAML::BeginMap;
    quantity("floor", terrain.floor(), "m", "");
    out_ << YAML::Key << "platforms" << YAML::Value << YAML::BeginSeq;
    for (const contact::Platform& platform : terrain.platforms()) {
      out_ << YAML::BeginMap;
      quantity("from", platform.from, "m", "");
      quantity("to", platform.to, "m", "");
      quantity("height", platform.height, "m", "");
      out_ << YAML::EndMap;
    }
    out_ << YAML::EndSeq << YAML::EndMap;
  }

  void write_configuration() {
    if (trial_.configuration.empty()) {
      return;
    }
    out_ << YAML::Key << "configuration" << YAML::Value << YAML::BeginMap << YAML::Key << "effects"
         << YAML::Value << YAML::BeginSeq;
    for (const model::EffectUse& use : trial_.configuration) {
      const effects::Declaration& law = use.law->declaration();
      out_ << YAML::BeginMap;
      entry("effect", law.name);
      entry("at", use.at);
      out_ << YAML::Key << "values" << YAML::Value << YAML::BeginMap;
      for (std::size_t i = 0; i < use.values.size(); ++i) {
        const std::string si = model::parameter_unit(model_, *use.law, use.at, static_cast<int>(i));
        quantity(law.parameters[i].name.c_str(), use.values[i].value, si,
                 or_else(use.values[i].source, kGainSource));
      }
      out_ << YAML::EndMap << YAML::EndMap;
    }
    out_ << YAML::EndSeq << YAML::EndMap;
  }

  void write_controllers() {
    if (trial_.controllers.empty()) {
      return;
    }
    out_ << YAML::Key << "controllers" << YAML::Value << YAML::BeginSeq;
    for (const Controller& controller : trial_.controllers) {
      write_controller(controller);
    }
    out_ << YAML::EndSeq;
  }

  void write_controller(const Controller& c) {
    const std::string position = model::reading_unit(model_, c.sensor);
    const std::string command = command_unit(model_, c.motor);
    out_ << YAML::BeginMap;
    entry("kind", c.kind);
    entry("motor", c.motor);
    entry("sensor", c.sensor);
    out_ << YAML::Key << "reference" << YAML::Value;
    column("reference_" + c.motor, position, c.reference);
    quantity("position_gain", c.position_gain, "1/s", kGainSource);
    quantity("velocity_gain", c.velocity_gain, command + " s/" + position, kGainSource);
    if (c.disturbance.size() > 0) {
      out_ << YAML::Key << "disturbance" << YAML::Value;
      column("disturbance_" + c.motor, command, c.disturbance);
    }
    if (c.command_limit > 0.0) {
      quantity("command_limit", c.command_limit, command, "");
    }
    if (c.velocity_over != 1) {
      out_ << YAML::Key << "velocity_over" << YAML::Value << c.velocity_over;
    }
    out_ << YAML::EndMap;
  }

  void write_events() {
    if (trial_.events.empty()) {
      return;
    }
    out_ << YAML::Key << "events" << YAML::Value << YAML::Flow << YAML::BeginSeq;
    for (const double event : trial_.events) {
      out_ << number_text(event) + " s";
    }
    out_ << YAML::EndSeq;
  }

  const Trial& trial_;
  const model::Model& model_;
  fs::path folder_;
  Table table_;
  YAML::Emitter out_;
};

}  // namespace

void write_trial(const Trial& trial, const model::Model& model, const std::string& folder) {
  TrialWriter writer(trial, model, fs::absolute(folder).lexically_normal());
  const std::string yaml = writer.yaml();
  write_new_folder(folder, [&](const std::string& temporary) {
    write_csv(writer.table(), (fs::path(temporary) / "data.csv").string(), kFileDigits);
    write_text_atomically((fs::path(temporary) / "trial.yaml").string(), yaml);
  });
}

}  // namespace plumbline::validation
