// What drives the joints of a robot file, and how well its sensors read them: for a model that is made from
// the file. The skeleton itself has neither.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace plumbline::model {

/// An actuator on one joint. MuJoCo's force on the joint is gear * (gain * control + bias), bias = b0 + b1 q
/// + b2 v of an affine one.
struct MjcfActuator {
  std::string name;  ///< empty: none given
  std::string joint;
  std::string kind;                       ///< element: motor, position, velocity, general, ...
  double limit = 0.0;                     ///< of the torque or force on the joint, N m or N; 0: none stated
  double stiffness = 0.0, damping = 0.0;  ///< of a servo: -gear b1, -gear b2, N m/rad and N m s/rad
};

struct MjcfDrives {
  std::vector<MjcfActuator> actuators;
  std::map<std::string, double> position_noise;  ///< by joint: deviation of its jointpos sensor, rad or m
};

/// Source: MuJoCo documentation, "XML Reference", version 2.2, `actuator` and `sensor`. An actuator of a
/// tendon, a site or a slider-crank drives no single joint and is passed over. Throws InputError (file, line,
/// element) for a joint that is not there, and for numbers that are none.
MjcfDrives read_mjcf_drives(const std::string& path);

/// The joints that the file's <transmission> elements name; empty where it has none, and for other formats.
/// Both forms are read: <transmission><joint name="..."/>, and the older one with the joint's name in an
/// attribute. Source: ROS wiki, "urdf/XML/Transmission".
std::set<std::string> urdf_driven_joints(const std::string& path);

}  // namespace plumbline::model
