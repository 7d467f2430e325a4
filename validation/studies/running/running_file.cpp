#include "validation/studies/running/running_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "simulator/model/plain_number.h"
#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "simulator/run/controller_setup.h"
#include "simulator/trace/table.h"
#include "validation/studies/running/monopod_file.h"

namespace plumbline::validation {
namespace {

using namespace monopod;
using model::YamlNode;
using Sign = model::QuantityRule::Sign;

double number(const YamlNode& node, const char* unit, Sign sign = Sign::any) {
  return model::read_quantity(node, {unit, sign, false, {}}).value;
}

const char* unit_of(const std::string& constant) {
  for (const ParameterName& one : kParameters) {
    if (constant == one.name) {
      return one.unit;
    }
  }
  return "1";
}

/// {file, tolerance}: a CSV with time and one column.
WantedCurve read_curve(const YamlNode& node) {
  node.allow_keys({"file", "tolerance"});
  const Table table = read_csv(model::beside(node.file(), node.at("file").text()));
  if (table.columns.size() != 2 || table.columns[0].name != "time") {
    node.at("file").refuse("a table with the columns time [s] and one more");
  }
  WantedCurve curve;
  const auto copy = [](const Eigen::VectorXd& v) {
    return std::vector<double>(v.data(), v.data() + v.size());
  };
  curve.time = copy(table.columns[0].values);
  curve.value = copy(table.columns[1].values);
  curve.tolerance = number(node.at("tolerance"), table.columns[1].unit.c_str(), Sign::positive);
  return curve;
}

void read_list(const YamlNode& node, std::size_t count, const char* unit, double* to) {
  const std::vector<YamlNode> items = node.items();
  if (items.size() != count) {
    node.refuse(std::to_string(items.size()) + " numbers", std::to_string(count) + " numbers, " + unit);
  }
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = items[i].number();
  }
}

/// The leg's pose, rates and the velocity of a section from what a figure shows: leg shape, torso, how far
/// the centre of mass is ahead of the toe, and their rates.
Section read_section(const YamlNode& node, const Constants& c) {
  node.allow_keys({"shape", "pitch", "ahead", "shape_rate", "pitch_rate", "ahead_rate", "speed", "rise"});
  State state;
  state.q[kLegShape] = model::read_number(node.at("shape"), "rad");
  state.q[kMotor] = c.shape_ratio * state.q[kLegShape];
  state.q[kTorso] = model::read_number(node.at("pitch"), "rad");
  const double ahead = model::read_number(node.at("ahead"), "m");
  const auto by = [](const Dynamics& d, int k) { return d.com_jacobian(0, k) - d.toe_jacobian(0, k); };
  constexpr int kMost = 50;
  double off = 1.0;
  Dynamics d = dynamics(c, state);
  for (int i = 0; i < kMost && std::abs(off) > 1e-12; ++i) {
    d = dynamics(c, state);
    off = d.com[0] - d.toe[0] - ahead;
    state.q[kLegAngle] -= off / by(d, kLegAngle);
  }
  if (!(std::abs(off) < 1e-9)) {
    node.at("ahead").refuse("a distance that the leg can reach");
  }
  Section section;
  const double shape_rate = model::read_number(node.at("shape_rate"), "rad/s");
  const double torso_rate = model::read_number(node.at("pitch_rate"), "rad/s");
  const double rest = by(d, kLegShape) * shape_rate + by(d, kTorso) * torso_rate;
  section << state.q[kLegAngle], state.q[kLegShape], state.q[kTorso],
      (model::read_number(node.at("ahead_rate"), "m/s") - rest) / by(d, kLegAngle), shape_rate, torso_rate,
      model::read_number(node.at("speed"), "m/s"), model::read_number(node.at("rise"), "m/s");
  return section;
}

FreeConstant read_free(const std::string& name, const YamlNode& node, Constants& c) {
  node.allow_keys({"from", "to", "believed", "tolerance", "start"});
  const double* value = constant_by_name(c, name);
  if (value == nullptr) {
    throw InputError(node.place(), "no such constant", "a constant" + nearest_names(name, constant_names()));
  }
  const char* unit = unit_of(name);
  FreeConstant one;
  one.name = name;
  one.lower = model::read_number(node.at("from"), unit);
  one.upper = model::read_number(node.at("to"), unit);
  one.believed = number(node.at("believed"), unit);
  one.tolerance = number(node.at("tolerance"), unit, Sign::positive);
  const auto start = node.find("start");
  one.start = start ? model::read_number(*start, unit) : *value;
  if (!(one.lower < one.start && one.start < one.upper)) {
    node.refuse("a start of " + std::to_string(one.start) + " " + unit, "one between from and to");
  }
  return one;
}

void read_limits(const YamlNode& node, RunningDesign& d) {
  node.allow_keys({"friction", "angle_motor_torque", "shape_motor_torque", "toe_lift"});
  d.friction = number(node.at("friction"), "1", Sign::positive);
  d.torque[0] = number(node.at("angle_motor_torque"), "N m", Sign::positive);
  d.torque[1] = number(node.at("shape_motor_torque"), "N m", Sign::positive);
  d.lift = number(node.at("toe_lift"), "m/s", Sign::not_negative);
}

void read_wanted(const YamlNode& node, RunningDesign& d) {
  node.allow_keys({"pitch", "motor", "ahead", "shape", "stance", "flight", "compression",
                   "duration_tolerance", "liftoff_force", "force_tolerance"});
  d.torso = read_curve(node.at("pitch"));
  d.motor = read_curve(node.at("motor"));
  d.toe = read_curve(node.at("ahead"));
  d.shape = read_curve(node.at("shape"));
  d.stance = number(node.at("stance"), "s", Sign::positive);
  d.flight = number(node.at("flight"), "s", Sign::positive);
  d.compression = number(node.at("compression"), "s", Sign::positive);
  d.duration_tolerance = number(node.at("duration_tolerance"), "s", Sign::positive);
  d.force = number(node.at("liftoff_force"), "N", Sign::not_negative);
  d.force_tolerance = number(node.at("force_tolerance"), "N", Sign::positive);
  if (!(d.compression < d.stance)) {
    node.at("compression").refuse("a duration shorter than stance");
  }
}

void read_start(const YamlNode& node, RunningDesign& d) {
  node.allow_keys({"liftoff", "touchdown", "ahead", "shape", "pitch", "motor_middle", "theta_max"});
  d.liftoff = read_section(node.at("liftoff"), d.constants);
  d.touchdown = read_section(node.at("touchdown"), d.constants);
  Gait& gait = d.start;
  read_list(node.at("ahead"), 7, "m", gait.toe.data());
  read_list(node.at("shape"), 7, "rad", gait.shape.data());
  double torso[2];
  read_list(node.at("pitch"), 2, "rad", torso);
  gait.torso_2 = torso[0];
  gait.torso_3 = torso[1];
  gait.motor_middle = model::read_number(node.at("motor_middle"), "1");
  gait.theta_max = model::read_number(node.at("theta_max"), "rad");
  gait.beta << d.torso.value.back(), d.motor.value.back(), gait.toe[kOrder];
}

OuterLoopWeights read_weights(const YamlNode& node) {
  node.allow_keys({"angle", "rate", "speed", "pitch", "motor", "ahead"});
  OuterLoopWeights weights;
  weights.state.head<3>().setConstant(number(node.at("angle"), "rad", Sign::positive));
  weights.state.segment<3>(3).setConstant(number(node.at("rate"), "rad/s", Sign::positive));
  weights.state.tail<2>().setConstant(number(node.at("speed"), "m/s", Sign::positive));
  weights.parameter << number(node.at("pitch"), "rad", Sign::positive),
      number(node.at("motor"), "rad", Sign::positive), number(node.at("ahead"), "m", Sign::positive);
  return weights;
}

}  // namespace

