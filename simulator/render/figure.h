// What a robot looks like: solids that ride on its bodies.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "simulator/mesh/mesh.h"
#include "simulator/model/model.h"
#include "simulator/model/visual.h"
#include "simulator/render/sticks.h"

namespace plumbline::render {

using Color = Eigen::Vector3d;  ///< red, green, blue, 0 to 1
using Solid = std::variant<model::BoxShape, model::CylinderShape, model::SphereShape, model::EllipsoidShape,
                           std::shared_ptr<const mesh::Mesh>>;

struct Part {
  int body = 0;  ///< index among the bodies whose poses a snapshot has
  Eigen::Isometry3d X_BP = Eigen::Isometry3d::Identity();
  Solid solid;
  Color color = Color::Constant(0.6);
};

struct Figure {
  std::vector<Part> parts;
  std::vector<std::string> messages;  ///< what could not be drawn as the file says, one line each
};

/// Every body's visuals. A mesh that cannot be used, and a body without visuals, is drawn as its sticks; one
/// without sticks that has a mass as the solid ellipsoid of the same mass, centre and inertia, of
/// the density of aluminium.
Figure figure_of(const model::Model& model, const model::Visuals& visuals);

/// A rod with round ends.
void add_rod(const Stick& stick, double radius, const Color& color, std::vector<Part>& parts);

/// Corners of a box around the part, in the body's frame (eight points).
std::vector<Eigen::Vector3d> corners_of(const Part& part);

/// Colours that people with any colour vision tell apart (Okabe and Ito, 2008), by number.
Color palette(std::size_t index);

}  // namespace plumbline::render
