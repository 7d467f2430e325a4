// What is known beforehand, where it hangs together.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <memory>

#include "validation/identify/predict/deviations.h"
#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {
namespace {

/// Of three values, one along its logarithm and one along its reciprocal.
std::vector<FreeParameter> three() {
  std::vector<FreeParameter> parameters(3);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i].label = "law@place:" + std::to_string(i);
    parameters[i].typical = 1.0;
    parameters[i].upper = 100.0;
  }
  parameters[1].scale = effects::Scale::logarithm;
  parameters[2].scale = effects::Scale::reciprocal;
  return parameters;
}

const Eigen::Vector3d kTheta(2.0, 0.5, 4.0);

Eigen::Matrix3d information() {
  Eigen::Matrix3d root;
  root << 3.0, 1.0, 0.4, 0.0, 2.0, -0.7, 0.0, 0.0, 1.5;
  return root.transpose() * root;
}

/// The values as identified from data with that information (in search units), as a model file would keep
/// them.
std::vector<FreeParameter> identified(const Eigen::Matrix3d& H) {
  std::vector<FreeParameter> parameters = three();
  const Eigen::VectorXd units = search_units(parameters, kTheta);
  const Eigen::VectorXd slopes = search_slopes(parameters, units, kTheta);
  const Eigen::Matrix3d covariance = H.inverse();
  const Eigen::Vector3d scale = covariance.diagonal().cwiseSqrt();
  Precision precision;
  precision.correlation = scale.cwiseInverse().asDiagonal() * covariance * scale.cwiseInverse().asDiagonal();
  const auto together =
      std::make_shared<const model::Correlations>(correlations_of(parameters, kTheta, precision));
  for (Eigen::Index i = 0; i < 3; ++i) {
    FreeParameter& parameter = parameters[static_cast<std::size_t>(i)];
    parameter.mean = kTheta[i];
    parameter.deviation = std::abs(slopes[i]) * scale[i];
    parameter.together = together;
  }
  return parameters;
}

// Bayes' theorem twice is Bayes' theorem once: what a first recording leaves, as the prior of a second one,
// counts as the first recording itself.
TEST(Prior, OfWhatWasIdentifiedIsTheInformationThatIdentifiedIt) {
  const std::vector<FreeParameter> parameters = identified(information());
  const Eigen::VectorXd units = search_units(parameters, kTheta);
  const Prior known = prior(parameters, units, kTheta);
  EXPECT_TRUE(known.H.isApprox(information(), 1e-9)) << known.H;
  EXPECT_EQ(known.square, 0.0);
  EXPECT_TRUE(known.g.isZero());
}

TEST(Prior, FallsAlongItsGradient) {
  const std::vector<FreeParameter> parameters = identified(information());
  const Eigen::Vector3d theta(2.3, 0.45, 4.4);
  const Eigen::VectorXd units = search_units(parameters, theta);
  const Prior known = prior(parameters, units, theta);
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d moved = theta + kStep * Eigen::Vector3d::Unit(i);
    const double slope = (prior(parameters, units, moved).square - known.square) / kStep;
    EXPECT_NEAR(slope * search_slopes(parameters, units, theta)[i], -2.0 * known.g[i], 1e-3 * known.g.norm());
  }
}

TEST(Prior, WhatNothingIsKnownOfHasNone) {
  std::vector<FreeParameter> parameters = identified(information());
  parameters[1].deviation = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd units = search_units(parameters, kTheta);
  const Prior known = prior(parameters, units, kTheta);
  EXPECT_TRUE(known.H.row(1).isZero());
  // The others as if it had been left open: the Schur complement.
  const Eigen::Matrix3d all = information();
  const double left = all(0, 0) - all(0, 1) * all(1, 0) / all(1, 1);
  EXPECT_NEAR(known.H(0, 0), left, 1e-9 * left);
}

TEST(Prior, WithoutCorrelationsEachStandsAlone) {
  std::vector<FreeParameter> parameters = identified(information());
  for (FreeParameter& parameter : parameters) {
    parameter.together.reset();
  }
  const Eigen::VectorXd units = search_units(parameters, kTheta);
  const Eigen::Vector3d scale = information().inverse().diagonal();
  EXPECT_TRUE(
      prior(parameters, units, kTheta).H.isApprox(Eigen::Matrix3d(scale.cwiseInverse().asDiagonal()), 1e-9));
}

// Where the bound takes a law's states out of the model a step stays inside; elsewhere it may end there.
TEST(Room, EndsBeforeABoundWhereStatesLeave) {
  std::vector<FreeParameter> parameters = three();
  const Eigen::VectorXd units = Eigen::Vector3d::Ones();
  const double whole = room(parameters, kTheta, units).lower[0];
  EXPECT_DOUBLE_EQ(kTheta[0] + whole, parameters[0].lower);
  parameters[0].leaves_at_bound = true;
  EXPECT_DOUBLE_EQ(room(parameters, kTheta, units).lower[0], 0.9 * whole);
  EXPECT_DOUBLE_EQ(room(parameters, kTheta, units).lower[2], room(three(), kTheta, units).lower[2]);
}

}  // namespace
}  // namespace plumbline::validation
