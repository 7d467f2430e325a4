#include "simulator/render/vtk_robot.h"

#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>

#include "simulator/render/vtk_solid.h"

namespace plumbline::render {
namespace {

constexpr double kSharp = 40.0;      // degrees
constexpr double kSamePoint = 1e-6;  // m
constexpr double kSamePlace = 1e-9;  // m, and rad: what stands still, not what moves alike

void make_matter(vtkProperty& property, const Color& color) {
  property.SetColor(color.x(), color.y(), color.z());
  property.SetInterpolationToPhong();
  property.SetAmbient(0.22);
  property.SetDiffuse(0.78);
  property.SetSpecular(0.22);
  property.SetSpecularPower(28.0);
}

/// The sharp edges as thin lines of a darker shade: an illustration, not a photograph.
vtkSmartPointer<vtkActor> edges_of(vtkPolyData* surface, const Color& color) {
  vtkNew<vtkCleanPolyData> joined;  // surfaces for shading are cut along their edges
  joined->SetInputData(surface);
  joined->SetAbsoluteTolerance(kSamePoint);
  joined->ToleranceIsAbsoluteOn();
  vtkNew<vtkFeatureEdges> sharp;
  sharp->SetInputConnection(joined->GetOutputPort());
  sharp->SetFeatureAngle(kSharp);
  sharp->BoundaryEdgesOff();
  sharp->NonManifoldEdgesOff();
  sharp->ManifoldEdgesOff();
  sharp->ColoringOff();
  sharp->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(sharp->GetOutput());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  const Color dark = 0.62 * color;
  actor->GetProperty()->SetColor(dark.x(), dark.y(), dark.z());
  actor->GetProperty()->LightingOff();
  return actor;
}

/// Where parallel light that falls along `light` carries a point onto z = height.
Eigen::Matrix4d projection(double height, const Eigen::Vector3d& light) {
  Eigen::Matrix4d P = Eigen::Matrix4d::Identity();
  P(0, 2) = -light.x() / light.z();
  P(1, 2) = -light.y() / light.z();
  P(0, 3) = -P(0, 2) * height;
  P(1, 3) = -P(1, 2) * height;
  P(2, 2) = 0.0;
  P(2, 3) = height;
  return P;
}

}  // namespace

RobotActors::RobotActors(const Figure& figure, vtkRenderer* renderer) {
  for (const Part& part : figure.parts) {
    Item item{part.body, part.X_BP, part.color, {}, {}, {}, {}, {}};
    const vtkSmartPointer<vtkPolyData> surface = surface_of(part.solid);
    const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
    mapper->SetInputData(surface);
    mapper->ScalarVisibilityOff();
    item.actor = vtkSmartPointer<vtkActor>::New();
    item.actor->SetMapper(mapper);
    make_matter(*item.actor->GetProperty(), part.color);
    item.pose = vtkSmartPointer<vtkMatrix4x4>::New();
    item.actor->SetUserMatrix(item.pose);
    item.edges = edges_of(surface, part.color);
    item.edges->SetUserMatrix(item.pose);
    renderer->AddActor(item.actor);
    renderer->AddActor(item.edges);
    items_.push_back(item);
  }
}

void RobotActors::place(const Snapshot& shot, double spring) {
  for (Item& item : items_) {
    const auto body = static_cast<std::size_t>(item.body);
    const Eigen::Matrix4d X = (shot.poses[body] * item.X_BP).matrix();
    copy_to(X, *item.pose);
    if (item.shadow != nullptr) {
      copy_to(to_ground_ * X, *item.shadow_pose);
    }
    if (spring > 0.0 && body < shot.spring.size()) {
      const double share = std::clamp(shot.spring[body] / spring, 0.0, 1.0);
      const Color color = (1.0 - share) * item.color + share * spring_colors().back();
      item.actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
    }
  }
}

void RobotActors::become_ghost(const Color& color) {
  for (Item& item : items_) {
    item.actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
    item.edges->VisibilityOff();
  }
}

void RobotActors::hide_what_coincides(const Snapshot& shot, const Snapshot& other) {
  for (Item& item : items_) {
    const auto body = static_cast<std::size_t>(item.body);
    item.hidden = (shot.poses[body].matrix() - other.poses[body].matrix()).norm() < kSamePlace;
  }
}

void RobotActors::show(bool visible) {
  for (Item& item : items_) {
    item.actor->SetVisibility(visible && !item.hidden ? 1 : 0);
  }
}

void RobotActors::add_shadow(double height, const Color& color, vtkRenderer* renderer) {
  to_ground_ = projection(height, {-0.30, 0.38, -1.0});
  for (Item& item : items_) {
    item.shadow = vtkSmartPointer<vtkActor>::New();
    item.shadow->SetMapper(item.actor->GetMapper());
    item.shadow->GetProperty()->SetColor(color.x(), color.y(), color.z());
    item.shadow->GetProperty()->LightingOff();
    item.shadow_pose = vtkSmartPointer<vtkMatrix4x4>::New();
    item.shadow->SetUserMatrix(item.shadow_pose);
    renderer->AddActor(item.shadow);
  }
}

}  // namespace plumbline::render
