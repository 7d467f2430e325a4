#include "tests/benchmark/mujoco_drop.h"

#include <ctime>
#include <stdexcept>

#include "contact/contact_law.h"
#include "tests/benchmark/chain_xml.h"
#include "tests/benchmark/mujoco_model.h"

namespace plumbline::benchmarks {
namespace {

constexpr int kMostJoints = 8;

template <class Law>
struct Use {
  const Law* law = nullptr;
  effects::Values values;
};

/// What the callbacks work with: MuJoCo hands them its model and data only.
struct Ground {
  Use<contact::NormalLaw> normal;
  Use<contact::TangentialLaw> friction;
  int foot = 0;               // site
  double bristle_rate = 0.0;  // m/s, at the last evaluation
  long evaluations = 0;
};
Ground* ground = nullptr;

template <class Law>
Use<Law> only(const model::Model& model) {
  Use<Law> found;
  for (const model::EffectUse& use : model.effects) {
    if (const auto* law = dynamic_cast<const Law*>(use.law.get())) {
      if (found.law != nullptr) throw std::runtime_error(use.label() + ": expected one law of its kind");
      found = {law, use.numbers()};
    }
  }
  if (found.law == nullptr) throw std::runtime_error(model.file + ": expected a ground with friction");
  return found;
}

void press(const mjModel* m, mjData* d) {
  ++ground->evaluations;
  const double depth = -d->site_xpos[3 * ground->foot + 2];
  const double bristles[2] = {d->act[0], 0.0};
  double bristle_rates[2] = {0.0, 0.0};
  Eigen::Vector2d slip = Eigen::Vector2d::Zero();
  double normal = 0.0;
  if (depth > 0.0) {
    using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor, 3, kMostJoints>;
    Jacobian J(3, m->nv);
    mj_jacSite(m, d, J.data(), nullptr, ground->foot);
    const Eigen::Vector3d velocity = J * Eigen::Map<const Eigen::VectorXd>(d->qvel, m->nv);
    slip = velocity.head<2>();
    normal = ground->normal.law->force(depth, -velocity.z(), ground->normal.values.data());
    const Eigen::Vector2d drag =
        ground->friction.law->force(slip, normal, bristles, ground->friction.values.data());
    Eigen::Map<Eigen::VectorXd>(d->qfrc_passive, m->nv).noalias() +=
        J.transpose() * Eigen::Vector3d(drag.x(), drag.y(), normal);
  }
  ground->friction.law->state_rate(slip, normal, bristles, ground->friction.values.data(), bristle_rates);
  ground->bristle_rate = bristle_rates[0];
}

mjtNum bristle_rate(const mjModel* /*m*/, const mjData* /*d*/, int /*actuator*/) {
  return ground->bristle_rate;
}

void say_nothing(const char* /*warning*/) {}  // instead of a log file; the counts are read

bool grew_too_large(const mjData& data) {
  return data.warning[mjWARN_BADQPOS].number + data.warning[mjWARN_BADQVEL].number +
             data.warning[mjWARN_BADQACC].number >
         0;
}

int integrator(MujocoMethod method) {
  switch (method) {
    case MujocoMethod::runge_kutta:
      return mjINT_RK4;
    case MujocoMethod::implicit:
      return mjINT_IMPLICIT;
    case MujocoMethod::euler:
      break;
  }
  return mjINT_EULER;
}

}  // namespace

std::string to_string(MujocoMethod method) {
  switch (method) {
    case MujocoMethod::runge_kutta:
      return "MuJoCo RK4";
    case MujocoMethod::implicit:
      return "MuJoCo implicit";
    case MujocoMethod::euler:
      break;
  }
  return "MuJoCo Euler";
}

struct MujocoDrop::Impl {
  MujocoModel model;
  MujocoData data;
  Ground ground;

  void put(const Eigen::VectorXd& x) {
    const Eigen::Index n = model->nv;
    mj_resetData(model.get(), data.get());
    Eigen::Map<Eigen::VectorXd>(data->qpos, n) = x.head(n);
    Eigen::Map<Eigen::VectorXd>(data->qvel, n) = x.segment(n, n);
    data->act[0] = x[2 * n];
  }

  template <class State>
  void get(State state) const {
    const Eigen::Index n = model->nv;
    state.head(n) = Eigen::Map<const Eigen::VectorXd>(data->qpos, n);
    state.segment(n, n) = Eigen::Map<const Eigen::VectorXd>(data->qvel, n);
    state[2 * n] = data->act[0];
    state[2 * n + 1] = 0.0;
  }
};

MujocoDrop::MujocoDrop(const model::Model& model) : impl_(std::make_unique<Impl>()) {
  if (model.skeleton.joints.size() > kMostJoints) {
    throw std::runtime_error(model.file + ": expected at most " + std::to_string(kMostJoints) + " joints");
  }
  mju_user_warning = say_nothing;
  impl_->model = compile(chain_xml(model));
  impl_->data.reset(mj_makeData(impl_->model.get()));
  impl_->ground.normal = only<contact::NormalLaw>(model);
  impl_->ground.friction = only<contact::TangentialLaw>(model);
  impl_->ground.foot = mj_name2id(impl_->model.get(), mjOBJ_SITE, "foot");
  ground = &impl_->ground;
  mjcb_passive = press;
  mjcb_act_dyn = bristle_rate;
}

MujocoDrop::~MujocoDrop() {
  mjcb_passive = nullptr;
  mjcb_act_dyn = nullptr;
  ground = nullptr;
}

Eigen::VectorXd MujocoDrop::rate(const Eigen::VectorXd& x) {
  impl_->put(x);
  mj_forward(impl_->model.get(), impl_->data.get());
  const Eigen::Index n = impl_->model->nv;
  Eigen::VectorXd xdot = Eigen::VectorXd::Zero(x.size());
  xdot.head(n) = x.segment(n, n);
  xdot.segment(n, n) = Eigen::Map<const Eigen::VectorXd>(impl_->data->qacc, n);
  xdot[2 * n] = impl_->data->act_dot[0];
  return xdot;
}

Course MujocoDrop::simulate(const Replay& drop, MujocoMethod method, int steps_per_sample) {
  impl_->model->opt.integrator = integrator(method);
  impl_->model->opt.timestep = drop.period / steps_per_sample;
  impl_->put(drop.start);
  impl_->ground.evaluations = 0;
  Course course;
  course.states.resize(drop.start.size(), drop.commands.cols());
  const std::clock_t begin = std::clock();
  for (Eigen::Index k = 0; k < drop.commands.cols(); ++k) {
    for (int i = 0; i < steps_per_sample; ++i) {
      mj_step(impl_->model.get(), impl_->data.get());
    }
    impl_->get(course.states.col(k));
    if (grew_too_large(*impl_->data)) throw std::runtime_error("unstable");
  }
  course.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  course.summary.steps = steps_per_sample * static_cast<long>(drop.commands.cols());
  course.summary.rate_evaluations = impl_->ground.evaluations;
  return course;
}

}  // namespace plumbline::benchmarks