RunningDesignFile read_running_design(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, "running_design/1");
  root.allow_keys(
      {"plumbline", "title", "monopod", "wanted", "limits", "gains", "free", "start", "outer_loop"});
  RunningDesignFile file;
  file.file = path;
  RunningDesign& d = file.design;
  const MonopodModel robot = read_monopod(model::beside(path, root.at("monopod").text()));
  d.constants = robot.constants;
  file.model_file = robot.names.model;
  read_wanted(root.at("wanted"), d);
  read_limits(root.at("limits"), d);
  const YamlNode gains = root.at("gains");
  gains.allow_keys({"kp", "kv", "epsilon"});
  d.start.kp = number(gains.at("kp"), "1/s^2", Sign::positive);
  d.start.kv = number(gains.at("kv"), "1/s", Sign::positive);
  d.start.epsilon = number(gains.at("epsilon"), "1", Sign::positive);
  d.damping = 1.0;  // of residuals' slopes of 1e2 and more: holds back what nothing tells
  d.steps = 32;
  for (const auto& [name, node] : root.at("free").entries()) {
    d.free.push_back(read_free(name, node, d.constants));
    *constant_by_name(d.constants, name) = d.free.back().start;
  }
  read_start(root.at("start"), d);
  file.weights = read_weights(root.at("outer_loop"));
  return file;
}

void write_running(const std::string& path, const std::string& base_file, const DesignedRunning& done,
                   const RunningDesignFile& file) {
  const auto name = [](const std::string& of) { return std::filesystem::path(of).filename().string(); };
  const std::string found = "found by plumbline running design from " + name(file.file);
  Parameters p;
  p.model = done.constants;
  p.gait = done.gait;
  const auto all = slots(p);
  constexpr std::size_t kOfTheBase = 4;            // shares of the filter and limits of the torques
  constexpr std::size_t kStated = kOfTheBase + 3;  // gains of equation 26
  YAML::Emitter out;
  out.SetDoublePrecision(15);
  model::begin_overlay(out, path, "controller/2", base_file, "robot, gait and gains " + found);
  out << YAML::Key << "constants" << YAML::Value << YAML::BeginMap;
  for (std::size_t i = 0; i + kOfTheBase < all.size(); ++i) {
    const bool free = std::any_of(file.design.free.begin(), file.design.free.end(),
                                  [&](const FreeConstant& one) { return one.name == kParameters[i].name; });
    const std::string origin = i < kConstantCount && !free ? "as in " + name(file.model_file)
                               : i + kStated >= all.size() ? "as in " + name(file.file)
                                                           : found;
    model::emit_quantity(out, kParameters[i].name, {*all[i], kParameters[i].unit, 0.0, "assumed", origin});
  }
  out << YAML::EndMap << YAML::EndMap;
  write_text_atomically(path, std::string(out.c_str()) + "\n");
}

Parameters read_running(const std::string& controller_file) {
  const run::ControllerSetup setup = run::read_controller(controller_file);
  const auto ports = setup.library.constants();
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if (i >= ports.size() || std::string(ports[i].name) != kParameters[i].name) {
      throw InputError(
          {controller_file, 0, "library"}, setup.library.api().name,
          std::string("a monopod's running controller, with the constant ") + kParameters[i].name);
    }
  }
  Parameters p;
  const auto all = slots(p);
  for (std::size_t i = 0; i < all.size(); ++i) {
    *all[i] = setup.constants[i];
  }
  return p;
}

}  // namespace plumbline::validation
