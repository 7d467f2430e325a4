// Which rivals are one force under two names on a model.
#include "validation/identify/diagnose/same_force.h"

#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

/// Is `other` marked as the same force as `one`?
bool same(const model::Model& model, const Named& one, const Named& other) {
  Finding finding;
  finding.effect = one.effect;
  finding.at = one.at;
  finding.rivals = {{other, 1.0, false}};
  std::vector<Finding> findings{finding};
  mark_same_forces(model, effects::Catalogue::all(), findings);
  return findings.front().rivals.front().same;
}

TEST(SameForce, ABiasAtAMotorIsAPreloadBehindItsRigidRatio) {
  EXPECT_TRUE(same(bench(), {"torque_bias", "mLA"}, {"preload", "leg_angle"}));
  EXPECT_TRUE(same(bench(), {"preload", "leg_shape"}, {"torque_bias", "mLS"}));
  EXPECT_TRUE(same(bench(), {"viscous", "mLA"}, {"viscous", "leg_angle"}));
}

TEST(SameForce, WhatAnExperimentCanTellIsNot) {
  EXPECT_FALSE(same(bench(), {"torque_bias", "mLA"}, {"preload", "leg_shape"}));
  EXPECT_FALSE(same(bench(), {"torque_bias", "mLA"}, {"preload", "shin"}));
  EXPECT_FALSE(same(bench(), {"torque_bias", "mLA"}, {"gravity_tilt", "world"}));
  EXPECT_FALSE(same(bench(), {"viscous", "mLA"}, {"quadratic", "mLA"}));
  // The same but for what happens close to rest.
  EXPECT_FALSE(same(bench(), {"torque_bias", "mLA"}, {"coulomb_directional", "mLA"}));
}

TEST(SameForce, ACableThatStretchesParts) {
  model::Model cable = bench();
  cable.effects.push_back(
      parse_effect("cable_stretch@leg_angle:stiffness=100,damping=1", cable, effects::Catalogue::all()));
  EXPECT_FALSE(same(cable, {"torque_bias", "mLA"}, {"preload", "leg_angle"}));
}

TEST(SameForce, LawsThatMoveNothingAreNotCompared) {
  EXPECT_FALSE(same(bench(), {"encoder_offset", "mLA"}, {"encoder_offset", "knee"}));
  EXPECT_FALSE(same(bench(), {"no_such_law", "mLA"}, {"torque_bias", "mLA"}));
}

}  // namespace
}  // namespace plumbline::validation
