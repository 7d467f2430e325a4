#include "tests/benchmark/simbody_peer.h"

#include <Simbody.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <stdexcept>

namespace plumbline::benchmarks {
namespace {

/// Carries the plant's states as auxiliary variables of the force subsystem.
class PlantRates : public SimTK::Force::Custom::Implementation {
 public:
  PlantRates(const SimTK::GeneralForceSubsystem& forces, model::Plant& plant, const Eigen::VectorXd& start)
      : forces_(forces), plant_(plant), start_(start), command_(Eigen::VectorXd::Zero(plant.motors())) {}

  void calcForce(const SimTK::State& /*state*/, SimTK::Vector_<SimTK::SpatialVec>& /*body*/,
                 SimTK::Vector_<SimTK::Vec3>& /*particle*/, SimTK::Vector& /*mobility*/) const override {}
  SimTK::Real calcPotentialEnergy(const SimTK::State& /*state*/) const override { return 0.0; }
  void realizeTopology(SimTK::State& state) const override {
    SimTK::Vector z(static_cast<int>(start_.size()));
    std::copy(start_.data(), start_.data() + start_.size(), &z[0]);
    forces_.allocateZ(state, z);
  }
  void realizeAcceleration(const SimTK::State& state) const override {
    ++evaluations_;
    plant_.rate(&forces_.getZ(state)[0], command_.data(), &forces_.updZDot(state)[0]);
  }

  void hold(const Eigen::VectorXd& command) { command_ = command; }
  long evaluations() const { return evaluations_; }

 private:
  const SimTK::GeneralForceSubsystem& forces_;
  model::Plant& plant_;
  Eigen::VectorXd start_, command_;
  mutable long evaluations_ = 0;
};

std::unique_ptr<SimTK::Integrator> make(Peer peer, const SimTK::System& system) {
  if (peer == Peer::runge_kutta_merson) {
    return std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system);
  }
  return std::make_unique<SimTK::CPodesIntegrator>(system, SimTK::CPodes::BDF, SimTK::CPodes::Newton);
}

}  // namespace

std::string to_string(Peer peer) {
  return peer == Peer::runge_kutta_merson ? "Simbody RKM" : "Simbody CPodes";
}

Course simulate(const Replay& hop, model::Plant& plant, Peer peer, double accuracy, const Course& reference,
                double patience) {
  SimTK::MultibodySystem system;
  const SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  auto* rates = new PlantRates(forces, plant, hop.start);  // Simbody deletes it
  const SimTK::Force::Custom force(forces, rates);
  SimTK::State state = system.realizeTopology();
  system.realizeModel(state);
  SimTK::Vector& weights = state.updZWeights(forces.getMySubsystemIndex());
  for (int i = 0; i < weights.size(); ++i) {
    weights[i] = 1.0 / std::max(1e-2, reference.states.row(i).cwiseAbs().maxCoeff());
  }
  const std::unique_ptr<SimTK::Integrator> integrator = make(peer, system);
  integrator->setAccuracy(accuracy);
  integrator->initialize(state);
  Course course;
  course.states.resize(plant.states(), hop.commands.cols());
  const std::clock_t begin = std::clock();
  const auto spent = [begin]() { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
  for (Eigen::Index k = 0; k < hop.commands.cols(); ++k) {
    rates->hold(hop.commands.col(k));
    integrator->updAdvancedState().invalidateAllCacheAtOrAbove(SimTK::Stage::Acceleration);
    integrator->reinitialize(SimTK::Stage::Dynamics, false);
    const double end = hop.period * static_cast<double>(k + 1);
    while (integrator->getTime() < end) {
      integrator->stepTo(end, end);
      if (spent() > patience) {
        throw std::runtime_error("given up after " + std::to_string(patience) + " s");
      }
    }
    const SimTK::Vector& z = forces.getZ(integrator->getState());
    course.states.col(k) = Eigen::Map<const Eigen::VectorXd>(&z[0], z.size());
  }
  course.seconds = spent();
  course.summary.steps = integrator->getNumStepsTaken();
  course.summary.error_test_failures = integrator->getNumErrorTestFailures();
  course.summary.rate_evaluations = rates->evaluations();
  return course;
}

}  // namespace plumbline::benchmarks
