// The paper's running motion beside what was published of it: numbers, curves and a recovery, on the paper's
// own model in continuous time.
#pragma once

#include <string>
#include <vector>

#include "controllers/monopod/parameters.h"
#include "simulator/model/model.h"
#include "validation/control/published/validate.h"
#include "validation/studies/running/design.h"

namespace plumbline::validation {

struct PublishedRunning {
  std::string file, title, model_file, controller_file;
  monopod::Parameters running;
  monopod::Constants model;  ///< of the robot's file, which the controller's must equal

  struct Number {
    std::string name, measure;
    PublishedQuantity::Relation relation = PublishedQuantity::Relation::value;
    model::Quantity quantity, tolerance;
  };
  std::vector<Number> numbers;

  /// Over the time since touchdown (torso, motor) or since lift-off (toe, shape).
  struct Shape {
    std::string name, of, unit, source;
    WantedCurve curve;  ///< its tolerance is that of the root mean square difference
  };
  std::vector<Shape> shapes;

  /// A push just before a touchdown and what remains of it at this and the next ones. The file states it in
  /// the paper's frame; where that robot runs towards -x, `mirrored` turns what points along x.
  struct Recovery {
    double angle = 0.0, rate = 0.0;  ///< added to each of them, SI
    double forward = 0.0,
           rise = 0.0;  ///< added to the velocity of the centre of mass, along the run and upward
    std::vector<double> pitch, travel;  ///< published errors at each touchdown; pitch without sign
    model::Quantity pitch_tolerance, forward_tolerance;  ///< of the root mean square difference
    std::string source;
  };
  Recovery recovery;
};

/// `plumbline: published_running/1`. Throws InputError (one line: file, line, key, found, expected).
PublishedRunning read_published_running(const std::string& path);
/// Whether a file says that it is of this format.
bool is_published_running(const std::string& path);

/// What a measure's word means; throws InputError for an unknown one.
///   stance, flight              durations, s
///   torso_at_touchdown, pitch_at_liftoff, motor_at_touchdown, motor_at_liftoff      rad
///   multiplier, multiplier_open      largest |eigenvalue| of the return map with and without the outer loop
///   contraction                 of the speed's error from one touchdown to the next, late in the recovery
///   friction, touchdown_friction     largest tangential over normal force in stance, and of the impulse
///   least_normal                least normal force in stance, N
///   angle_motor_torque, shape_motor_torque   largest, N m
GaitValidation validate_running(const PublishedRunning& published);

}  // namespace plumbline::validation
