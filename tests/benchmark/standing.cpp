#include "tests/benchmark/standing.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "simulator/integrate/plant_ode.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"

namespace plumbline::benchmarks {
namespace {

constexpr double kSeconds = 1.0;
constexpr double kPeriod = 2e-3;       // s: of the PD law
constexpr double kP = 80.0, kD = 2.0;  // N m/rad, N m s/rad
constexpr double kDepth = 4e-3;        // m: of the lowest foot at the start, about where it carries

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<std::string> hinges(const model::Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const model::Joint& joint : skeleton.joints) {
    if (joint.type == model::JointType::revolute && !joint.floats) {
      names.push_back(joint.name);
    }
  }
  return names;
}

/// The skeleton with a motor at every hinge, on a ground that gives.
model::Model driven(const std::filesystem::path& folder, const model::Skeleton& skeleton) {
  std::ofstream file(folder / "standing.yaml");
  const std::string why = ", assumed: benchmark}";
  file << "plumbline: model/1\nrobot: r\nskeleton: robot.xml\nfeet: take\ncoordinates:\n";
  for (const std::string& name : hinges(skeleton)) {
    file << "  " << name << ": {of: {" << name << ": 1}}\n";
  }
  file << "motors:\n";
  for (const std::string& name : hinges(skeleton)) {
    file << "  m_" << name << ":\n    command_unit: N m\n    rotor_inertia: {value: 0.01, unit: kg m^2" << why
         << "\n    torque_constant: {value: 1, unit: '1'" << why << "\n";
  }
  file << "ratios:\n";
  for (const std::string& name : hinges(skeleton)) {
    file << "  " << name << ": {motor: m_" << name << ", ratio: {value: 1, unit: '1'" << why << "}\n";
  }
  file << "effects:\n  - effect: ground_normal\n    at: feet\n    values:\n"
          "      stiffness: {value: 1e4, unit: N"
       << why << "\n      damping: {value: 1.5e4, unit: N s/m" << why
       << "\n      exponent: {value: 1, unit: '1'" << why
       << "\n  - effect: ground_friction\n    at: feet\n    values:\n"
          "      bristle_stiffness: {value: 20000, unit: 1/m"
       << why << "\n      bristle_damping: {value: 10, unit: s/m" << why
       << "\n      friction: {value: 0.8, unit: '1'" << why << "\n";
  file.close();
  return model::read_model((folder / "standing.yaml").string(), model::known_effects());
}

struct Stand {
  Eigen::VectorXd angles;  ///< of the hinges, at every period's end, one after the other
  double seconds = 0.0;    ///< of processor time
};

Stand stand(model::Plant& plant, const Eigen::VectorXd& start, double tolerance) {
  integrate::PlantOde ode(plant, false, false);
  integrate::Options options;
  options.method = integrate::Method::rosenbrock;
  options.weight = integrate::Weight::reach;
  options.set_tolerance(tolerance);
  integrate::Integrator integrator(ode, options);
  const Eigen::Index n = plant.positions();
  const Eigen::Index hinges = n - 6;
  const auto periods = static_cast<Eigen::Index>(kSeconds / kPeriod + 0.5);
  Stand run;
  run.angles.resize(hinges * periods);
  integrator.start(0.0, start);
  const double begin = processor_time();
  for (Eigen::Index k = 0; k < periods; ++k) {
    const Eigen::VectorXd& x = integrator.state();
    for (Eigen::Index i = 0; i < hinges; ++i) {
      ode.command()[i] = kP * (start[6 + i] - x[6 + i]) - kD * x[n + 6 + i];
    }
    integrator.input_changed(true);
    integrator.advance(kPeriod * static_cast<double>(k + 1));
    run.angles.segment(k * hinges, hinges) = integrator.state().segment(6, hinges);
  }
  run.seconds = processor_time() - begin;
  return run;
}

/// Seconds of processor time.
double stand_in_mujoco(const test::Mujoco& mujoco, double step) {
  mjModel* m = mujoco.m;
  mjData* d = mujoco.d;
  const double before = m->opt.timestep;
  m->opt.timestep = step;
  mj_resetDataKeyframe(m, d, 0);
  const std::vector<double> home(m->key_qpos, m->key_qpos + m->nq);
  const double begin = processor_time();
  double next = 0.0;
  while (d->time < kSeconds) {
    if (d->time >= next - 1e-9) {
      next += kPeriod;
      for (int i = 6; i < m->nv; ++i) {
        d->qfrc_applied[i] = kP * (home[static_cast<std::size_t>(i) + 1] - d->qpos[i + 1]) - kD * d->qvel[i];
      }
    }
    mj_step(m, d);
  }
  const double taken = processor_time() - begin;
  m->opt.timestep = before;
  return taken;
}

}  // namespace

void time_standing(const std::filesystem::path& folder, const model::Skeleton& skeleton,
                   const test::Mujoco& mujoco) {
  model::Plant plant(driven(folder, skeleton), {});
  Eigen::VectorXd start = Eigen::VectorXd::Zero(plant.states());
  start[2] = 1.0;
  for (int i = 6; i < plant.positions(); ++i) {
    start[i] = mujoco.m->key_qpos[i + 1];
  }
  double lowest = 1.0;
  for (const model::Touch& touch : plant.touches(start.data())) {
    lowest = std::min(lowest, -touch.depth);
  }
  start[2] -= lowest + kDepth;
  const Stand exact = stand(plant, start, 1e-8);
  std::printf(
      "| one second of standing | times real time | largest difference of an angle, rad |\n| --- | --- | --- "
      "|\n");
  for (const double tolerance : {1e-4, 1e-6}) {
    const Stand run = stand(plant, start, tolerance);
    std::printf("| plant, %g | %.1f | %.1e |\n", tolerance, kSeconds / run.seconds,
                (run.angles - exact.angles).cwiseAbs().maxCoeff());
  }
  for (const double step : {mujoco.m->opt.timestep, 1e-4}) {
    std::printf("| MuJoCo, steps of %g s | %.1f | |\n", step, kSeconds / stand_in_mujoco(mujoco, step));
  }
}

}  // namespace plumbline::benchmarks
