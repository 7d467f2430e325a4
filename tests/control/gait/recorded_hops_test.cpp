// A hopping run as its sensors record it, and as it is predicted from that record.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/effects/catalogue.h"
#include "simulator/trace/error.h"
#include "tests/control/gait/mabel_hops.h"
#include "tests/trace/temporary_folder.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/predict/estimate.h"
#include "validation/identify/predict/reach.h"
#include "validation/identify/predict/states_by_parts.h"
#include "validation/identify/trial/write_trial.h"

namespace plumbline::validation {
namespace {

class RecordedHops : public testing::Test {
 protected:
  static Trial trial_of(const model::Model& model) { return recorded_hops(hopping(model), 2); }

  static double error_of_flight(std::size_t which, const model::Model& model, const Trial& trial) {
    constexpr Eigen::Index kSamples = 50;
    Data data({trial}, {});
    data.windows = {{0, flights_of(trial).at(which).first, kSamples}};
    return compare(model, data).scores.train;
  }

  const model::Model model_ = mabel("mabel_planar.yaml");
  const Trial trial_ = trial_of(model_);
};

TEST_F(RecordedHops, HoldCommandsCountsAndSwitches) {
  ASSERT_EQ(trial_.measured.size(), model_.sensors.size());
  for (std::size_t s = 0; s < trial_.measured.size(); ++s) {
    const double count = model_.sensors[s].resolution;
    for (const double value : trial_.measured[s].values) {
      ASSERT_NEAR(value / count, std::round(value / count), 1e-6) << trial_.measured[s].sensor;
    }
  }
  ASSERT_EQ(trial_.commands.size(), 4U);
  EXPECT_GT(trial_.commands[1].values.cwiseAbs().maxCoeff(), 10.0);
  ASSERT_EQ(trial_.switches.size(), 2U);
  EXPECT_GE(trial_.contact_events.size(), 6U);  // both feet: down, up, down
  EXPECT_TRUE(trial_.contact_events.front().touchdown);
}

// Both feet stand in one window, which begins and ends in flight.
TEST_F(RecordedHops, AreCutInTheFlights) {
  for (const Window& window : cut_windows({trial_}, {})) {
    for (const SwitchRecord& record : trial_.switches) {
      EXPECT_EQ(record.values[window.first], 0.0) << window.first;
    }
  }
}

TEST_F(RecordedHops, ThePredictionOfTheFirstFlightIsAtTheFloor) {
  EXPECT_LT(error_of_flight(0, model_, trial_), 1.1);
}

TEST_F(RecordedHops, HoldADelayedCommandUntilItArrives) {
  model::Model late = model_;
  late.effects.push_back(
      {effects::Catalogue::all().find("command_delay"), "mLS_left", {model::Quantity{}}, 0});
  late.effects.back().values.front().value = 2.3e-3;
  const Trial trial = trial_of(late);
  EXPECT_LT(error_of_flight(1, late, trial), 1.1);
  EXPECT_GT(error_of_flight(1, model_, trial), 3.0);
}

// Through the stance too, where the spring's pulley leaves its stop and meets it again.
TEST_F(RecordedHops, ThePredictionIsAtTheFloorAndWithoutTheCablesStretchFarAbove) {
  const Data data({trial_}, {});
  EXPECT_LT(compare(model_, data).scores.train, 1.2);
  EXPECT_GT(compare(mabel("mabel_planar_rigid.yaml"), data.thinned(1)).scores.train, 100.0);
}

// Stiff gains of the leg shape make the cables ring: the replayed motion runs away from one that begins a
// little beside it, and a search over the whole of a stance does not find where it begins.
TEST_F(RecordedHops, RingingCablesAreFollowedByGrowingTheWindows) {
  run::LoadedScenario stiff = hopping(model_);
  for (const auto& [name, value] : std::vector<run::Named>{{"kp_LA_left", 950.0},
                                                           {"kd_LA_left", 100.0},
                                                           {"kp_mLS_left", 145.0},
                                                           {"kd_mLS_left", 1.75},
                                                           {"kp_LA_right", 610.0},
                                                           {"kd_LA_right", 37.0},
                                                           {"kp_mLS_right", 2.8},
                                                           {"kd_mLS_right", 0.053},
                                                           {"leg_angle_samples", 3.0}}) {
    stiff.controller->set(name, value);
  }
  Data data({recorded_hops(stiff, 2)}, {});
  data.windows = {data.windows[2]};  // the second stance
  ASSERT_EQ(data.windows.front().events.size(), 4U);
  PredictorPool pool(model_, data);
  const std::vector<FreeParameter> none;
  Point straight;
  EXPECT_FALSE(above_floor(data, settle_all(pool, none, kRoughly, straight)).empty());
  Point grown = grown_states(pool, none, {});
  EXPECT_TRUE(above_floor(data, settle_all(pool, none, kRoughly, grown)).empty());
}

// From the measurements the search of this landing stops at 43 floors, in the flight already, where a pulley
// meets its stop. The end of the flight before it tells where it begins.
TEST_F(RecordedHops, ALandingIsFollowedFromTheFlightBeforeIt) {
  PredictOptions options;
  options.window = 0.03;
  const Data data({read_trial(PLUMBLINE_ROOT "/tests/control/gait/landing", model_)}, options);
  ASSERT_EQ(data.windows.front().events.size(), 2U);
  PredictorPool pool(model_, data);
  Point straight;
  EXPECT_THAT(above_floor(data, settle_all(pool, {}, kRoughly, straight)), testing::Contains(0));
  Point grown = grown_states(pool, {}, {});
  EXPECT_TRUE(above_floor(data, settle_all(pool, {}, kRoughly, grown)).empty());
}

// What depends more finely on where it begins than can be searched is left out, what the model misses is not.
TEST_F(RecordedHops, AreKeptWholeWhereTheModelIsWrong) {
  const Data all = Data({trial_}, {}).thinned(2);
  const Followed rigid = follow_at(mabel("mabel_planar_rigid.yaml"), all, all.predict.window);
  for (std::size_t w = 0; w < all.windows.size(); ++w) {
    EXPECT_EQ(rigid.data.windows[w].count, all.windows[w].count) << w;
  }
  EXPECT_GT(compare(mabel("mabel_planar_rigid.yaml"), rigid.data).scores.train, 10.0);
}

// Their encoders show the count 0, which is also the edge.
TEST_F(RecordedHops, TheSpringsPulleysBeginInsideTheirStops) {
  const Data data({trial_}, {});
  Predictor predictor(model_, trial_, data.predict);
  const double count = model_.find_sensor("bsp_left")->resolution;
  int at_the_edge = 0;
  for (const Window& window : data.windows) {
    const Eigen::VectorXd x = predictor.initial_state(window);
    for (const Measured& channel : trial_.measured) {
      const Eigen::Index from = std::max<Eigen::Index>(0, window.first - 12);
      const bool rests = channel.values.segment(from, 25).isZero(0.0);
      if (channel.sensor.rfind("bsp", 0) != 0 || !rests) {
        continue;
      }
      const model::Observation at = model::observe_place(predictor.plant(), channel.sensor, 1.0);
      const double position = at.row.dot(x.head(at.row.size())) + at.offset;
      EXPECT_LT(position, 0.0) << channel.sensor << " in sample " << window.first;
      EXPECT_GT(position, -0.5 * count) << channel.sensor << " in sample " << window.first;
      ++at_the_edge;
    }
  }
  EXPECT_GT(at_the_edge, 2);
}

// Slopes of a stance's beginning, with touchdown and the pulley's way out of its stop: along the height of
// the hip, from which the instants of both depend.
TEST_F(RecordedHops, SlopesThroughTouchdownAndStopAgreeWithDifferences) {
  constexpr double kStep = 1e-5;  // m
  const Data all({trial_}, {});
  const Data data = all.beginnings(0.2);
  PredictorPool pool(model_, data);
  const Estimate found = estimate_states(pool);
  pool.with(0, {}, {}, [&](Predictor& predictor) {
    const Window& window = data.windows.front();
    const Eigen::VectorXd up = model::observe_place(predictor.plant(), "hip_z", 1.0).row.normalized();
    const auto at = [&](double share) -> Eigen::VectorXd {
      Eigen::VectorXd x = found.x0.front();
      x.head(up.size()) += share * kStep * up;
      return x;
    };
    const Eigen::VectorXd slope =
        (predictor.residual(window, at(-1.0)) - predictor.residual(window, at(1.0))) / (2.0 * kStep);
    const Linearisation lin = predictor.linearise(window, found.x0.front(), {});
    const Eigen::VectorXd along = lin.Jx.leftCols(up.size()) * up;
    EXPECT_LT((along - slope).norm(), 0.5 * slope.norm());
  });
}

// A platform that the robot ran over is part of its trial: a diagnosis that did not know it would blame
// physics.
TEST_F(RecordedHops, KeepThePlatformThatTheyRanOver) {
  run::LoadedScenario loaded = hopping(model_);
  loaded.scenario.terrain = contact::Terrain(0.0, {{-9.0, -0.2, 0.02}});
  const Trial trial = recorded_hops(loaded, 2);
  const test::TemporaryFolder folder;
  write_trial(trial, model_, folder.path("hops"));
  const Trial read = read_trial(folder.path("hops"), model_);
  ASSERT_EQ(read.terrain.platforms().size(), 1U);
  EXPECT_DOUBLE_EQ(read.terrain.height_at(-1.0), 0.02);
  EXPECT_EQ(read.terrain.height_at(0.0), 0.0);
  Predictor predictor(model_, read, {});
  EXPECT_DOUBLE_EQ(predictor.plant().terrain().height_at(-1.0), 0.02);
}

TEST_F(RecordedHops, OfAnEmptyRecordAreRefused) {
  const run::LoadedScenario loaded = hopping(model_);
  Table empty = hops_of(loaded, 1).run.record;
  for (Column& column : empty.columns) {
    column.values.conservativeResize(1);
  }
  EXPECT_THROW(recorded_run(model_, empty, loaded.scenario), InputError);
}

}  // namespace
}  // namespace plumbline::validation
