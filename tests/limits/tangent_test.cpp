// The sensitivities that every fit and diagnosis rests on, against differences of whole predicted windows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/limits/bench.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::limits {
namespace {

using validation::FreeParameter;
using validation::Predictor;
using validation::Window;

constexpr double kShare = 1e-3;  // of a column's norm
// One linearisation for each sample: what oscillates near 20 Hz (this stretch) or lasts a few samples (the
// Stribeck peak at a reversal) is resolved less well.
constexpr double kFastShare = 5e-3;

struct Moved {
  std::string effect, at, parameter;
  double typical = 0.0;  // a step of difference is 1e-3 of it
  double share = kShare;
};

struct Case {
  std::string label;
  std::vector<std::string> added;  // as on the command line
  std::vector<Moved> moved;
};

std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.label; }

FreeParameter free_parameter(const model::Model& model, const Moved& moved) {
  FreeParameter parameter;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const model::EffectUse& use = model.effects[e];
    if (use.law->declaration().name == moved.effect && use.at == moved.at) {
      const int p = use.law->parameter_index(moved.parameter);
      const effects::Parameter& declared = use.law->declaration().parameters[static_cast<std::size_t>(p)];
      parameter.id = {static_cast<int>(e), p};
      parameter.label = moved.effect + "@" + moved.at + ":" + moved.parameter;
      parameter.lower = declared.lower;
      parameter.upper = declared.upper;
    }
  }
  parameter.typical = moved.typical;
  return parameter;
}

class Tangent : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    for (const std::string& text : GetParam().added) {
      model_.effects.push_back(validation::parse_effect(text, model_, effects::Catalogue::all()));
    }
    trial_ = validation::twin(model_, both_motors(model_, 0.8), {});
    validation::PredictOptions fine;
    fine.relative_tolerance = 1e-9;
    exact_ = std::make_unique<Predictor>(model_, trial_, fine);
    window_ = {0, 250, 500};
    x0_ = exact_->initial_state(window_);
  }

  void expect_column(const Eigen::VectorXd& found, const Eigen::VectorXd& expected, const std::string& label,
                     double limit = kShare) {
    const double share = (found - expected).norm() / expected.norm();
    std::printf("%-24s %-42s %9.2e\n", GetParam().label.c_str(), label.c_str(), share);
    EXPECT_GT(expected.norm(), 0.0) << label;
    EXPECT_LT(share, limit) << label;
  }

  /// The derivatives by the case's parameters against differences of whole predictions.
  validation::Linearisation expect_parameters() {
    std::vector<FreeParameter> parameters;
    for (const Moved& moved : GetParam().moved) {
      parameters.push_back(free_parameter(model_, moved));
    }
    Predictor predictor(model_, trial_, {});
    validation::Linearisation found = predictor.linearise(window_, x0_, parameters);
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const double step = 1e-3 * parameters[p].typical;
      const double here = exact_->plant().value(parameters[p].id);
      exact_->plant().set_value(parameters[p].id, here + step);
      const Eigen::VectorXd up = exact_->residual(window_, x0_);
      exact_->plant().set_value(parameters[p].id, here - step);
      const Eigen::VectorXd down = exact_->residual(window_, x0_);
      exact_->plant().set_value(parameters[p].id, here);
      expect_column(found.Jp.col(static_cast<Eigen::Index>(p)), (down - up) / (2.0 * step),
                    parameters[p].label, GetParam().moved[p].share);
    }
    return found;
  }

  model::Model model_ = leg_bench();
  validation::Trial trial_;
  std::unique_ptr<Predictor> exact_;
  Window window_;
  Eigen::VectorXd x0_;
};

