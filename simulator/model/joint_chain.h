// Joints of several degrees of freedom as chains of joints of one each.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::model {

/// One joint of a chain, in the frame J of the joint that the chain stands for.
struct ChainAxis {
  std::string name;
  JointType type = JointType::revolute;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  bool is_pitch = false;  ///< the middle one of yaw, pitch and roll: singular at +-90 degrees
};

/// Six degrees of freedom: p_PB = (x, y, z) along the parent's axes, then R_PB = Rz(yaw) Ry(pitch) Rx(roll),
/// turns about z, the new y and the new x. Named PREFIX_x, _y, _z, _yaw, _pitch and _roll.
std::vector<ChainAxis> free_chain(const std::string& prefix);
/// The three turns of free_chain alone.
std::vector<ChainAxis> ball_chain(const std::string& prefix);
/// A turn about `first`, then one about `second`, which the first carries along: PREFIX_1 and PREFIX_2.
std::vector<ChainAxis> universal_chain(const std::string& prefix, const Eigen::Vector3d& first,
                                       const Eigen::Vector3d& second);
/// Two ways in the plane across `normal` and a turn about it: PREFIX_x, PREFIX_y and PREFIX_turn. With the
/// normal along z the ways are x and y.
std::vector<ChainAxis> planar_chain(const std::string& prefix, const Eigen::Vector3d& normal);

/// The prefix of a free joint: "base" for the first on the world, whatever it is called in the file;
/// else its own name.
std::string free_prefix(const Skeleton& skeleton, bool on_world, const std::string& own);

/// Appends `body` behind the chain. `ends` has the parent and the poses of the joint's frame on parent and
/// body (X_PJ, X_CJ); between the axes stand bodies without mass, named BODY_of_JOINT. Throws InputError when
/// a name of the chain is taken.
void append_chain(Skeleton& skeleton, const Body& body, const Joint& ends,
                  const std::vector<ChainAxis>& axes);

/// Makes the skeleton float: the one body that is fixed to the world gets a free joint in the place of that
/// weld (coordinates base_x to base_roll, its place in the world whatever pose the file gives it). Returns
/// false, and changes nothing, when not exactly one body hangs on the world or that one by another joint.
bool free_base(Skeleton& skeleton);

/// Two joints of one name: throws InputError.
void check_joint_names(const Skeleton& skeleton);

/// No motion may begin below this |cos(pitch)|: yaw and roll are all but one turn there.
constexpr double kLeastCosineOfPitch = 0.05;
/// And none may go on below this one: rates grow as its reciprocal. Between the two a motion passes, with
/// small steps; searches of initial states come there on their way.
constexpr double kLostCosineOfPitch = 1e-3;

/// Why a chart's pitch (rad) is refused where |cos(pitch)| has to be at least `least`: what was found, and
/// what to do about it. Empty where it is not.
std::string chart_refusal(const std::string& joint, double pitch, double least);

}  // namespace plumbline::model
