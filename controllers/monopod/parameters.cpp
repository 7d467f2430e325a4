#include "controllers/monopod/parameters.h"

namespace plumbline::monopod {

std::array<double*, kConstantCount> slots(Constants& c) {
  std::array<double*, kConstantCount> all{};
  std::size_t at = 0;
  for (Link* link : {&c.torso, &c.thigh, &c.shin}) {
    for (double* one : {&link->mass, &link->x, &link->z, &link->inertia}) {
      all[at++] = one;
    }
  }
  for (double* one :
       {&c.upper_length, &c.lower_length, &c.angle_ratio, &c.shape_ratio, &c.spring_ratio, &c.angle_inertia,
        &c.shape_inertia, &c.spring_inertia, &c.spring_stiffness, &c.spring_preload, &c.spring_damping,
        &c.angle_friction, &c.shape_friction, &c.gravity}) {
    all[at++] = one;
  }
  return all;
}

std::array<double*, kParameterCount> slots(Parameters& p) {
  std::array<double*, kParameterCount> all{};
  std::size_t at = 0;
  const auto add = [&](double& one) { all[at++] = &one; };
  for (double* one : slots(p.model)) {
    add(*one);
  }
  Gait& g = p.gait;
  for (Coefficients* curve : {&g.toe, &g.shape}) {
    for (double& one : *curve) {
      add(one);
    }
  }
  for (double* one : {&g.torso_start, &g.torso_2, &g.torso_3, &g.motor_middle, &g.theta_max,
                      &g.injection_span, &g.touchdown_height}) {
    add(*one);
  }
  for (int i = 0; i < 3; ++i) {
    add(g.beta[i]);
  }
  for (int i = 0; i < 8; ++i) {
    add(g.section[i]);
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 8; ++column) {
      add(g.gain(row, column));
    }
  }
  for (double* one :
       {&g.kp, &g.kv, &g.epsilon, &p.position_share, &p.rate_share, &p.angle_torque, &p.shape_torque}) {
    add(*one);
  }
  return all;
}

}  // namespace plumbline::monopod
