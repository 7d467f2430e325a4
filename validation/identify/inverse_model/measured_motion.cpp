#include "validation/identify/inverse_model/measured_motion.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "simulator/integrate/command_clock.h"
#include "simulator/model/asked_torque.h"
#include "simulator/sensing/low_pass.h"

namespace plumbline::validation::measured {
namespace {

constexpr double kHighestShare = 0.4;  // of the sample rate

}  // namespace

double bounded(double cutoff, double period) { return std::min(cutoff, kHighestShare / period); }

Eigen::MatrixXd positions(model::Plant& plant, const Trial& trial, double cutoff) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(plant.states());
  Eigen::VectorXd offset(plant.sensors());
  Eigen::MatrixXd slope;
  plant.outputs(zero.data(), offset.data());
  plant.output_jacobian(zero.data(), slope);
  const auto channels = static_cast<Eigen::Index>(trial.measured.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(channels, plant.positions());
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(channels, trial.samples());
  for (Eigen::Index c = 0; c < channels; ++c) {
    const Measured& measured = trial.measured[static_cast<std::size_t>(c)];
    for (Eigen::Index s = 0; s < plant.sensors(); ++s) {
      const model::Sensor& sensor = plant.model().sensors[static_cast<std::size_t>(s)];
      if (sensor.name == measured.sensor && !sensor.is_at_point()) {
        const double floor = sensor.floor() > 0.0 ? sensor.floor() : 1.0;
        C.row(c) = slope.row(s).head(plant.positions()) / floor;
        y.row(c) = (sensing::low_pass(measured.values, trial.period, bounded(cutoff, trial.period))
                        .transpose()
                        .array() -
                    offset[s]) /
                   floor;
      }
    }
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(C);
  return qr.rank() == C.cols() ? Eigen::MatrixXd(qr.solve(y)) : Eigen::MatrixXd();
}

Motion differentiated(Eigen::MatrixXd z, double period) {
  const Eigen::Index n = z.cols() - 2;
  Motion motion{std::move(z), {}, {}};
  motion.v = Eigen::MatrixXd::Zero(motion.z.rows(), n + 2);
  motion.a = motion.v;
  motion.v.middleCols(1, n) = (motion.z.rightCols(n) - motion.z.leftCols(n)) / (2.0 * period);
  motion.a.middleCols(1, n) =
      (motion.z.rightCols(n) - 2.0 * motion.z.middleCols(1, n) + motion.z.leftCols(n)) / (period * period);
  for (Eigen::MatrixXd* rows : {&motion.v, &motion.a}) {
    rows->col(0) = rows->col(1);
    rows->col(n + 1) = rows->col(n);
  }
  return motion;
}

model::Model without_limits(model::Model model) {
  for (model::Motor& motor : model.motors) {
    motor.torque_limit.value = 0.0;
  }
  return model;
}

Eigen::MatrixXd arrived_commands(const model::Plant& plant, const Trial& trial) {
  const Eigen::MatrixXd sent =
      integrate::on_clock_of_measurements(command_samples(plant.model(), trial.commands, trial.samples()),
                                          trial.period, integrate::command_clocks(plant));
  const Eigen::VectorXd before = commands_before(plant.model(), trial.commands);
  Eigen::MatrixXd u = sent;
  for (int m = 0; m < plant.motors(); ++m) {
    const auto late = static_cast<Eigen::Index>(std::lround(plant.delay(m) / trial.period));
    for (Eigen::Index k = 0; k < trial.samples(); ++k) {
      u(m, k) = model::asked_torque(plant.model(), m, k < late ? before[m] : sent(m, k - late)) /
                plant.torque_gain(m);
    }
  }
  return u;
}

Eigen::MatrixXd motor_map(const model::Plant& plant) {
  Eigen::MatrixXd map(plant.motors(), plant.positions());
  for (int i = 0; i < plant.positions(); ++i) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x[plant.positions() + i] = 1.0;
    for (int m = 0; m < plant.motors(); ++m) {
      map(m, i) = plant.velocity_of(plant.model().motors[static_cast<std::size_t>(m)].name, x.data());
    }
  }
  return map;
}

std::vector<int> moving_motors(const Eigen::MatrixXd& map) {
  std::vector<int> moving;
  for (Eigen::Index m = 0; m < map.rows(); ++m) {
    if (map.row(m).cwiseAbs().maxCoeff() > 1e-9) {
      moving.push_back(static_cast<int>(m));
    }
  }
  return moving;
}

std::string no_inverse(const model::Plant& plant, const std::vector<int>& moving, const Trial& trial) {
  if (plant.states() > 2 * plant.positions()) {
    return "the model has hidden states, which the measured positions do not show";
  }
  if (plant.has_loops()) {
    return "the model has closed loops, whose forces no sensor shows";
  }
  if (static_cast<int>(moving.size()) != plant.positions()) {
    return std::to_string(plant.positions()) + " independent positions but " + std::to_string(moving.size()) +
           (moving.size() == 1 ? " motor" : " motors") + " that can move";
  }
  for (const int m : moving) {
    if (m >= plant.motors()) {
      continue;  // a joint without a motor needs none
    }
    const std::string& name = plant.model().motors[static_cast<std::size_t>(m)].name;
    if (std::none_of(trial.commands.begin(), trial.commands.end(),
                     [&](const Command& command) { return command.motor == name; })) {
      return "the command of motor " + name + " was not recorded";
    }
  }
  return "";
}

}  // namespace plumbline::validation::measured
