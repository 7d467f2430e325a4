// Positions from what sensors read: there and back.
#include "simulator/model/positions_from.h"

#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::model {
namespace {

// Stretches of some rad are pulled towards zero with a weight of 1e-6 of the sharpest encoder's, which is a
// hundred times a motor's: squared, 1e-8 and some.
constexpr double kPull = 1e-5;

class PositionsFromSensors : public testing::Test {
 protected:
  PositionsFromSensors()
      : plant_(read_model(PLUMBLINE_ROOT "/robots/mabel/mabel.yaml", known_effects()), {}) {
    x_ = Eigen::VectorXd::Zero(plant_.states());
    for (int i = 0; i < plant_.positions(); ++i) {
      x_[i] = 0.1 * (i % 5) - 0.17;
    }
  }
  Eigen::VectorXd readings() {
    Eigen::VectorXd y(plant_.sensors());
    plant_.outputs(x_.data(), y.data());
    return y;
  }
  Plant plant_;
  Eigen::VectorXd x_;
};

TEST_F(PositionsFromSensors, AllEncodersGiveAllPositions) {
  std::vector<Observation> channels;
  channels.reserve(static_cast<std::size_t>(plant_.sensors()));
  for (int s = 0; s < plant_.sensors(); ++s) {
    channels.push_back(observe_sensor(plant_, s));
  }
  const PositionsFrom from(plant_, channels);
  EXPECT_TRUE(from.determined());
  EXPECT_LT((from.positions(readings()) - x_.head(plant_.positions())).norm(), kPull);
}

TEST_F(PositionsFromSensors, AnUnseenStretchIsZeroAndAnUnseenJointLeavesItOpen) {
  std::vector<Observation> channels;
  std::vector<int> kept;
  for (int s = 0; s < plant_.sensors(); ++s) {
    if (plant_.model().sensors[static_cast<std::size_t>(s)].name != "mLA_left") {
      channels.push_back(observe_sensor(plant_, s));
      kept.push_back(s);
    }
  }
  Eigen::VectorXd values(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    values[static_cast<Eigen::Index>(k)] = readings()[kept[k]];
  }
  const PositionsFrom from(plant_, channels);
  EXPECT_TRUE(from.determined());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
  x.head(plant_.positions()) = from.positions(values);
  EXPECT_NEAR(plant_.motion_at(effects::Place::ratio, "leg_angle_left", x.data()).position, 0.0, 1e-6);
  EXPECT_NEAR(plant_.position_of("torso", x.data()), plant_.position_of("torso", x_.data()), 1e-9);

  channels.pop_back();  // the tower's encoder
  EXPECT_FALSE(PositionsFrom(plant_, channels).determined());
}

TEST_F(PositionsFromSensors, APlaceByNameSaysWhatTheSensorSays) {
  const Observation place = observe_place(plant_, "leg_angle_left", 1.0);
  EXPECT_NEAR(place.row.dot(x_.head(plant_.positions())) + place.offset,
              plant_.position_of("leg_angle_left", x_.data()), 1e-12);
}

}  // namespace
}  // namespace plumbline::model
