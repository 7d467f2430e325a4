// Tossed cubes whose ground is known: where a toss begins, and what a fit in one piece finds.
#include "validation/identify/fit/whole_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "simulator/trace/error.h"
#include "validation/identify/predict/flight_start.h"

namespace plumbline::validation {
namespace {

constexpr double kPeriod = 1.0 / 148.0;  // s, of the motion capture

class Tosses : public testing::Test {
 protected:
  static model::Model cube() {
    return model::read_model(std::string(PLUMBLINE_ROOT) + "/robots/cube/cube.yaml", model::known_effects());
  }

  /// Positions and velocities at a toss's start, of the centre's height.
  static Eigen::VectorXd start(std::uint64_t seed, double height) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(12);
    x.segment(2, 4) << height, any(random), 0.4 * any(random), any(random);
    x.segment(6, 6) << any(random), any(random), 0.5 * any(random), 5.0 * any(random), 1.0, 5.0 * any(random);
    return x;
  }

  static Trial toss(const model::Model& model, std::uint64_t seed, Eigen::Index samples, double height) {
    model::Plant plant(model, {});
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x.head(12) = start(seed, height);
    run::CommandedOptions options;
    options.integrator.method = integrate::Method::rosenbrock;
    options.integrator.set_tolerance(1e-7);
    const run::CommandedRun run =
        run::run_commands(plant, x, Eigen::MatrixXd::Zero(0, samples), kPeriod, 0.0, {}, nullptr, options);
    Trial trial;
    trial.file = trial.name = "toss " + std::to_string(seed);
    trial.time = run.time;
    trial.period = kPeriod;
    for (std::size_t s = 0; s < model.sensors.size(); ++s) {
      const std::string unit = s < 3 ? "m" : "rad";
      trial.measured.push_back({model.sensors[s].name, model.sensors[s].name, unit,
                                run.outputs.row(static_cast<Eigen::Index>(s)).transpose()});
    }
    return trial;
  }

  static std::vector<FreeParameter> free(const model::Model& model) {
    return matching(free_parameters(model), {"ground_friction@cube:friction", "ground_normal@cube:damping"});
  }

  static model::Model with(model::Model model, double friction, double damping) {
    for (model::EffectUse& use : model.effects) {
      const bool is_normal = use.law->declaration().name == "ground_normal";
      const auto index = static_cast<std::size_t>(is_normal ? 1 : 2);
      use.values[index].value = is_normal ? damping : friction;
    }
    return model;
  }
};

// The true state is known; without noise least squares must find it to what the integrator's tolerance (1e-5)
// leaves, while a polynomial over 12 samples runs into the impact.
TEST_F(Tosses, BeginAsTheFlightSays) {
  const model::Model model = cube();
  const Trial trial = toss(model, 3, 80, 0.1);
  Predictor predictor(model, trial, {});
  const Window whole{0, 0, trial.samples()};
  const Eigen::Index flight = samples_in_flight(predictor, 0, trial.samples());
  ASSERT_GE(flight, 5);
  ASSERT_LT(flight, 12);
  const Eigen::VectorXd x0 = state_at_start(predictor, trial, whole);
  const Eigen::VectorXd truth = start(3, 0.1);
  EXPECT_LT((x0.head(12) - truth).cwiseAbs().maxCoeff(), 2e-3) << (x0.head(12) - truth).transpose();
  EXPECT_GT((predictor.initial_state(whole).head(12) - truth).cwiseAbs().maxCoeff(), 2e-2);
}

// A motion that begins on the ground has no flight to tell anything.
TEST_F(Tosses, ThatBeginOnTheGroundBeginAsBefore) {
  const model::Model model = cube();
  const Trial trial = toss(model, 3, 80, 0.05);
  Predictor predictor(model, trial, {});
  EXPECT_EQ(samples_in_flight(predictor, 0, trial.samples()), 0);
  const Window whole{0, 0, trial.samples()};
  EXPECT_EQ(state_at_start(predictor, trial, whole), predictor.initial_state(whole));
}

// Through several impacts, from a friction that is 60 % too large and a third of the damping: friction comes
// within a tenth of the truth, the damping of a hard contact, which hardly shows, within a factor of two, and
// the recordings with them.
TEST_F(Tosses, TellTheGroundInOnePiece) {
  const model::Model truth = cube();
  std::vector<Trial> trials;
  for (const std::uint64_t seed : {3, 4, 5, 6}) {
    trials.push_back(toss(truth, seed, 80, 0.12));
  }
  trials.back().role = Role::held_out;
  const model::Model wrong = with(truth, 0.26, 8e5);
  const Data data(trials, {});
  FitOptions options;
  options.iterations = 20;
  const Fit fit = fit_whole(wrong, data, free(wrong), options, [](const std::string&, double) {});
  ASSERT_EQ(fit.parameters.size(), 2U);
  for (const FittedParameter& one : fit.parameters) {
    const bool is_friction = one.label == "ground_friction@cube:friction";
    const double value = is_friction ? 0.16 : 2.4e6;
    EXPECT_LT(one.after, (is_friction ? 1.1 : 2.0) * value) << one.label;
    EXPECT_GT(one.after, (is_friction ? 0.9 : 0.5) * value) << one.label;
    EXPECT_LE(one.lower, one.after);
    EXPECT_GE(one.upper, one.after);
  }
  EXPECT_LT(fit.after.train, 0.3 * fit.before.train);
  EXPECT_LT(fit.after.held_out, 0.5 * fit.before.held_out);
  EXPECT_EQ(fit.windows, 3);
  EXPECT_TRUE(fit.whole);
}

TEST_F(Tosses, WithoutATrainTrialAreRefused) {
  const model::Model model = cube();
  Trial trial = toss(model, 3, 80, 0.14);
  trial.role = Role::held_out;
  const Data data({trial}, {});
  EXPECT_THROW(fit_whole(model, data, free(model), {}, [](const std::string&, double) {}), InputError);
}

}  // namespace
}  // namespace plumbline::validation
