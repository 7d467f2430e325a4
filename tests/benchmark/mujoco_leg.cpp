#include "tests/benchmark/mujoco_leg.h"

#include <sstream>
#include <string>

#include "tests/benchmark/mujoco_model.h"
#include "tests/oracles/leg_bench_lagrangian.h"

namespace plumbline::benchmarks {
namespace {

/// <inertial> of a link that hangs at zero.
std::string inertial(const oracles::PendulumLink& link) {
  const double r2 = link.along * link.along + link.across * link.across;
  const double about_com = link.inertia - link.mass * r2;
  std::ostringstream text;
  text.precision(17);
  text << "<inertial pos='" << link.across << " 0 " << -link.along << "' mass='" << link.mass
       << "' diaginertia='" << about_com << ' ' << about_com << ' ' << 0.1 * about_com << "'/>";
  return text.str();
}

std::string model_xml() {
  const oracles::LegBenchConstants leg = oracles::mabel_left_leg();
  // Half the ratio: the motor turns by the leg shape, minus half the knee angle.
  const double ratio = 0.5 * leg.leg_shape.ratio;
  const double armature = leg.leg_shape.inertia * ratio * ratio + leg.cspring.inertia;
  std::ostringstream text;
  text.precision(17);
  text << "<mujoco><compiler angle='radian' balanceinertia='false' boundmass='0' inertiafromgeom='false'/>"
       << "<option gravity='0 0 " << -leg.gravity
       << "'><flag contact='disable' constraint='disable'/></option>"
       << "<worldbody><body name='thigh'><joint name='hip' type='hinge' axis='0 -1 0'/>"
       << inertial(leg.thigh) << "<body name='shin' pos='0 0 " << -leg.thigh_length
       << "'><joint name='knee' type='hinge' axis='0 -1 0' armature='" << armature << "'/>"
       << inertial(leg.shin) << "</body></body></worldbody></mujoco>";
  return text.str();
}

}  // namespace

struct MujocoLeg::Impl {
  MujocoModel model;
  MujocoData data;
};

MujocoLeg::MujocoLeg() : impl_(std::make_unique<Impl>()) {
  impl_->model = compile(model_xml());
  impl_->data.reset(mj_makeData(impl_->model.get()));
}

MujocoLeg::~MujocoLeg() = default;

Eigen::Vector2d MujocoLeg::accelerations(const Eigen::Vector2d& q, const Eigen::Vector2d& v,
                                         const Eigen::Vector2d& torques) {
  mjData& data = *impl_->data;
  for (int i = 0; i < 2; ++i) {
    data.qpos[i] = q[i];
    data.qvel[i] = v[i];
    data.qfrc_applied[i] = torques[i];
  }
  mj_forward(impl_->model.get(), &data);
  return {data.qacc[0], data.qacc[1]};
}

}  // namespace plumbline::benchmarks