TEST_P(Tangent, AgreesWithDifferencesOfWholeWindows) {
  const validation::Linearisation found = expect_parameters();
  const std::vector<std::string> names = exact_->plant().state_names();
  const std::vector<int> carried = exact_->plant().carried_states();
  for (Eigen::Index i = 0; i < x0_.size(); ++i) {
    if (std::find(carried.begin(), carried.end(), static_cast<int>(i)) != carried.end()) {
      EXPECT_EQ(found.Jx.col(i).norm(), 0.0) << "follows the measured motion, whatever the start";
      continue;
    }
    const double step = 1e-5 * (1.0 + std::abs(x0_[i]));
    Eigen::VectorXd x = x0_;
    x[i] = x0_[i] + step;
    const Eigen::VectorXd up = exact_->residual(window_, x);
    x[i] = x0_[i] - step;
    const Eigen::VectorXd down = exact_->residual(window_, x);
    expect_column(found.Jx.col(i), (down - up) / (2.0 * step), names[static_cast<std::size_t>(i)]);
  }
}

class TangentByParameters : public Tangent {};

// What a state faster than the sample does within it is known as a mean only.
TEST_P(TangentByParameters, AgreesWithDifferencesOfWholeWindows) { expect_parameters(); }

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases = {
      {"bare", {}, {{"viscous", "mLA", "damping", 4e-3}, {"viscous", "mLS", "damping", 1e-2}}},
      {"coulomb",
       {"coulomb@mLA:level=0.05,smoothing_speed=0.05"},
       {{"coulomb", "mLA", "level", 0.05}, {"viscous", "mLA", "damping", 4e-3}}},
      {"torque_constant_error",
       {"torque_constant_error@mLS:scale=0.95"},
       {{"torque_constant_error", "mLS", "scale", 1.0}}},
      {"added_mass", {"added_mass@shin:mass=0.1"}, {{"added_mass", "shin", "mass", 1.0}}},
      {"com_shift",
       {"com_shift@thigh:x=0.003,z=0.002"},
       {{"com_shift", "thigh", "x", 0.1}, {"com_shift", "thigh", "z", 0.1}}},
      {"encoder_scale", {"encoder_scale@thigh:scale=1.01"}, {{"encoder_scale", "thigh", "scale", 1.0}}},
      {"sensor_lag",
       {"sensor_lag@thigh:lag=0.003", "encoder_scale@thigh:scale=1.01"},
       {{"sensor_lag", "thigh", "lag", 0.01}, {"encoder_scale", "thigh", "scale", 1.0}}},
      {"lost_counts",
       {"lost_counts@mLA:share=0.05,limit_speed=6,width=0.2", "encoder_scale@mLA:scale=1.01"},
       {{"lost_counts", "mLA", "share", 0.05},
        {"lost_counts", "mLA", "limit_speed", 6.0},
        {"encoder_scale", "mLA", "scale", 1.0}}},
      {"actuator_lag",
       {"actuator_lag@mLA:time_constant=0.005"},
       {{"actuator_lag", "mLA", "time_constant", 0.005}}},
      {"cable_stretch",
       {"cable_stretch@leg_angle:stiffness=5,damping=0.01"},
       {{"cable_stretch", "leg_angle", "stiffness", 5.0, kFastShare},
        {"cable_stretch", "leg_angle", "damping", 0.01, kFastShare}}},
      {"lugre",
       {"lugre@mLA:level=0.05,rise=0.02,stribeck_speed=1,stiffness=0.5,bristle_damping=0.016,viscous=0.001"},
       {{"lugre", "mLA", "level", 0.05},
        {"lugre", "mLA", "rise", 0.02, kFastShare},
        {"lugre", "mLA", "stribeck_speed", 1.0},
        {"lugre", "mLA", "stiffness", 0.5, kFastShare},
        {"lugre", "mLA", "bristle_damping", 0.016},
        {"lugre", "mLA", "viscous", 0.001}}},
      {"torque_saturation", {"torque_saturation@mLA:sag=0.1"}, {{"torque_saturation", "mLA", "sag", 0.1}}},
      {"torque_ripple",
       {"torque_ripple@mLA:sine=0.05,cosine=0.03,cycles=12"},
       {{"torque_ripple", "mLA", "sine", 0.1}, {"torque_ripple", "mLA", "cosine", 0.1}}},
      {"winding",
       {"winding@mLA:time_constant=0.005,slope=0.02"},
       {{"winding", "mLA", "time_constant", 0.005}, {"winding", "mLA", "slope", 0.02}}},
      {"battery",
       {"battery@world:stall_sag=0.05,speed_sag=1e-3", "torque_constant_error@mLS:scale=1.05"},
       {{"battery", "world", "stall_sag", 0.05},
        {"battery", "world", "speed_sag", 1e-3},
        {"torque_constant_error", "mLS", "scale", 1.0}}},
      {"asymmetric_spring",
       {"asymmetric_spring@thigh:stiffness_above=2,stiffness_below=1,rest=0.3"},
       {{"asymmetric_spring", "thigh", "stiffness_above", 1.0, kFastShare},
        {"asymmetric_spring", "thigh", "rest", 0.3, kFastShare}}},
      {"resonator",
       {"resonator@leg_angle:inertia=0.02,frequency=6,damping_ratio=0.1"},
       {{"resonator", "leg_angle", "inertia", 0.02},
        {"resonator", "leg_angle", "frequency", 6.0},
        {"resonator", "leg_angle", "damping_ratio", 0.1}}},
      {"command_delay", {"command_delay@mLA:delay=0.0023"}, {{"command_delay", "mLA", "delay", 0.01}}},
      {"bus_delay", {"bus_delay@world:delay=0.0023"}, {{"bus_delay", "world", "delay", 0.01}}},
      // Within the window no whole sample is passed: there the mean of held commands has a corner.
      {"clock_drift",
       {"clock_drift@mLA:offset=0.0021,drift=0.001"},
       {{"clock_drift", "mLA", "offset", 0.01}, {"clock_drift", "mLA", "drift", 0.01}}},
      {"rotor_inertia", {"rotor_inertia@mLA:inertia=3e-5"}, {{"rotor_inertia", "mLA", "inertia", 5e-4}}},
      {"gravity_tilt", {"gravity_tilt@world:roll=0,pitch=0.02"}, {{"gravity_tilt", "world", "pitch", 0.1}}},
  };
  return kCases;
}

