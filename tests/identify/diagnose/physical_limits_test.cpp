// What no fit may make of a robot.
#include "validation/identify/diagnose/physical_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/link_box.h"
#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/own_parameters.h"
#include "validation/identify/fit/free_parameters.h"

namespace plumbline::validation {
namespace {

model::EffectUse use_of(const std::string& law, const std::string& at, std::size_t values) {
  model::EffectUse use{effects::Catalogue::all().find(law), at, {}, 0};
  use.values.resize(values);
  return use;
}

// A cuboid of 2 a, 2 b, 2 c has the moments m (b^2 + c^2) / 3, ... about its middle.
TEST(PhysicalLimits, ALinkIsWhereItsInertiaAndItsJointsAre) {
  model::Skeleton skeleton;
  model::Body body;
  body.mass = 2.0;
  body.com = {0.1, 0.0, 0.0};
  const Eigen::Vector3d half(0.3, 0.05, 0.02);
  const Eigen::Vector3d squares = half.cwiseAbs2();
  body.inertia = (body.mass / 3.0 * (squares.sum() - squares.array())).matrix().asDiagonal();
  skeleton.bodies.push_back(body);
  model::Joint joint;
  joint.parent = -1;
  joint.X_CJ.translation() = Eigen::Vector3d(-0.25, 0.0, 0.0);
  skeleton.joints.push_back(joint);
  const Eigen::AlignedBox3d box = model::link_box(skeleton, 0);
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3d(-0.25, -0.05, -0.02), 1e-9)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3d(0.4, 0.05, 0.02), 1e-9)) << box.max().transpose();
}

TEST(PhysicalLimits, ACentreOfMassStaysInItsLink) {
  model::Model model = bench();
  model.effects.push_back(use_of("com_shift", "shin", 3));
  int limited = 0;
  for (const FreeParameter& one : free_parameters(model)) {
    if (one.label.rfind("com_shift", 0) == 0) {
      EXPECT_TRUE(one.physical) << one.label;
      EXPECT_LE(one.lower, 0.0) << one.label;
      EXPECT_GE(one.upper, 0.0) << one.label;
      EXPECT_LT(one.upper - one.lower, 2.0) << one.label << ": a shin is no longer than a metre";
      ++limited;
    }
  }
  EXPECT_EQ(limited, 3);
}

// A value that was identified replaces what was stated of it: the same number is not opened twice.
TEST(PhysicalLimits, AnIdentifiedNumberIsOpenOnce) {
  model::Model model = pendulum_drive();
  const auto masses = [](const model::Model& open) {
    int count = 0;
    for (const model::EffectUse& use : open.effects) {
      count += use.law->declaration().name == "added_mass" ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(masses(with_stated_errors(model)), 1);
  model.effects.push_back(use_of("added_mass", "arm", 1));
  model.effects.back().values.front().value = 0.01;
  EXPECT_EQ(masses(with_stated_errors(model)), 1);
}

}  // namespace
}  // namespace plumbline::validation
