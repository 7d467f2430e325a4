// What every effect is: a law with parameters that sits at a place of a robot.
// Pure: Eigen and the standard library only. A law knows nothing of robots, files or integrators.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumbline::effects {

/// Where an effect can sit.
/// coordinate: a named scalar position (joint or linear combination); motor: a motor's own coordinate;
/// ratio: a rigid coupling of a motor to coordinates, which the effect releases;
/// body: a link's mass properties; sensor: one measured channel; world: gravity;
/// foot: a point that meets the ground (laws in contact/); base: the two slides that carry a planar robot;
/// contact_switch: a switch that shows when a foot is in the ground; limb: all motors from a link on, or all
/// of the robot ("world").
enum class Place { coordinate, motor, ratio, body, sensor, world, foot, base, contact_switch, limb };

/// The line along which a parameter is searched: as it is, by its logarithm (positive scales such as a
/// speed), or by its reciprocal (stiffnesses whose null value is infinite).
enum class Scale { linear, logarithm, reciprocal };

/// One parameter of a law. `unit` is written for a general place: {force} stands for N m (rotation) or
/// N (translation), {position} for rad or m, {inertia} for kg m^2 or kg. Example: viscous damping
/// "{force} s/{position}".
struct Parameter {
  std::string name;
  std::string unit;
  std::string meaning;
  double null_value = 0.0;  ///< at the null values of all parameters the law changes nothing
  double lower = 0.0;       ///< physical bounds; the value may be equal to them
  double upper = 0.0;
  Scale scale = Scale::linear;
  bool structural =
      false;  ///< a choice or a numerical constant (side of a stop, cycles per turn): never fitted
};

/// What a reader sees of a law; the documentation table is made from it.
struct Declaration {
  std::string name;      ///< lower_case, as on the command line
  std::string summary;   ///< one line
  std::string equation;  ///< plain text, with the parameters' names; the code's formula, not another
  std::string source;    ///< paper and equation, or textbook
  std::vector<Place> places;
  std::vector<Parameter> parameters;
  std::vector<std::string> states;  ///< names of the physics states, empty for most
  std::string power_note;           ///< if dissipated power can be negative: when, and why
};

/// Typical magnitudes at a place, taken from a trial, in the place's own units (rad or m, N m or N).
struct Scales {
  double position = 1.0;  ///< half range of the motion
  double velocity = 1.0;  ///< root mean square
  double force = 1.0;     ///< root mean square of the driving generalised force
  double inertia = 1.0;   ///< generalised inertia felt at the place
  double period = 1e-3;   ///< sample period, s
  double center = 0.0;    ///< mean position
};

/// Parameter values in the order of Declaration::parameters.
using Values = std::vector<double>;

class Law {
 public:
  virtual ~Law() = default;
  virtual const Declaration& declaration() const = 0;

  /// Magnitude at which each parameter would matter about as much as the driving force (same order as the
  /// parameters). Used for difference steps and conditioning, never as an estimate.
  virtual Values typical(const Scales& scales) const = 0;

  /// Parameter vectors from which a diagnosis starts to look. Laws that are linear in their parameters at
  /// null give one start (null values, with sensible structural values); laws with a shape parameter or a
  /// state give a small grid.
  virtual std::vector<Values> starts(const Scales& scales) const = 0;

  /// True when these values change nothing: then no state and no coordinate is added to the system.
  /// Default: every parameter that is neither structural nor irrelevant is at its null value.
  virtual bool is_null(const double* p) const;

  int parameter_count() const { return static_cast<int>(declaration().parameters.size()); }
  int state_count() const { return static_cast<int>(declaration().states.size()); }
  Values null_values() const;
  int parameter_index(const std::string& name) const;  ///< -1 when unknown
  bool sits_at(Place place) const;
};

/// What a force law sees of its place. For Place::ratio, position and velocity are those of the stretch
/// c(q) of the ratio (Park et al. equation 23).
struct Motion {
  double position = 0.0;
  double velocity = 0.0;
  /// Torque the motor delivers at this place, or what its gear passes on (ForceLaw::feels_gear_load); 0 where
  /// there is no motor.
  double load = 0.0;
};

/// A generalised force at a coordinate, motor or stretch.
/// Power balance, which the tests check: force * velocity = - d(stored_energy)/dt - dissipated_power.
class ForceLaw : public Law {
 public:
  /// Force ON the coordinate, positive along it.
  virtual double force(const Motion& m, const double* state, const double* p) const = 0;
  virtual double stored_energy(const Motion& m, const double* state, const double* p) const;
  virtual double dissipated_power(const Motion& m, const double* state, const double* p) const;
  /// Is Motion::load the torque that the motor's gear passes on, not the one that the motor delivers?
  virtual bool feels_gear_load() const { return false; }
  /// d(state)/dt, state_count() values written to `rate`.
  virtual void state_rate(const Motion& m, const double* state, const double* p, double* rate) const;
  /// Switching functions: the law is smooth between their zeros. Appended to `g`; always the same number.
  virtual void switches(const Motion& m, const double* p, std::vector<double>& g) const;
  /// At the zeros of how many of them, the first ones, the force or its slope jumps so that a linearisation
  /// must not reach across: stops and play. Where the force itself jumps they are functions of the position
  /// and the parameters.
  virtual int jumps(const double* p) const;
};

/// From the held command to the torque that the motor delivers (command already in torque units).
class ActuatorLaw : public Law {
 public:
  virtual double torque(double commanded, const double* state, const double* p) const = 0;
  virtual void state_rate(double commanded, const double* state, const double* p, double* rate) const;
  /// State of equilibrium for a command held for ever (used at the start of a window).
  virtual void settle(double commanded, const double* p, double* state) const;
  /// Pure time delay of the command, s.
  virtual double delay(const double* p) const;
};

/// A change of the robot's constants.
struct StructureChange {
  double inertia = 0.0;                                   ///< added to the place's generalised inertia
  double mass = 0.0;                                      ///< added to the body, at its centre of mass, kg
  double payload = 0.0;                                   ///< a point mass carried by the body, kg
  Eigen::Vector3d payload_at = Eigen::Vector3d::Zero();   ///< where it hangs, in the body's frame, m
  Eigen::Vector3d com_shift = Eigen::Vector3d::Zero();    ///< of the body, in its frame, m
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();  ///< of its matter about its centre of mass
  Eigen::Vector3d tilt =
      Eigen::Vector3d::Zero();  ///< rotation vector applied to gravity in the world frame, rad
  double curvature = 0.0;       ///< of the base's ways, above 0 about a point to the left, 1/m
  double level = 0.0;           ///< height at which the upward way is straight, m
};

class StructureLaw : public Law {
 public:
  virtual StructureChange change(const double* p) const = 0;
};

/// What a sensor reads when the true value is `actual`.
class SensorLaw : public Law {
 public:
  virtual double reading(double actual, const double* p) const = 0;
};

/// When a contact switch reads what its foot does.
class SwitchLaw : public Law {
 public:
  /// How long after the foot has touched down (`closes`) or lifted off, s; linear in the parameters.
  virtual double lateness(bool closes, const double* p) const = 0;
};

/// "{force} s/{position}" with the units of a rotary or a linear place.
std::string unit_at(const std::string& general_unit, bool angular);

std::string to_string(Place place);

}  // namespace plumbline::effects
