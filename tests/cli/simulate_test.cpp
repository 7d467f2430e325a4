// `plumbline simulate`: the run of a twin again, in open and in closed loop.
#include <gmock/gmock.h>

#include <cmath>

#include "simulator/trace/table.h"
#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

class Simulate : public RobotFolder {
 protected:
  Table trace(const std::string& name) const { return read_table(folder + "/" + name); }

  /// The model with what is hidden in the trials.
  void add_the_truth() const {
    succeed({"add", "coulomb", "--at", "drive", "--model", "robot/model.yaml", "--set", "level=0.008",
             "--set", "smoothing_speed=0.5", "--out", "truth.yaml"});
  }

  /// A controller in the trial, with a reference that rises by 0.1 rad every half second.
  void control(const std::string& trial) const {
    Table data = trace("trials/" + trial + "/data.csv");
    Column reference{"r", "rad", Eigen::VectorXd(data.rows())};
    for (Eigen::Index k = 0; k < data.rows(); ++k) {
      reference.values[k] = 0.1 * std::floor(static_cast<double>(k) / 250.0);
    }
    data.columns.push_back(reference);
    write_csv(data, folder + "/trials/" + trial + "/data.csv", 15);
    write("trials/" + trial + "/trial.yaml",
          read("trials/" + trial + "/trial.yaml") +
              "\ncontrollers:\n"
              "  - kind: cascade_pd\n"
              "    motor: drive\n"
              "    sensor: shoulder\n"
              "    reference: {column: r}\n"
              "    position_gain: {value: 8, unit: 1/s, source: test}\n"
              "    velocity_gain: {value: 0.9, unit: A s/rad, source: test}\n"
              "    command_limit: {value: 0.6, unit: A, source: test}\n");
  }
};

const Eigen::VectorXd& column(const Table& table, const std::string& name) {
  const Column* found = table.find(name);
  if (found == nullptr) {
    ADD_FAILURE() << "no column " << name;
    static const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
    return none;
  }
  return found->values;
}

TEST_F(Simulate, TheTruthRepeatsTheRecordingToWithinTheEncoder) {
  add_the_truth();
  succeed({"simulate", "trials/steps", "--model", "truth.yaml", "--out", "trace.csv", "--json", "s.json"});
  const Table measured = trace("trials/steps/data.csv");
  const Table simulated = trace("trace.csv");
  constexpr double counts = 6.283185307179586 / 4096;
  EXPECT_LT((column(measured, "q_drive") - column(simulated, "q_drive")).cwiseAbs().maxCoeff(), 0.6 * counts);
  EXPECT_EQ(column(measured, "u_drive"), column(simulated, "u_drive"));
  const nlohmann::json json = read_json("s.json");
  EXPECT_NEAR(json["channels"][0]["rms"].get<double>(), json["channels"][0]["floor"].get<double>(),
              0.2 * json["channels"][0]["floor"].get<double>());
  EXPECT_LT(std::abs(json["energy"]["relative_error"].get<double>()), 1e-6);
  EXPECT_GT(json["summary"]["steps"].get<int>(), 900);
}

TEST_F(Simulate, WithoutTheHiddenEffectItDriftsAway) {
  succeed({"simulate", "trials/steps", "--json", "s.json"});
  const nlohmann::json json = read_json("s.json");
  EXPECT_GT(json["channels"][0]["rms"].get<double>(), 100.0 * json["channels"][0]["floor"].get<double>());
}

TEST_F(Simulate, TraceHoldsEveryCoordinateWithItsUnit) {
  succeed({"simulate", "trials/steps", "--out", "trace.csv"});
  const Table simulated = trace("trace.csv");
  std::vector<std::string> head;
  for (const Column& one : simulated.columns) {
    head.push_back(one.name + " [" + one.unit + "]");
  }
  EXPECT_THAT(head, testing::ElementsAre("t [s]", "q_drive [rad]", "q_shoulder [rad]", "u_drive [A]",
                                         "x_shoulder [rad]", "v_shoulder [rad/s]", "x_drive [rad]",
                                         "v_drive [rad/s]"));
  EXPECT_NEAR((column(simulated, "x_drive") - 50.0 * column(simulated, "x_shoulder")).cwiseAbs().maxCoeff(),
              0.0,
              1e-8);  // the gearbox
  EXPECT_LT((column(simulated, "q_drive") - column(simulated, "x_drive")).cwiseAbs().maxCoeff(), 1e-8);
}

TEST_F(Simulate, MatHoldsWhatCsvHolds) {
  succeed({"simulate", "trials/steps", "--out", "trace.csv"});
  succeed({"simulate", "trials/steps", "--out", "trace.mat"});
  const Table csv = trace("trace.csv");
  const Table mat = trace("trace.mat");
  for (const char* name : {"t", "q_drive", "u_drive", "v_shoulder"}) {
    EXPECT_LT((column(csv, name) - column(mat, name)).cwiseAbs().maxCoeff(), 1e-7) << name;
  }
}

