#include "tests/fuzz/reader_targets.h"

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "simulator/model/robot_reader.h"
#include "simulator/run/controller_setup.h"
#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "simulator/trace/units.h"
#include "tests/identify/trial/texts.h"
#include "tests/model/robot_texts.h"
#include "tests/model/test_laws.h"
#include "validation/control/published/published.h"
#include "validation/identify/predict/kept_results.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/twin/experiment.h"

namespace plumbline::test {
namespace {

constexpr double kHang = 5.0;  // s of processor time

constexpr const char* kResults = "plumbline: results/1 inputs\nab12 2 1.8p+0 -inf\ncd34 0\nef56 1 nan\n";

std::string put(const std::string& path, const std::string& text) {
  std::filesystem::remove(path);  // some file systems flush a file that is truncated and written again
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// Empty when `read` returned with credible results or threw one InputError line in time.
std::string verdict(const std::function<std::string()>& read) {
  const std::clock_t start = std::clock();
  std::string wrong;
  try {
    wrong = read();
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.find_first_of("\n\r") != std::string::npos || text.empty()) {
      wrong = "message is not one line: " + text;
    }
  } catch (const std::exception& error) {
    wrong = std::string("not an InputError: ") + error.what();
  } catch (...) {
    wrong = "an unknown exception";
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return seconds > kHang ? "took " + std::to_string(seconds) + " s" : wrong;
}

std::string incredible(const model::Skeleton& skeleton) {
  if (skeleton.bodies.empty() || skeleton.bodies.size() != skeleton.joints.size() ||
      !skeleton.gravity.allFinite()) {
    return "no tree";
  }
  for (std::size_t i = 0; i < skeleton.bodies.size(); ++i) {
    const model::Body& body = skeleton.bodies[i];
    const model::Joint& joint = skeleton.joints[i];
    if (!(body.mass >= 0.0) || !std::isfinite(body.mass) || !body.com.allFinite() ||
        !body.inertia.allFinite() || !(body.inertia.trace() >= 0.0)) {
      return "impossible body " + body.name;
    }
    if (joint.child != static_cast<int>(i) || joint.parent >= static_cast<int>(i) ||
        !joint.X_PJ.matrix().allFinite() || !joint.X_CJ.matrix().allFinite() ||
        std::abs(joint.axis.norm() - 1.0) > 1e-9) {
      return "impossible joint " + joint.name;
    }
  }
  return "";
}

std::string incredible(const model::Model& robot) {
  for (const model::Motor& motor : robot.motors) {
    if (!(motor.rotor_inertia.value > 0.0) || !(motor.torque_constant.value > 0.0) ||
        !std::isfinite(motor.torque_constant.value) || !(motor.rotor_inertia.uncertainty >= 0.0)) {
      return "impossible motor " + motor.name;
    }
  }
  for (const model::EffectUse& use : robot.effects) {
    robot.resolve(*use.law, use.at);
    for (const double value : use.numbers()) {
      if (std::isnan(value)) {
        return "no number in " + use.label();
      }
    }
  }
  return "";
}

std::string incredible(const Table& table) {
  for (const Column& column : table.columns) {
    if (column.values.size() != table.rows() || table.rows() < 1 || !column.values.allFinite()) {
      return "impossible column " + column.name;
    }
  }
  return table.columns.empty() ? "no columns" : "";
}

std::string incredible(const validation::Trial& trial) {
  if (!trial.time.allFinite() || trial.measured.empty()) {
    return "no samples";
  }
  for (const validation::Measured& channel : trial.measured) {
    if (channel.values.size() != trial.time.size() || !channel.values.allFinite()) {
      return "impossible channel " + channel.sensor;
    }
  }
  return "";
}

std::string incredible(const validation::Experiment& experiment) {
  for (const validation::Command& command : experiment.commands) {
    if (command.values.size() != experiment.time.size() || !command.values.allFinite()) {
      return "impossible command " + command.motor;
    }
  }
  return experiment.period > 0.0 ? "" : "impossible sample period";
}

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The bytes of a good MATLAB file.
std::string good_mat(const std::string& folder) {
  const Table table{
      "", {{"t", "s", Eigen::VectorXd::LinSpaced(20, 0.0, 1.9)}, {"u", "", Eigen::VectorXd::Ones(20)}}};
  write_mat(table, folder + "/good.mat");
  return file_text(folder + "/good.mat");
}

std::string check_unit(const std::string& text) {
  if (!unit_is_known(text)) {
    to_si_factor(text);  // must throw
    return "a factor of an unknown unit";
  }
  const double factor = to_si_factor(text);
  return std::isfinite(factor) && factor > 0.0 && units_agree(text, text) ? "" : "impossible factor";
}

}  // namespace

std::vector<ReaderTarget> reader_targets(const std::string& folder) {
  put(folder + "/arm.sdf", kSkeleton);
  put(folder + "/model.yaml", kModel);
  model::Skeleton skeleton = model::read_skeleton(folder + "/arm.sdf");
  const auto given = [skeleton = std::move(skeleton)](const std::string&) { return skeleton; };
  const model::Model robot = validation::small_robot();
  const auto catalogue = test_catalogue();
  // `read` gets the path of a file with the text, and says what is wrong with what it has read.
  const auto from_file = [folder](const std::string& name, auto read) {
    return [=](const std::string& text) {
      const std::string path = put(folder + "/" + name, text);
      return verdict([&] { return read(path); });
    };
  };
  const auto read_model = from_file("input.yaml", [=](const std::string& path) {
    return incredible(model::read_model(path, catalogue, given));
  });
  const auto read_skeleton = [](const std::string& path) { return incredible(model::read_skeleton(path)); };
  const auto read_table = [](const std::string& path) {
    const Table table = read_mat(path);
    for (const Column& column : table.columns) {
      require_finite(table, column.name);  // as a trial does with the columns that it uses
    }
    return incredible(table);
  };
  const auto read_trial = [=](const std::string& /*path*/) {
    put(folder + "/data.csv", validation::good_csv());
    return incredible(validation::read_trial(folder, robot));
  };
  const auto read_experiment = [=](const std::string& path) {
    return incredible(validation::read_experiment(path, robot));
  };
  const auto read_controller = [](const std::string& path) {
    run::read_controller(path);
    return std::string();
  };
  const auto read_published = [](const std::string& path) {
    return std::string(validation::read_published(path).gaits.empty() ? "no gaits" : "");
  };
  const auto read_results = [](const std::string& path) {
    const validation::KeptResults results(path, "inputs");
    return std::string();
  };
  return {
      {"model", {kModel, kPulleyModel}, read_model},
      {"overlay", {kOverlay}, read_model},
      {"csv",
       {kCsv},
       from_file("input.csv", [](const std::string& path) { return incredible(read_csv(path)); })},
      {"mat", {good_mat(folder)}, from_file("input.mat", read_table)},
      {"trial", {validation::good_trial()}, from_file("trial.yaml", read_trial)},
      {"experiment", {validation::good_experiment()}, from_file("experiment.yaml", read_experiment)},
      {"controller",
       {file_text(PLUMBLINE_ROOT "/robots/mabel/controllers/hopping.yaml")},
       from_file("controller.yaml", read_controller)},
      {"published",
       {file_text(PLUMBLINE_ROOT "/robots/mabel/published.yaml")},
       from_file("published.yaml", read_published)},
      {"results", {kResults}, from_file("results.txt", read_results)},
      {"unit",
       {"N m s/rad", "kg m^2", "deg", "1e-3 mN.m/A^2", "m/s^2"},
       [=](const std::string& text) {
         put(folder + "/input.unit", text);
         return verdict([&] { return check_unit(text); });
       }},
      {"sdf", {kSkeleton}, from_file("input.sdf", read_skeleton)},
      {"urdf", {kUrdf}, from_file("input.urdf", read_skeleton)},
  };
}

}  // namespace plumbline::test
