// What every use of libsdformat here needs: quiet, one at a time, errors as InputError, numbers as Eigen's.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <sdf/sdf.hh>
#include <string>

#include "simulator/model/skeleton_xml.h"

namespace plumbline::model {

/// Throws the first of `errors` as InputError, with the part of the file that it speaks of.
void refuse_errors(const sdf::Errors& errors, const SkeletonXml& xml);

Eigen::Isometry3d to_eigen(const ignition::math::Pose3d& pose);
Eigen::Vector3d to_eigen(const ignition::math::Vector3d& v);
/// Its symmetric part: an inertia.
Eigen::Matrix3d to_eigen(const ignition::math::Matrix3d& m);

/// A loaded file and its one model.
struct LoadedSdf {
  const sdf::World* world;  ///< null without one
  const sdf::Model& model;
};

/// Loads the file with libsdformat and hands it to `use`. Whatever libsdformat throws becomes an InputError.
void with_sdformat(SkeletonXml& xml, UrdfShapes shapes, const std::function<void(const LoadedSdf&)>& use);

}  // namespace plumbline::model