INSTANTIATE_TEST_SUITE_P(Effects, Tangent, testing::ValuesIn(cases()),
                         [](const auto& chosen) { return chosen.param.label; });

INSTANTIATE_TEST_SUITE_P(FastLag, TangentByParameters,
                         testing::Values(Case{"sixteenth_of_a_sample",
                                              {"actuator_lag@mLA:time_constant=6e-5"},
                                              {{"actuator_lag", "mLA", "time_constant", 6e-5, 0.1}}},
                                         Case{"half_a_sample",
                                              {"actuator_lag@mLA:time_constant=5e-4"},
                                              {{"actuator_lag", "mLA", "time_constant", 5e-4, 0.1}}},
                                         Case{"current_loop",
                                              {"current_loop@mLA:time_constant=5e-4,damping_ratio=0.5"},
                                              {{"current_loop", "mLA", "time_constant", 5e-4, 0.1},
                                               {"current_loop", "mLA", "damping_ratio", 0.5, 0.1}}},
                                         Case{"winding",
                                              {"winding@mLA:time_constant=5e-4,slope=0.02"},
                                              {{"winding", "mLA", "time_constant", 5e-4, 0.1},
                                               {"winding", "mLA", "slope", 0.02, 0.1}}}),
                         [](const auto& chosen) { return chosen.param.label; });

// Within a sample the thigh goes up to 3 mrad: the preload is there at once.
std::vector<Moved> knee(double share) {
  return {{"unilateral_spring", "thigh", "stiffness", 1.0, share},
          {"unilateral_spring", "thigh", "preload", 0.05, share},
          {"unilateral_spring", "thigh", "rest", 0.3, share}};
}

