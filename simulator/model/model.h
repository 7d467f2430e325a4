// A robot as data: what model.yaml and the skeleton file say, validated. No physics here.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "contact/shapes.h"
#include "simulator/effects/catalogue.h"
#include "simulator/effects/law.h"
#include "simulator/model/arc.h"
#include "simulator/model/correlations.h"

namespace plumbline::model {

/// A number from a robot file, in SI, with its origin.
struct Quantity {
  double value = 0.0;
  double uncertainty = 0.0;  ///< one standard deviation, SI; 0: none stated
  std::string unit = "1";    ///< as written in the file
  std::string source;        ///< paper and table, or the reason of an assumption
  bool assumed = false;
  int line = 0;
};

enum class JointType { revolute, prismatic, fixed };

/// One rigid link. Mass properties in the body frame B; inertia about the centre of mass.
struct Body {
  std::string name;
  double mass = 0.0;
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      // p_BBcm_B
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // I_BBcm_B
  double mass_uncertainty = 0.0;                      ///< one standard deviation, kg
  bool is_between =
      false;  ///< without mass, inside a joint of several degrees of freedom; no place for effects
};

/// A joint from parent to child. parent == -1: the world. Child frame J sits on the child; the joint axis is
/// given in J; X_PJ is J's pose on the parent at zero position, X_CJ on the child.
struct Joint {
  std::string name;
  JointType type = JointType::fixed;
  int parent = -1;
  int child = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_CJ = Eigen::Isometry3d::Identity();
  Arc arc;  ///< of a prismatic joint, in J
  /// What the skeleton file itself says under <dynamics>: N m s/rad and N m (N s/m and N); 0: nothing.
  double damping = 0.0, friction = 0.0;
  double armature = 0.0;   ///< MJCF: inertia of the rotor seen at the joint, kg m^2 or kg
  double reference = 0.0;  ///< MJCF's ref: its position in the file's pose, rad or m
  double stiffness = 0.0;  ///< MJCF: of a spring at the joint, N m/rad or N/m
  double rest = 0.0;       ///< of that spring (springref), rad or m
  bool floats = false;     ///< one of the six of a free joint (joint_chain.h): nothing drives it
  std::string mimics{};    ///< URDF's <mimic>: position = follows * position of that joint; "": of none
  double follows = 0.0;
};

/// A sphere of the skeleton file that may touch the ground, on a body (index), its centre in the body's
/// frame. Of a capsule one of its two ends: on a plane nothing else of it can touch.
struct ContactSphere {
  std::string name;
  int body = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< m
  double radius = 0.0;                               ///< m
  std::string shape{};                               ///< the capsule it is an end of; empty: a sphere
};

/// One end of a loop: a point of a link, or of the world (body -1).
struct LoopEnd {
  int body = -1;                                       ///< index in Skeleton::bodies; -1: the world
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< in the body's frame, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< of a hinge (its z) and a weld, in the body's frame
};

/// What closes a chain of joints that the tree leaves open:
///   connect  the two points coincide, p_1 = p_2;
///   hinge    the points coincide and the ends' z axes are parallel;
///   weld     the points and all three axes of the ends coincide;
///   rod      a rod without mass keeps the points apart, |p_2 - p_1| = length.
struct Loop {
  enum class Type { connect, hinge, weld, rod } type = Type::connect;
  std::string name;
  std::array<LoopEnd, 2> ends;
  double length = 0.0;  ///< of a rod, m
  std::string file{};   ///< that states it, and where
  int line = 0;
};

struct Skeleton {
  std::string file;
  std::vector<Body> bodies;   ///< parents before children
  std::vector<Joint> joints;  ///< one for each body (bodies fixed to the world have a fixed joint)
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.80665);
  std::vector<std::string> left_out{};  ///< what the file says and nobody takes over, a sentence each
  /// Joints (indices) that are the pitch of a free or ball joint: a state near +-90 degrees is refused.
  std::vector<int> charts{};
  std::vector<ContactSphere> spheres{};  ///< MJCF: geoms that may touch the ground
  std::vector<Loop> loops{};             ///< that the file itself closes

