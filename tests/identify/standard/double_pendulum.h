// Recordings of tests/robots/double_pendulum whose torques are derived by hand.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "simulator/effects/catalogue.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/predict/problem.h"

namespace plumbline::validation::pendulums {

constexpr double kGravity = 9.80665;
constexpr double kCount = 4e-4;  ///< rad
constexpr double kUpper = 0.2;   ///< m, from shoulder to elbow

/// Lagrange's equations of two links about parallel axes, angles phi_1 = q_1 and phi_2 = q_1 + q_2 from
/// hanging; what hangs at (x, z) of the lower link's frame has turned to (x cos phi_2 + z sin phi_2,
/// z cos phi_2 - x sin phi_2). With the lower link's first moments S about the elbow and d = q_2,
///   K = L (S_x sin d - S_z cos d),  Q_1 = A phi_1'' + K phi_2'' + K' phi_2'^2 + dV/dphi_1,
///   Q_2 = J phi_2'' + K phi_1'' - K' phi_1'^2 + dV/dphi_2,  tau_1 = Q_1 + Q_2,  tau_2 = Q_2.
struct Truth {
  double upper_mass = 0.5, lower_mass = 0.6;  ///< kg; inertias grow with them
  double payload = 0.0, x = 0.0, z = 0.0;     ///< kg, m: a point mass on the lower link
  double viscous = 0.0;                       ///< N m s/rad, at the elbow
  std::array<double, 2> coulomb{};            ///< N m, at shoulder and elbow
  std::array<double, 2> torque_noise{};       ///< N m, of the recorded torques, anew every 20 ms

  std::array<double, 2> torques(double q1, double q2, double v1, double v2, double a1, double a2) const {
    constexpr double kRotor = 2.2e-3;
    const double pivot =
        upper_mass / 0.5 * 0.011 + upper_mass * 0.2 * 0.2 + (lower_mass + payload) * kUpper * kUpper;
    const double J = lower_mass / 0.6 * 0.01 + lower_mass * 0.25 * 0.25 + payload * (x * x + z * z);
    const double Sx = payload * x;
    const double Sz = -lower_mass * 0.25 + payload * z;
    const double K = kUpper * (Sx * std::sin(q2) - Sz * std::cos(q2));
    const double slope = kUpper * (Sx * std::cos(q2) + Sz * std::sin(q2));
    const double phi2 = q1 + q2;
    const double w2 = v1 + v2;
    const double Q1 = pivot * a1 + K * (a1 + a2) + slope * w2 * w2 +
                      kGravity * (upper_mass * 0.2 + (lower_mass + payload) * kUpper) * std::sin(q1);
    const double Q2 =
        J * (a1 + a2) + K * a1 - slope * v1 * v1 - kGravity * (Sx * std::cos(phi2) + Sz * std::sin(phi2));
    const auto direction = [](double v) { return v > 0.0 ? 1.0 : -1.0; };
    return {Q1 + Q2 + kRotor * a1 + coulomb[0] * direction(v1),
            Q2 + kRotor * a2 + viscous * v2 + coulomb[1] * direction(v2)};
  }
};

/// q_i = a sin(w t + p) + b sin(u t + r), 6 s at 2 ms, read in counts of the model's encoders.
inline Trial trial(const Truth& truth, Role role) {
  constexpr int kSamples = 3000;
  const double shift = role == Role::train ? 0.0 : 1.3;
  Trial one;
  one.file = "motion/trial.yaml";
  one.name = role == Role::train ? "motion" : "other";
  one.role = role;
  one.period = 2e-3;
  one.time = Eigen::VectorXd::LinSpaced(kSamples, 0.0, (kSamples - 1) * one.period);
  std::array<Eigen::VectorXd, 2> q{Eigen::VectorXd(kSamples), Eigen::VectorXd(kSamples)};
  std::array<Eigen::VectorXd, 2> tau = q;
  const std::array<std::array<double, 6>, 2> waves{
      {{0.9, 4.1, shift, 0.5, 9.7, 0.4}, {0.7, 5.9, 1.1, 0.6, 12.3, 2.0 * shift}}};
  const auto state = [&](double t) {
    std::array<double, 6> x{};  // positions, velocities, accelerations
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& w = waves[i];
      const double slow = w[1] * t + w[2];
      const double fast = w[4] * t + w[5];
      x[i] = w[0] * std::sin(slow) + w[3] * std::sin(fast);
      x[i + 2] = w[0] * w[1] * std::cos(slow) + w[3] * w[4] * std::cos(fast);
      x[i + 4] = -w[0] * w[1] * w[1] * std::sin(slow) - w[3] * w[4] * w[4] * std::sin(fast);
    }
    return x;
  };
  constexpr int kHeld = 10;  // samples
  std::mt19937 random(role == Role::train ? 1 : 2);
  std::normal_distribution<double> normal;
  std::array<double, 2> noise{};
  for (int k = 0; k < kSamples; ++k) {
    if (k % kHeld == 0) {
      noise = {truth.torque_noise[0] * normal(random), truth.torque_noise[1] * normal(random)};
    }
    const std::array<double, 6> read = state(one.time[k]);
    const std::array<double, 6> x = state(one.time[k] + 0.5 * one.period);  // a command is held over a sample
    const std::array<double, 2> needed = truth.torques(x[0], x[1], x[2], x[3], x[4], x[5]);
    for (std::size_t i = 0; i < 2; ++i) {
      q[i][k] = kCount * std::round(read[i] / kCount);
      tau[i][k] = needed[i] + noise[i];
    }
  }
  one.measured = {{"shoulder", "q1", "rad", q[0]}, {"elbow", "q2", "rad", q[1]}};
  one.commands = {{"shoulder_motor", "t1", "N m", tau[0]}, {"elbow_motor", "t2", "N m", tau[1]}};
  return one;
}

inline Data data(const Truth& truth) {
  return {{trial(truth, Role::train), trial(truth, Role::held_out)}, PredictOptions{}};
}

inline model::Model stated() {
  return model::read_model(PLUMBLINE_ROOT "/tests/robots/double_pendulum/model.yaml",
                           effects::Catalogue::all());
}

inline void silent(const std::string& /*what*/, double /*share*/) {}

}  // namespace plumbline::validation::pendulums