INSTANTIATE_TEST_SUITE_P(
    SharpKnee, TangentByParameters,
    testing::Values(Case{"of_many_samples",
                         {"unilateral_spring@thigh:stiffness=1,preload=0.05,rest=0.3,side=-1,"
                          "smoothing_length=0.03"},
                         knee(0.02)},
                    Case{"of_a_sample",
                         {"unilateral_spring@thigh:stiffness=1,preload=0.05,rest=0.3,side=-1,"
                          "smoothing_length=0.001"},
                         knee(0.02)},
                    Case{"within_a_sample",
                         {"unilateral_spring@thigh:stiffness=1,preload=0.05,rest=0.3,side=-1,"
                          "smoothing_length=1e-5"},
                         knee(0.02)}),
    [](const auto& chosen) { return chosen.param.label; });

// Its corner is passed within a sample.
INSTANTIATE_TEST_SUITE_P(StrainWaveGear, TangentByParameters,
                         testing::Values(Case{
                             "soft_and_stiff",
                             {"harmonic_drive@leg_angle:stiffness_soft=5,stiffness_stiff=10,windup=0.05,"
                              "damping=0.02"},
                             {{"harmonic_drive", "leg_angle", "stiffness_soft", 5.0, 0.03},
                              {"harmonic_drive", "leg_angle", "stiffness_stiff", 10.0, 0.03},
                              {"harmonic_drive", "leg_angle", "windup", 0.05, 0.05}}}),
                         [](const auto& chosen) { return chosen.param.label; });

INSTANTIATE_TEST_SUITE_P(Coupling, TangentByParameters,
                         testing::Values(Case{
                             "that_slips",
                             {"slipping_coupling@leg_angle:limit=0.6,stiffness=20,damping=0.05"},
                             {{"slipping_coupling", "leg_angle", "limit", 0.6, 0.05},
                              {"slipping_coupling", "leg_angle", "stiffness", 20.0, 0.05}}}),
                         [](const auto& chosen) { return chosen.param.label; });

// What a gear passes on depends on what it loses: the loop through the acceleration is left out of the
// slopes.
INSTANTIATE_TEST_SUITE_P(GearLoad, TangentByParameters,
                         testing::Values(Case{
                             "of_two_losses",
                             {"gear_efficiency@mLA:loss_driving=0.02,loss_driven=0.01,smoothing_speed=0.5"},
                             {{"gear_efficiency", "mLA", "loss_driving", 0.02, 0.03},
                              {"gear_efficiency", "mLA", "loss_driven", 0.02, 0.03}}}),
                         [](const auto& chosen) { return chosen.param.label; });

// Where the limit is met within a sample, its share of the sample is not known.
INSTANTIATE_TEST_SUITE_P(VoltageLimit, TangentByParameters,
                         testing::Values(Case{"beside_a_torque_constant",
                                              {"voltage_limit@mLA:stall_torque=1,no_load_speed=40",
                                               "torque_constant_error@mLA:scale=1.1"},
                                              {{"voltage_limit", "mLA", "stall_torque", 1.0, 0.04},
                                               {"voltage_limit", "mLA", "no_load_speed", 40.0, 0.02},
                                               {"torque_constant_error", "mLA", "scale", 1.0, 0.02}}}),
                         [](const auto& chosen) { return chosen.param.label; });

// The surfaces meet, part and rattle; where they part only the slopes of the force jump.
INSTANTIATE_TEST_SUITE_P(Play, TangentByParameters,
                         testing::Values(Case{"that_rattles",
                                              {"backlash@leg_shape:gap=0.16,stiffness=20,damping=0.1"},
                                              {{"backlash", "leg_shape", "gap", 0.1, 0.03},
                                               {"backlash", "leg_shape", "stiffness", 20.0, 0.03},
                                               {"backlash", "leg_shape", "damping", 0.1, 0.03}}}),
                         [](const auto& chosen) { return chosen.param.label; });

}  // namespace
}  // namespace plumbline::limits