  /// Is a body free to turn in all ways?
  bool floats() const { return !charts.empty(); }
};

/// factor * (joint, pulley or coordinate position)
struct Term {
  std::string of;
  double factor = 1.0;
};

/// A named scalar: sum of terms over joints and pulleys. Joints that model.yaml does not name are not places
/// for effects.
struct Coordinate {
  std::string name;
  bool angular = true;
  std::vector<Term> terms;
};

struct Motor {
  std::string name;
  bool angular = true;
  Quantity rotor_inertia;            ///< kg m^2 or kg
  Quantity torque_constant;          ///< torque (or force) per command unit; 1 when the command is a torque
  Quantity factory_torque_constant;  ///< what the manufacturer states; value 0: not given
  Quantity torque_limit;             ///< N m or N; value 0: none
  std::string command_unit = "N m";
};

/// A pulley that turns on its own axis relative to its mount: a position and an inertia of its own, no
/// command. A place for the effects of coordinates.
struct Pulley {
  std::string name;
  Quantity inertia;  ///< kg m^2
};

/// position(motor) = sum ratio_i * position(coordinate_i); rigid unless an effect releases it.
/// Named by the coordinate it mainly drives (the first).
struct Ratio {
  std::string name;   ///< == to.front().of
  std::string motor;  ///< motor, pulley or joint on the left-hand side
  std::vector<Term> to;
  std::vector<Quantity> ratios;
};

/// A further inertia that turns with a coordinate or motor (pulleys).
struct Inertia {
  std::string name;
  std::string at;
  Quantity value;
};

/// A point of a link that may meet the ground, or a sphere about it: what touches is then the centre less the
/// radius along the ground's normal, another point of the link as it rolls.
struct Foot {
  std::string name;
  int body = 0;                                     ///< index in Skeleton::bodies
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // p_BF_B
  std::string source;
  double radius = 0.0;  ///< m; 0: a point
  std::string group;    ///< feet that share their laws, by the group's name; empty: it has its own

  /// Does an effect at `place` act on this foot?
  bool answers_to(const std::string& place) const { return place == (group.empty() ? name : group); }
};

/// One of two links that may meet: its shape, in the link's frame (m); of the world in the world's.
struct ContactEnd {
  int body = -1;  ///< index in Skeleton::bodies; -1: the world
  contact::Shape shape;
};

/// A pair of links, or a link and the world, that may meet: a place for the laws of feet. Only pairs that are
/// listed do.
struct LinkContact {
  std::string name;
  std::array<ContactEnd, 2> ends;
  std::string source;
};

/// A use of an effect: a law, its place and its values.
struct EffectUse {
  std::shared_ptr<const effects::Law> law;
  std::string at;
  std::vector<Quantity> values;  ///< in the law's parameter order
  int line = 0;

  effects::Values numbers() const;
  std::string label() const;  ///< "viscous at mLA"
};

/// What is measured at a point of a link, a vector of three components (point_sensors.h).
enum class PointReading { none, marker, orientation, gyroscope, accelerometer };

