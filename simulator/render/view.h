// Where the camera stands.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/render/figure.h"
#include "simulator/render/snapshot.h"

namespace plumbline::render {

enum class Camera { side, follow, boom };

/// "side", "follow", "boom". Throws InputError for anything else.
Camera camera_named(const std::string& name);

struct View {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();     ///< m
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< m; up is +z
  double angle = 0.35;                               ///< of the picture's height, rad
};

/// A camera that keeps a motion in the picture.
///   side: stands still, looks along the axis about which most joints turn (along +y when there is none);
///   follow: the same, but goes and turns with the robot;
///   boom: stands still, from above and aside: the whole set-up with what is fixed to the world.
class Director {
 public:
  /// `width_to_height` is the picture's. The motion is looked at between `from` and `to`.
  Director(const Figure& figure, const model::Skeleton& skeleton, const Snapshots& motion, Camera camera,
           double width_to_height, double from, double to);

  View view(double time) const;
  /// A camera in this direction from which all points are in the picture, under the words.
  static View around(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& toward_eye,
                     double width_to_height);

 private:
  Eigen::Vector3d robot_place(double time) const;
  Eigen::Vector3d toward_eye(double time) const;

  const Snapshots& motion_;
  Camera camera_;
  int base_ = 0;                                      // the heaviest body that moves
  bool carried_ = false;                              // by something that turns about the vertical
  Eigen::Vector3d side_ = -Eigen::Vector3d::UnitY();  // toward the eye, in the base's heading
  View still_;
  double distance_ = 1.0, lift_ = 0.0;
};

/// All corners of all parts in the world.
std::vector<Eigen::Vector3d> world_corners(const Figure& figure, const Snapshot& shot);

}  // namespace plumbline::render
