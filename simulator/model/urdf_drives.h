// Which joints of a URDF have a drive, for a model that is made from the file: the skeleton has none.
#pragma once

#include <set>
#include <string>

namespace plumbline::model {

/// The joints that the file's <transmission> elements name; empty where it has none, and for other formats.
/// Both forms are read: <transmission><joint name="..."/>, and the older one with the joint's name in an
/// attribute. Source: ROS wiki, "urdf/XML/Transmission".
std::set<std::string> urdf_driven_joints(const std::string& path);

}  // namespace plumbline::model
