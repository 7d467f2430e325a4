// A walking gait on the model that it was designed on: a pinned toe, a rigid impact, and constraints kept
// exactly.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "controllers/blocks/virtual_constraints.h"
#include "simulator/model/model.h"
#include "simulator/model/rigid_contact.h"
#include "simulator/trace/table.h"

namespace plumbline::validation {

/// How a leg's parts are called in the model.
struct GaitLeg {
  std::string foot, angle, shape, angle_motor, shape_motor, spring;
};

/// `plumbline: rigid_gait/1`: which model, which gait, and what is what.
struct RigidGait {
  std::string file, model_file, gait_file;
  model::Model model;  ///< without the laws of its ground
  controllers::WalkingGait gait;
  GaitLeg stance, swing;
  std::string torso;
  std::array<std::string, 2> base;  ///< coordinates that carry the robot forward and up
  std::vector<std::pair<std::string, std::string>> exchanged;  ///< joints that swap their roles at touchdown
  std::map<std::string, double> start;  ///< velocities just before touchdown: theta, spring, spring_rate
  double mass = 0.0;                    ///< that the cost of transport is held against, kg
  std::array<double, 4> kp{}, kd{};     ///< of feedforward plus PD, by output, N m/rad and N m s/rad
  std::map<std::string, double>
      published;       ///< step_time, step_length, speed, cost_of_transport, multiplier_*, SI
  std::string curves;  ///< CSV of published curves; empty: none
  struct ImpactScale {
    double scale, speed;
  };
  std::vector<ImpactScale> impact_scales;  ///< published: steady speed for a scaled impact
};
RigidGait read_rigid_gait(const std::string& path);

enum class GaitControl {
  /// u such that y'' = -2 w y' - w^2 y, y = q - h - h_c: the constraints are kept. h_c takes up what an
  /// impact
  /// leaves of y and its rate and is gone by the middle of the constraint's first curve, so that the
  /// constraints are met just after any impact (hybrid invariance: Sreenath et al. equations 45 to 47).
  exact,
  feedforward,  ///< u*(theta) of the gait's file, plus PD (Sreenath et al. equation 43)
};

struct RigidGaitOptions {
  GaitControl control = GaitControl::exact;
  double impact_scale = 1.0;  ///< eta: velocities after the impact times this (Sreenath et al. section VI-B)
  double bandwidth = 60.0;    ///< w of exact control, 1/s
  double tolerance = 1e-8;    ///< of the integrator
  bool trace = false;
};

/// One step, from just after a touchdown to just after the next.
struct RigidStep {
  bool walked = false;
  std::string failure;                 ///< in words, where it did not
  Eigen::VectorXd end;                 ///< state just before touchdown, roles not yet exchanged
  Eigen::VectorXd next;                ///< just after it, roles exchanged: the next step's start
  double time = 0.0, length = 0.0;     ///< s, m
  std::array<double, 3> phase_ends{};  ///< of mc, sc, si, s
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< of the ground on the swing foot, N s
  double impact_loss = 0.0;                           ///< J
  double positive_work = 0.0;                         ///< sum of the motors' positive work, J
  double torque_squared = 0.0;                        ///< integral of |u|^2, N^2 m^2 s
  double least_normal = 0.0, largest_friction = 0.0;  ///< N; F_T/F_N
  Table trace;
};

/// Positions and rates that describe a stance leg's state on the design model: theta, the stance spring, the
/// swing spring (at rest), then the four outputs in the order of controllers::WalkOutput.
using GaitCoordinates = Eigen::Matrix<double, 7, 1>;

class RigidWalker {
 public:
  explicit RigidWalker(const RigidGait& gait);

  /// The state just after touchdown for velocities just before it, on the constraints: theta_rate, spring,
  /// spring_rate.
  Eigen::VectorXd after_touchdown(const Eigen::Vector3d& before, double impact_scale);
  /// Of a state just before touchdown.
  Eigen::Vector3d before_touchdown(const Eigen::VectorXd& end) const;
  /// From just after a touchdown.
  RigidStep step(const Eigen::VectorXd& start, const RigidGaitOptions& options);

  /// A fixed point of touchdown to touchdown on the constraints, by Newton's method from `guess`.
  struct FixedPoint {
    bool found = false;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< theta_rate, spring, spring_rate just before touchdown
    RigidStep step;
    double residual = 0.0;
    std::string failure;
  };
  FixedPoint fixed_point(const Eigen::Vector3d& guess, const RigidGaitOptions& options);
  /// The same for a controller that does not keep the constraints: steps until they repeat, at most `most`.
  FixedPoint settle(const Eigen::VectorXd& start, const RigidGaitOptions& options, int most,
                    double tolerance);

  /// Eigenvalues, largest first, of the map from one switch of si to sd to the next: outputs, spring and
  /// their rates, and the rate of theta (11 numbers). `start`: of a step that repeats.
  Eigen::VectorXd multipliers(const Eigen::VectorXd& start, const RigidGaitOptions& options);

  model::Plant& plant() { return plant_; }
  double theta(const Eigen::VectorXd& x) const { return rows_.row(0).dot(x.head(plant_.positions())); }

 private:
  struct Walk {
    controllers::WalkPhase phase;
    bool to_switch = false;  // ends where si does, not at touchdown
  };
  bool walk(Eigen::VectorXd& x, const Walk& from, const RigidGaitOptions& options, RigidStep& step);
  bool until_event(Eigen::VectorXd& x, controllers::WalkPhase phase, const RigidGaitOptions& options,
                   RigidStep& step);
  double event_value(controllers::WalkPhase phase, const double* x);
  void command(controllers::WalkPhase phase, const double* x, const RigidGaitOptions& options, double* u);
  /// h_c at theta of each output, from its values at the beginning of a step.
  struct Correction {
    double begin = 0.0, length = 0.0;  // of theta, rad; length 0: none
    double value = 0.0, slope = 0.0;   // at the beginning
    controllers::CurvePoint at(double theta) const;
  };
  void correct(const Eigen::VectorXd& x);
  void exact(const std::array<controllers::CurvePoint, 4>& h, const double* x,
             const RigidGaitOptions& options, double* u);
  Eigen::VectorXd touchdown(const Eigen::VectorXd& x, double impact_scale, RigidStep* step);
  Eigen::VectorXd compose(const GaitCoordinates& q, const GaitCoordinates& v);
  GaitCoordinates coordinates(const Eigen::VectorXd& x, bool rates) const;
  void record(double t, controllers::WalkPhase phase, const double* x, const RigidGaitOptions& options,
              RigidStep& step);

  const RigidGait& gait_;
  model::Plant plant_;
  model::RigidContact contact_;
  int stance_foot_, swing_foot_;
  Eigen::MatrixXd rows_;  // of GaitCoordinates, 7 x positions
  std::array<Eigen::RowVectorXd, 2> base_;
  std::array<int, 4> motors_{};
  std::array<double, 4> motor_signs_{};  // of a motor's turn when its leg's angle or shape grows
  Eigen::RowVectorXd shapes_[2];
  Eigen::MatrixXd exchange_;
  double ground_ = 0.0;
  std::array<Correction, 4> corrections_;
};

}  // namespace plumbline::validation
