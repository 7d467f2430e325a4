// Accelerations of closed loops beside Simbody's constraints, on mechanisms built twice from the same
// numbers.
#include <Simbody.h>
#include <gtest/gtest.h>

#include <random>

#include "simulator/model/engine.h"
#include "simulator/model/plant.h"
#include "tests/model/loop_mechanisms.h"

namespace plumbline::model {
namespace {

SimTK::Vec3 vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

SimTK::Rotation rotation(const Eigen::Matrix3d& R) {
  SimTK::Mat33 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m(i, j) = R(i, j);
    }
  }
  return SimTK::Rotation(m);
}

/// Simbody's own solution of the whole: its mobilizers, gravity and constraints.
class Peer {
 public:
  explicit Peer(const Model& model) : gravity_(forces_, matter_, vec(model.skeleton.gravity)) {
    for (const Joint& joint : model.skeleton.joints) {
      const Body& body = model.skeleton.bodies[static_cast<std::size_t>(joint.child)];
      const SimTK::Inertia central(SimTK::Vec3(body.inertia(0, 0), body.inertia(1, 1), body.inertia(2, 2)));
      const SimTK::Vec3 com = vec(body.com);
      const SimTK::Body::Rigid rigid(
          SimTK::MassProperties(body.mass, com, central.shiftFromMassCenter(com, body.mass)));
      const SimTK::Rotation about(SimTK::UnitVec3(vec(joint.axis)), SimTK::ZAxis);
      const SimTK::Transform X_PJ(rotation(joint.X_PJ.linear()),
                                  vec(Eigen::Vector3d(joint.X_PJ.translation())));
      SimTK::MobilizedBody& parent = matter_.updMobilizedBody(link(joint.parent));
      links_.push_back(
          SimTK::MobilizedBody::Pin(parent, X_PJ * SimTK::Transform(about), rigid, SimTK::Transform(about))
              .getMobilizedBodyIndex());
    }
    for (const Loop& loop : model.loops) {
      add(loop);
    }
    state_ = system_.realizeTopology();
  }

  /// Accelerations at a state that closes the loops; how far it is from closing Simbody's.
  Eigen::VectorXd accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double* open) {
    for (int i = 0; i < q.size(); ++i) {
      state_.updQ()[i] = q[i];
      state_.updU()[i] = v[i];
    }
    system_.realize(state_, SimTK::Stage::Acceleration);
    *open = std::max(state_.getQErr().norm(), state_.getUErr().norm());
    Eigen::VectorXd a(q.size());
    for (int i = 0; i < q.size(); ++i) {
      a[i] = state_.getUDot()[i];
    }
    return a;
  }

 private:
  SimTK::MobilizedBodyIndex link(int body) const {
    return body < 0 ? SimTK::GroundIndex : links_[static_cast<std::size_t>(body)];
  }
  void add(const Loop& loop) {
    SimTK::MobilizedBody& first = matter_.updMobilizedBody(link(loop.ends[0].body));
    SimTK::MobilizedBody& second = matter_.updMobilizedBody(link(loop.ends[1].body));
    const SimTK::Vec3 on_first = vec(loop.ends[0].point);
    const SimTK::Vec3 on_second = vec(loop.ends[1].point);
    switch (loop.type) {
      case Loop::Type::rod:
        SimTK::Constraint::Rod(first, on_first, second, on_second, loop.length);
        return;
      case Loop::Type::connect:
        SimTK::Constraint::Ball(first, on_first, second, on_second);
        return;
      case Loop::Type::weld:
        SimTK::Constraint::Weld(first, SimTK::Transform(rotation(loop.ends[0].axes), on_first), second,
                                SimTK::Transform(rotation(loop.ends[1].axes), on_second));
        return;
      case Loop::Type::hinge:
        SimTK::Constraint::Ball(first, on_first, second, on_second);
        for (int axis = 0; axis < 2; ++axis) {
          const Eigen::Vector3d across = loop.ends[0].axes.col(axis);
          const Eigen::Vector3d along = loop.ends[1].axes.col(2);
          SimTK::Constraint::ConstantAngle(first, SimTK::UnitVec3(vec(across)), second,
                                           SimTK::UnitVec3(vec(along)), SimTK::Pi / 2);
        }
    }
  }

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  SimTK::Force::UniformGravity gravity_;
  std::vector<SimTK::MobilizedBodyIndex> links_;
  SimTK::State state_;
};

struct Case {
  std::string name;
  Model model;
};

Case arms(const std::string& name, Loop::Type type, int links, double length = 0.0) {
  Model model = test::two_arms(links);
  model.loops.push_back(test::loop(type, test::tip(0, links), test::tip(1, links), length));
  return {name, model};
}

Case tied_to_world() {
  Model model = test::two_arms(3);
  model.loops.push_back(test::loop(Loop::Type::connect, {-1, {0.5, 0.1, 0.9}}, test::tip(0, 3)));
  model.loops.push_back(test::loop(Loop::Type::rod, test::tip(0, 3), test::tip(1, 3), 0.45));
  model.loops.back().name = "strut";
  return {"world_and_rod", model};
}

std::vector<Case> cases() {
  return {{"four_bar", test::four_bar()},
          {"four_bar_of_a_hinge", test::four_bar(Loop::Type::hinge)},
          arms("connect", Loop::Type::connect, 3),
          arms("rod", Loop::Type::rod, 3, 0.4),
          arms("hinge", Loop::Type::hinge, 4),
          arms("weld", Loop::Type::weld, 4),
          tied_to_world()};
}

class LoopsBesideSimbody : public testing::TestWithParam<std::size_t> {
 protected:
  ~LoopsBesideSimbody() override { set_engine(Engine::tree); }
};

// 100 random states that close the loops, for both engines of ours.
TEST_P(LoopsBesideSimbody, MoveTheSame) {
  const Model model = cases()[GetParam()].model;
  Plant plant(model, {});
  Peer peer(model);
  std::mt19937_64 random(17);
  std::normal_distribution<double> draw;
  const int n = plant.positions();
  const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(n, n);
  const auto some = [&] {
    return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index) { return draw(random); });
  };
  Eigen::VectorXd x(2 * n), rate(2 * n);
  int compared = 0;
  for (int i = 0; i < 400 && compared < 100; ++i) {
    Eigen::VectorXd z = plant.home() + 0.7 * some();
    if (!plant.closure()->close(all, Eigen::VectorXd(z), z)) {
      continue;  // drawn too far from where the loops can close
    }
    x << z, plant.closure()->velocities(all, 2.0 * some(), z);
    ++compared;
    double open = 0.0;
    const Eigen::VectorXd theirs = peer.accelerations(z, x.tail(n), &open);
    EXPECT_LT(open, 1e-11);
    set_engine(compared % 2 == 0 ? Engine::tree : Engine::simbody);
    plant.rate(x.data(), nullptr, rate.data());
    // 1e-9 of the largest acceleration: near a dead centre the loops' equations are badly conditioned.
    EXPECT_LT((rate.tail(n) - theirs).cwiseAbs().maxCoeff(), 1e-9 * (1.0 + theirs.cwiseAbs().maxCoeff()));
  }
  EXPECT_EQ(compared, 100);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, LoopsBesideSimbody, testing::Range<std::size_t>(0, cases().size()),
                         [](const testing::TestParamInfo<std::size_t>& tested) {
                           return cases()[tested.param].name;
                         });

}  // namespace
}  // namespace plumbline::model
