// What a skeleton file says about how its links look. The physics never reads this.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plumbline::model {

/// Centred on its frame; edges along x, y, z, m.
struct BoxShape {
  Eigen::Vector3d size;
};
/// Centred on its frame, axis along z, m.
struct CylinderShape {
  double radius, length;
};
struct SphereShape {
  double radius;
};
/// Centred on its frame; semi-axes along x, y, z, m.
struct EllipsoidShape {
  Eigen::Vector3d radii;
};
/// A file with triangles; `scale` makes metres of its units, axis by axis.
struct MeshShape {
  std::string file;
  Eigen::Vector3d scale;
};
using Shape = std::variant<BoxShape, CylinderShape, SphereShape, EllipsoidShape, MeshShape>;

/// One shape of a link.
struct Visual {
  std::string name;
  Shape shape;
  Eigen::Isometry3d X_BV = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Vector3d> color;  ///< red, green, blue, 0 to 1
  int line = 0;                          ///< of the link in the skeleton file
};

struct Visuals {
  std::map<std::string, std::vector<Visual>> of_link;
  std::vector<std::string> left_out;  ///< shapes that are not understood, one line for each
};

/// The <visual> elements of an .sdf or .urdf: box, cylinder, sphere, ellipsoid and mesh; the rest is
/// reported in `left_out`. A mesh's file is looked for beside the skeleton and in the folders above it;
/// `model://` and `package://` may stand before its path. Whether it is there is not checked. Throws
/// InputError as read_skeleton does.
Visuals read_visuals(const std::string& skeleton_file);

}  // namespace plumbline::model
