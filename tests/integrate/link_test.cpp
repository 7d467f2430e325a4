// SUNDIALS and Simbody in one program: each must find its own copy of SUNDIALS.
#include <SimTKmath.h>
#include <gtest/gtest.h>

#include "tests/integrate/problems.h"

namespace plumbline::integrate {
namespace {

/// x' = -x for SimTK's CPodes integrator, which carries an old SUNDIALS.
class Decay : public SimTK::System {
 public:
  class Guts : public SimTK::System::Guts {
    Guts* cloneImpl() const override { return new Guts(*this); }
    int realizeTopologyImpl(SimTK::State& state) const override {
      state.allocateZ(SimTK::SubsystemIndex(0), SimTK::Vector(1, 1.0));
      return 0;
    }
    int realizeAccelerationImpl(const SimTK::State& state) const override {
      state.updZDot()[0] = -state.getZ()[0];
      return 0;
    }
  };
  Decay() {
    adoptSystemGuts(new Guts);
    SimTK::DefaultSystemSubsystem subsystem(*this);
  }
};

TEST(Link, BothFindTheirOwnSundials) {
  const Decay decay;
  const SimTK::State& initial = decay.realizeTopology();
  SimTK::CPodesIntegrator cpodes(decay);
  cpodes.setAccuracy(1e-8);
  cpodes.initialize(initial);
  while (cpodes.getTime() < 1.0) cpodes.stepTo(1.0);
  EXPECT_NEAR(cpodes.getState().getZ()[0], std::exp(-1.0), 1e-6);

  for (const Method method : {Method::bdf, Method::implicit_rk, Method::explicit_rk}) {
    DrivenOscillator system(60.0, 0.1);
    Integrator integrator(system, with(method, 1e-9));
    integrator.start(0.0, Eigen::Vector2d(1.0, 0.0));
    integrator.advance(0.1);
    EXPECT_NEAR(integrator.state()[0], system.exact({1.0, 0.0}, 0.1)[0], 1e-6) << to_string(method);
  }
}

}  // namespace
}  // namespace plumbline::integrate
