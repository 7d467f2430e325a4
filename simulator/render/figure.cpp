#include "simulator/render/figure.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/mesh/mesh_file.h"

namespace plumbline::render {
namespace {

constexpr double kRodRadius = 0.02;             // m
constexpr double kDensityOfAluminium = 2700.0;  // kg/m^3

/// Solid ellipsoid: I_x = m (b^2 + c^2) / 5, and its volume from the density; the inertia gives the
/// proportions, the mass the size.
void add_ellipsoid(const model::Body& body, int index, const Color& color, std::vector<Part>& parts) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(body.inertia);
  const Eigen::Vector3d& I = principal.eigenvalues();
  const Eigen::Vector3d squares =
      (2.5 / body.mass * (Eigen::Vector3d::Constant(I.sum()) - 2.0 * I)).cwiseMax(1e-6);
  Eigen::Vector3d radii = squares.cwiseSqrt();
  const double volume = 4.0 / 3.0 * M_PI * radii.prod();
  radii *= std::cbrt(body.mass / kDensityOfAluminium / volume);
  Eigen::Matrix3d axes = principal.eigenvectors();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = axes;
  X.translation() = body.com;
  parts.push_back({index, X, model::EllipsoidShape{radii}, color});
}

void add_stand_in(const model::Skeleton& skeleton, const std::vector<Stick>& sticks, int body,
                  const Color& color, std::vector<Part>& parts) {
  const std::size_t before = parts.size();
  for (const Stick& stick : sticks) {
    if (stick.body == body) {
      add_rod(stick, kRodRadius, color, parts);
    }
  }
  const model::Body& it = skeleton.bodies[static_cast<std::size_t>(body)];
  if (parts.size() == before && it.mass > 0.0) {
    add_ellipsoid(it, body, color, parts);
  }
}

/// False where the visual's mesh cannot be used.
bool add_visual(const model::Visual& visual, int body, const Color& color, Figure& figure) {
  Part part;
  part.body = body;
  part.X_BP = visual.X_BV;
  part.color = visual.color.value_or(color);
  if (const auto* shape = std::get_if<model::MeshShape>(&visual.shape)) {
    mesh::MeshFile file = mesh::read_mesh(shape->file, shape->scale);
    if (!file.problem.empty()) {
      figure.messages.push_back(file.problem + "; a stand-in is drawn");
      return false;
    }
    part.solid = std::make_shared<const mesh::Mesh>(std::move(file.mesh));
  } else if (const auto* box = std::get_if<model::BoxShape>(&visual.shape)) {
    part.solid = *box;
  } else if (const auto* cylinder = std::get_if<model::CylinderShape>(&visual.shape)) {
    part.solid = *cylinder;
  } else if (const auto* sphere = std::get_if<model::SphereShape>(&visual.shape)) {
    part.solid = *sphere;
  } else if (const auto* ellipsoid = std::get_if<model::EllipsoidShape>(&visual.shape)) {
    part.solid = *ellipsoid;
  }
  figure.parts.push_back(part);
  return true;
}

Eigen::AlignedBox3d box_of(const Solid& solid) {
  const auto around = [](const Eigen::Vector3d& half) { return Eigen::AlignedBox3d(-half, half); };
  if (const auto* box = std::get_if<model::BoxShape>(&solid)) {
    return around(0.5 * box->size);
  }
  if (const auto* cylinder = std::get_if<model::CylinderShape>(&solid)) {
    return around({cylinder->radius, cylinder->radius, 0.5 * cylinder->length});
  }
  if (const auto* sphere = std::get_if<model::SphereShape>(&solid)) {
    return around(Eigen::Vector3d::Constant(sphere->radius));
  }
  if (const auto* ellipsoid = std::get_if<model::EllipsoidShape>(&solid)) {
    return around(ellipsoid->radii);
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : std::get<std::shared_ptr<const mesh::Mesh>>(solid)->points) {
    box.extend(point);
  }
  return box;
}

}  // namespace

Color palette(std::size_t index) {
  const std::array<Color, 7> colors{Color(0.00, 0.45, 0.70), Color(0.90, 0.62, 0.00), Color(0.00, 0.62, 0.45),
                                    Color(0.80, 0.47, 0.65), Color(0.34, 0.71, 0.91), Color(0.84, 0.37, 0.00),
                                    Color(0.60, 0.60, 0.60)};
  return colors[index % colors.size()];
}

void add_rod(const Stick& stick, double radius, const Color& color, std::vector<Part>& parts) {
  const Eigen::Vector3d along = stick.to - stick.from;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along).toRotationMatrix();
  X.translation() = 0.5 * (stick.from + stick.to);
  parts.push_back({stick.body, X, model::CylinderShape{radius, along.norm()}, color});
  for (const Eigen::Vector3d& end : {stick.from, stick.to}) {
    X.translation() = end;
    parts.push_back({stick.body, X, model::SphereShape{radius}, color});
  }
}

std::vector<Eigen::Vector3d> corners_of(const Part& part) {
  const Eigen::AlignedBox3d box = box_of(part.solid);
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(8);
  for (int k = 0; k < 8; ++k) {
    corners.push_back(part.X_BP * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
  }
  return corners;
}

Figure figure_of(const model::Model& model, const model::Visuals& visuals) {
  Figure figure;
  figure.messages = visuals.left_out;
  const std::vector<Stick> sticks = sticks_of(model);
  for (std::size_t b = 0; b < model.skeleton.bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    const auto found = visuals.of_link.find(model.skeleton.bodies[b].name);
    bool drawn = found != visuals.of_link.end();
    if (drawn) {
      for (const model::Visual& visual : found->second) {
        drawn = add_visual(visual, body, palette(b), figure) && drawn;
      }
    }
    if (!drawn) {
      add_stand_in(model.skeleton, sticks, body, palette(b), figure.parts);
    }
  }
  return figure;
}

}  // namespace plumbline::render
