// Linkages for the tests of closed loops, as skeletons from numbers.
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <string>

#include "simulator/model/model.h"

namespace plumbline::test {

inline Eigen::Isometry3d at(const Eigen::Vector3d& p, const Eigen::Vector3d& turn = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = p;
  X.linear() = (Eigen::AngleAxisd(turn.z(), Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(turn.y(), Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(turn.x(), Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return X;
}

inline model::Body bar(const std::string& name, double mass, const Eigen::Vector3d& com, double inertia) {
  model::Body body;
  body.name = name;
  body.mass = mass;
  body.com = com;
  body.inertia = inertia * Eigen::Vector3d(1.0, 1.3, 0.7).asDiagonal();
  return body;
}

/// Hangs a link on another (-1: the world) by a hinge, or a slide along z.
inline int hang(model::Model& model, const model::Body& body, int parent, const Eigen::Isometry3d& X_PJ,
                const Eigen::Vector3d& axis, model::JointType type = model::JointType::revolute) {
  model::Joint joint;
  joint.name = "j_" + body.name;
  joint.type = type;
  joint.parent = parent;
  joint.child = static_cast<int>(model.skeleton.bodies.size());
  joint.axis = axis;
  joint.X_PJ = X_PJ;
  model.skeleton.bodies.push_back(body);
  model.skeleton.joints.push_back(joint);
  model.coordinates.push_back(
      {joint.name, type == model::JointType::revolute, {model::Term{joint.name, 1.0}}});
  return joint.child;
}

inline model::Loop loop(model::Loop::Type type, const model::LoopEnd& first, const model::LoopEnd& second,
                        double length = 0.0) {
  model::Loop one;
  one.type = type;
  one.name = "loop";
  one.ends = {first, second};
  one.length = length;
  one.file = "model.yaml";
  one.line = 7;
  return one;
}

/// Crank 0.2 m, coupler 0.45 m, rocker 0.35 m on a base of 0.5 m, in the plane of x and z; hinges about y.
inline model::Model four_bar(model::Loop::Type type = model::Loop::Type::connect) {
  using Eigen::Vector3d;
  model::Model model;
  model.file = "model.yaml";
  const Vector3d y = Vector3d::UnitY();
  const int crank = hang(model, bar("crank", 1.1, {0.1, 0.0, 0.01}, 0.004), -1, at({0, 0, 1}), y);
  const int coupler = hang(model, bar("coupler", 0.7, {0.2, 0.0, 0.0}, 0.01), crank, at({0.2, 0, 0}), y);
  const int rocker = hang(model, bar("rocker", 0.9, {0.0, 0.0, 0.18}, 0.008), -1, at({0.5, 0, 1}), y);
  Eigen::Matrix3d about_y = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), y).toRotationMatrix();
  model.loops.push_back(loop(type, {coupler, {0.45, 0, 0}, about_y}, {rocker, {0, 0, 0.35}, about_y}));
  return model;
}

/// Two arms of hinges about skew axes, from the world; their tips are what a loop may tie.
inline model::Model two_arms(int links, unsigned seed = 5) {
  using Eigen::Vector3d;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(draw(random), draw(random), draw(random)); };
  model::Model model;
  model.file = "model.yaml";
  for (int arm = 0; arm < 2; ++arm) {
    int parent = -1;
    for (int i = 0; i < links; ++i) {
      const Vector3d from = parent < 0 ? Vector3d(0.4 * arm, 0.0, 1.0) : Vector3d(0.3, 0.02, -0.03);
      parent =
          hang(model, bar("l" + std::to_string(arm) + std::to_string(i), 0.5 + 0.1 * i, 0.1 * vector(), 0.02),
               parent, at(from, vector()), vector().normalized());
    }
  }
  return model;
}

/// The tips of both arms, in the last links' frames.
inline model::LoopEnd tip(int arm, int links) {
  const int body = (arm + 1) * links - 1;
  return {body, Eigen::Vector3d(0.25, 0.03, 0.0), at({0.0, 0.0, 0.0}, {0.3, -0.2, 0.5}).linear()};
}

}  // namespace plumbline::test