/// One measured channel: a position, its rate (tachometer, gyroscope of one axis), the vertical force of the
/// ground on some feet (a force plate), or a component of what is measured at a point of a link.
struct Sensor {
  std::string name;
  std::string measures;   ///< coordinate, motor or pulley; of a force plate empty
  double resolution = 0;  ///< position (rate, force) per count, SI; 0: continuous
  double offset = 0;      ///< SI
  double noise = 0;       ///< standard deviation, SI
  std::string source;
  std::vector<int> feet{};  ///< that stand on the force plate, indices in Model::feet; else empty
  bool rate = false;        ///< it shows the rate of change of what it measures
  PointReading reading = PointReading::none;
  int axis = 0;                                            ///< of a point's reading: 0 to 2 for x to z
  int body = -1;                                           ///< index in Skeleton::bodies
  Eigen::Vector3d point = Eigen::Vector3d::Zero();         ///< p_BS_B, m
  Eigen::Matrix3d mounting = Eigen::Matrix3d::Identity();  ///< R_BS, the sensor's axes on the link
  std::string group{};                                     ///< what it is a component of, by its name
  bool is_force_plate() const { return !feet.empty(); }
  bool is_at_point() const { return reading != PointReading::none; }
  /// Of a coordinate, motor, pulley or joint: a line in the positions.
  bool shows_position() const { return !rate && feet.empty() && !is_at_point(); }
  /// Where a link is: no line in the positions, but positions follow from it.
  bool shows_pose() const { return reading == PointReading::marker || reading == PointReading::orientation; }
  /// Residual that the sensor alone would leave: sqrt(resolution^2/12 + noise^2).
  double floor() const;
};

/// A switch that is closed (1) while a foot is in the ground, else open (0); a real one when the ground's
/// force is above a threshold, late, and with contacts that bounce.
struct ContactSwitch {
  std::string name;
  int foot = 0;  ///< index in Model::feet
  std::string source;
  double threshold = 0.0;             ///< vertical force above which it is closed, N; 0: at the surface
  double closes_late = 0.0;           ///< s from the force to the reading, when it closes
  double opens_late = 0.0;            ///< s, when it opens
  double lateness_uncertainty = 0.0;  ///< one standard deviation of either, s
  double bounce = 0.02;               ///< a reading that changes back within this time is no event, s
};

/// A coordinate or motor held at a value by hand or by a clamp.
struct Lock {
  std::string at;
  double value = 0.0;
};

struct Model {
  std::string file;  ///< the file the user named
  std::string robot;
  std::vector<std::string> lineage;  ///< files from the first model to this one (overlays)
  Skeleton skeleton;
  std::vector<Coordinate> coordinates;
  std::vector<Motor> motors;
  std::vector<Pulley> pulleys;
  std::vector<Ratio> ratios;
  std::vector<Inertia> inertias;
  std::vector<Foot> feet;
  std::vector<LinkContact> contacts;
  std::vector<Loop> loops;       ///< the skeleton's and the model's own
  std::vector<Lock> loops_near;  ///< positions of joints near which the loops are closed first
  std::vector<EffectUse> effects;
  Correlations correlations;  ///< of what is stated of the effects' values
  std::vector<Sensor> sensors;
  std::vector<ContactSwitch> switches;  ///< among the file's sensors, but they measure no position

  const Coordinate* find_coordinate(const std::string& name) const;
  const Motor* find_motor(const std::string& name) const;
  const Pulley* find_pulley(const std::string& name) const;
  const Sensor* find_sensor(const std::string& name) const;
  const Ratio* find_ratio(const std::string& name) const;
  const Loop* find_rod(const std::string& name) const;  ///< a loop that a rod closes
  const ContactSwitch* find_switch(const std::string& name) const;
  int body_index(const std::string& name) const;    ///< -1
  int motor_index(const std::string& name) const;   ///< -1
  int sensor_index(const std::string& name) const;  ///< -1
  bool has_force_plate() const;
  bool has(PointReading reading) const;
  /// Names of the places where a law may sit, in file order.
  std::vector<std::string> places(effects::Place place) const;
  /// Rotary (true) or linear place; bodies, sensors and world count as rotary except sensors of linear
  /// coordinates.
  bool place_is_angular(effects::Place place, const std::string& at) const;
  /// The place type that `at` has for this law (first of the law's places where the name is known).
  /// Throws InputError with the nearest names when there is none.
  effects::Place resolve(const effects::Law& law, const std::string& at) const;
};

}  // namespace plumbline::model
