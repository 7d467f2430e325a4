// A stretched body against the same stretch of the points that it consists of.
#include "simulator/effects/link_inertia.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "simulator/model/body_change.h"

namespace plumbline::model {
namespace {

struct Point {
  double mass;
  Eigen::Vector3d at;  ///< from the centre of mass
};

/// Four points in no plane, with their common centre at nought.
std::array<Point, 4> points() {
  std::array<Point, 4> all{
      {{0.4, {0.1, 0.02, -0.05}}, {0.7, {-0.06, 0.08, 0.01}}, {0.5, {0.02, -0.09, 0.07}}, {}}};
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Point& one : all) {
    moment += one.mass * one.at;
  }
  all[3] = {0.3, -moment / 0.3};
  return all;
}

Eigen::Matrix3d inertia_of(const std::array<Point, 4>& all, const Eigen::Matrix3d& map) {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const Point& one : all) {
    const Eigen::Vector3d r = map * one.at;
    inertia += one.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return inertia;
}

Body body() {
  Body link;
  link.name = "link";
  link.mass = 1.9;
  link.com = {0.3, -0.1, 0.2};
  link.inertia = inertia_of(points(), Eigen::Matrix3d::Identity());
  return link;
}

TEST(LinkInertia, StretchesTheMatterOfTheBodyAboutItsCentreOfMass) {
  const std::array<double, 6> values{0.3, -0.2, 0.15, 0.4, -0.25, 0.1};
  const effects::StructureChange change = effects::LinkInertia().change(values.data());
  Eigen::Matrix3d map;
  map << std::exp(0.3), 0, 0, 0.4, std::exp(-0.2), 0, -0.25, 0.1, std::exp(0.15);
  Body changed = body();
  change_body(changed, change, "link");
  EXPECT_LT((changed.inertia - inertia_of(points(), map)).norm(), 1e-15);
  EXPECT_EQ(changed.mass, body().mass);
  EXPECT_EQ(changed.com, body().com);
}

TEST(LinkInertia, LeavesATensorThatABodyCanHave) {
  const std::array<double, 6> values{-3.0, 2.0, 1.0, 5.0, -4.0, 3.0};
  Body changed = body();
  change_body(changed, effects::LinkInertia().change(values.data()), "link");
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(changed.inertia).eigenvalues();
  EXPECT_GT(principal[0], 0.0);
  EXPECT_LE(principal[2], (1.0 + 1e-12) * (principal[0] + principal[1]));
}

TEST(LinkInertia, AtNullChangesNothing) {
  Body changed = body();
  change_body(changed, effects::LinkInertia().change(effects::LinkInertia().null_values().data()), "link");
  EXPECT_EQ(changed.inertia, body().inertia);
}

}  // namespace
}  // namespace plumbline::model
