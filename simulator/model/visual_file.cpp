#include <filesystem>

#include "simulator/model/mjcf_file.h"
#include "simulator/model/sdformat_access.h"
#include "simulator/model/visual.h"

namespace plumbline::model {
namespace {

namespace fs = std::filesystem;

constexpr int kFoldersUp = 4;

/// The path without a scheme; of model:// and package:// the name of the package is a folder too.
std::string plain_path(const std::string& uri) {
  const std::size_t scheme = uri.find("://");
  return scheme == std::string::npos ? uri : uri.substr(scheme + 3);
}

/// Beside the skeleton, then in the folders above it, each time with and without the first folder of the
/// path, which may be the package's own name. Where it is nowhere: beside the skeleton.
std::string find_file(const std::string& skeleton_file, const std::string& uri) {
  const fs::path path = plain_path(uri);
  const fs::path short_path = path.lexically_relative(*path.begin());
  const fs::path beside = fs::path(skeleton_file).parent_path();
  fs::path folder = beside;
  std::error_code none;
  for (int up = 0; up <= kFoldersUp; ++up) {
    for (const fs::path& tail : {path, short_path}) {
      const fs::path candidate = (folder / tail).lexically_normal();
      if (fs::is_regular_file(candidate, none)) {
        return candidate.string();
      }
    }
    folder /= "..";
  }
  return (beside / path).lexically_normal().string();
}

/// Nothing for a kind that is not understood.
std::optional<Shape> shape_of(const sdf::Geometry& geometry, const std::string& skeleton_file) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      return BoxShape{to_eigen(geometry.BoxShape()->Size())};
    case sdf::GeometryType::CYLINDER:
      return CylinderShape{geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length()};
    case sdf::GeometryType::SPHERE:
      return SphereShape{geometry.SphereShape()->Radius()};
    case sdf::GeometryType::ELLIPSOID:
      return EllipsoidShape{to_eigen(geometry.EllipsoidShape()->Radii())};
    case sdf::GeometryType::MESH:
      return MeshShape{find_file(skeleton_file, geometry.MeshShape()->Uri()),
                       to_eigen(geometry.MeshShape()->Scale())};
    default:
      return std::nullopt;
  }
}

void read_link(const sdf::Link& link, const SkeletonXml& xml, Visuals& visuals) {
  for (std::size_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& from = *link.VisualByIndex(i);
    const int line = xml.line_of_link(link.Name());
    const std::optional<Shape> shape = shape_of(*from.Geom(), xml.file());
    if (!shape) {
      visuals.left_out.push_back(xml.file() + ":" + std::to_string(line) + ": " + link.Name() + " " +
                                 from.Name() +
                                 ": found a shape that is not drawn, expected box, cylinder, sphere, "
                                 "ellipsoid or mesh");
      continue;
    }
    Visual visual{from.Name(), *shape, {}, {}, line};
    ignition::math::Pose3d pose;
    refuse_errors(from.SemanticPose().Resolve(pose, link.Name()), xml);
    visual.X_BV = to_eigen(pose);
    if (from.Material() != nullptr) {
      const ignition::math::Color color = from.Material()->Diffuse();
      visual.color = Eigen::Vector3d(color.R(), color.G(), color.B());
    }
    visuals.of_link[link.Name()].push_back(visual);
  }
}

}  // namespace

Visuals read_visuals(const std::string& skeleton_file) {
  if (is_mjcf(skeleton_file)) {
    return {};  // its shapes are not drawn: stand-ins are
  }
  SkeletonXml xml(skeleton_file);
  Visuals visuals;
  with_sdformat(xml, UrdfShapes::kept, [&](const LoadedSdf& loaded) {
    for (std::size_t i = 0; i < loaded.model.LinkCount(); ++i) {
      read_link(*loaded.model.LinkByIndex(i), xml, visuals);
    }
  });
  return visuals;
}

}  // namespace plumbline::model