TEST_F(Simulate, MethodsAgree) {
  for (const char* method : {"explicit_rk", "implicit_rk", "bdf"}) {
    succeed({"simulate", "trials/steps", "--method", method, "--tolerance", "1e-9", "--out",
             std::string(method) + ".csv"});
  }
  const Table reference = trace("explicit_rk.csv");
  for (const char* method : {"implicit_rk", "bdf"}) {
    const Table other = trace(std::string(method) + ".csv");
    EXPECT_LT((column(reference, "x_shoulder") - column(other, "x_shoulder")).cwiseAbs().maxCoeff(), 1e-5)
        << method;
  }
}

TEST_F(Simulate, ExperimentStartsAtRestWhereItSays) {
  replace("experiments/swing.yaml", "shoulder: {value: 0, unit: deg}", "shoulder: {value: 90, unit: deg}");
  succeed({"simulate", "--experiment", "experiments/swing.yaml", "--model", "robot/model.yaml", "--out",
           "trace.csv"});
  const Table simulated = trace("trace.csv");
  EXPECT_NEAR(column(simulated, "x_shoulder")[0], 1.5707963267948966, 1e-9);
  EXPECT_EQ(column(simulated, "v_shoulder")[0], 0.0);
  EXPECT_EQ(simulated.rows(), 1000);
}

/// The leg on the bench, whose second motor is locked in this experiment.
class SimulateLeg : public RobotFolder {
 protected:
  const std::string leg = std::string(PLUMBLINE_ROOT) + "/robots/mabel/leg_bench.yaml";
  const std::string experiment = std::string(PLUMBLINE_ROOT) + "/robots/mabel/experiments/siso_mLA.yaml";
};

TEST_F(SimulateLeg, EnergyBalancesWithAStretchedCable) {
  succeed({"add", "cable_stretch", "--at", "leg_angle", "--set", "stiffness=3.5", "--set", "damping=0.09",
           "--model", leg, "--out", "leg.yaml"});
  succeed({"simulate", "--experiment", experiment, "--model", "leg.yaml", "--json", "s.json"});
  const nlohmann::json energy = read_json("s.json")["energy"];
  EXPECT_GT(energy["exchanged"].get<double>(), 1.0);
  EXPECT_LT(std::abs(energy["relative_error"].get<double>()), 1e-6);
}

TEST_F(SimulateLeg, ALockedMotorStaysWhereItIs) {
  succeed({"twin", "--model", leg, "--experiment", experiment, "--out", "leg"});
  succeed({"check", "leg/siso_mLA", "--json", "c.json"});
  const nlohmann::json checked = read_json("c.json");
  EXPECT_EQ(checked["independent_coordinates"], 1);
  ASSERT_EQ(checked["locked"].size(), 1U);
  EXPECT_EQ(checked["locked"][0]["at"], "mLS");
  // 20 degrees of leg shape times the ratio of 31.42
  EXPECT_NEAR(checked["locked"][0]["value"].get<double>(), 20.0 * 3.141592653589793 / 180.0 * 31.42, 1e-6);
  succeed({"simulate", "leg/siso_mLA", "--out", "trace.csv"});
  const Table simulated = read_table(folder + "/trace.csv");
  const Eigen::VectorXd& motor = column(simulated, "x_mLS");
  EXPECT_LT(motor.maxCoeff() - motor.minCoeff(), 1e-9);
  EXPECT_LT(column(simulated, "v_mLS").cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Simulate, ClosedLoopCommandsAreTheControllersOwn) {
  control("steps");
  succeed({"simulate", "trials/steps", "--closed-loop", "--out", "loop.csv"});
  const Table loop = trace("loop.csv");
  const Table data = trace("trials/steps/data.csv");
  // u = kv (kp (r - y) - v), v = (y_k - y_(k-1)) / T, at most 0.6 A; y in whole counts of the encoder.
  constexpr double resolution = 6.283185307179586 / 16384;
  const Eigen::VectorXd y = resolution * (column(loop, "q_shoulder") / resolution).array().round().matrix();
  double largest = 0.0;
  int cut = 0;
  for (Eigen::Index k = 1; k < y.size(); ++k) {
    const double wanted = 0.9 * (8.0 * (column(data, "r")[k] - y[k]) - (y[k] - y[k - 1]) / 0.002);
    const double expected = std::min(std::max(wanted, -0.6), 0.6);
    cut += expected != wanted ? 1 : 0;
    largest = std::max(largest, std::abs(column(loop, "u_drive")[k] - expected));
  }
  EXPECT_LT(largest, 1e-6);
  EXPECT_GT(cut, 0) << "the limit was never reached";
  EXPECT_GT((column(loop, "u_drive") - column(data, "u_drive")).cwiseAbs().maxCoeff(), 0.1);
  // and it does what it is for: near the last level of the reference, though gravity pulls
  EXPECT_NEAR(y[y.size() - 1], 0.3, 0.15);
}

}  // namespace
}  // namespace plumbline::test
