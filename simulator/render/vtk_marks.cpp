#include "simulator/render/vtk_marks.h"

#include <vtkCellArray.h>
#include <vtkConeSource.h>
#include <vtkCylinderSource.h>
#include <vtkDiskSource.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/render/vtk_solid.h"

namespace plumbline::render {
namespace {

constexpr double kShaft = 0.009;  // m, radius
constexpr double kHead = 0.07;    // m, length
constexpr double kHeadRadius = 0.026;
constexpr double kDisc = 0.045;      // m, radius
constexpr double kLeastForce = 1.0;  // N: below, nothing is drawn
constexpr int kPieces = 32;          // of a sector
constexpr double kSeen = 0.02;       // rad: a narrower sector is a line already
constexpr double kBarWidth = 0.03;   // m

vtkSmartPointer<vtkActor> actor_of(vtkPolyData* data, const Color& color, vtkRenderer* renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkSmartPointer<vtkActor> actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
  renderer->AddActor(actor);
  return actor;
}

template <class Source>
vtkSmartPointer<vtkPolyData> made(Source& source) {
  source.Update();
  return source.GetOutput();
}

/// z along `direction`, at `origin`, z stretched by `length`.
Eigen::Matrix4d along(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double length) {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X.topLeftCorner<3, 3>() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), direction).toRotationMatrix();
  X.block<3, 1>(0, 2) *= length;
  X.block<3, 1>(0, 3) = origin;
  return X;
}

/// VTK's cylinders lie along y about their middle; these stand on z = 0.
Eigen::Matrix4d standing() {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  X(2, 3) = 0.5;
  return X;
}

}  // namespace

ForceArrow::ForceArrow(vtkRenderer* renderer) {
  vtkNew<vtkCylinderSource> cylinder;
  cylinder->SetRadius(kShaft);
  cylinder->SetHeight(1.0);
  cylinder->SetResolution(24);
  vtkNew<vtkConeSource> cone;
  cone->SetDirection(0.0, 0.0, 1.0);
  cone->SetCenter(0.0, 0.0, 0.5 * kHead);
  cone->SetHeight(kHead);
  cone->SetRadius(kHeadRadius);
  cone->SetResolution(32);
  vtkNew<vtkDiskSource> disk;
  disk->SetInnerRadius(0.6 * kDisc);
  disk->SetOuterRadius(kDisc);
  disk->SetCircumferentialResolution(48);
  shaft_ = actor_of(made(*cylinder), force_color(), renderer);
  head_ = actor_of(made(*cone), force_color(), renderer);
  disc_ = actor_of(made(*disk), force_color(), renderer);
  shaft_pose_ = vtkSmartPointer<vtkMatrix4x4>::New();
  head_pose_ = vtkSmartPointer<vtkMatrix4x4>::New();
  disc_pose_ = vtkSmartPointer<vtkMatrix4x4>::New();
  shaft_->SetUserMatrix(shaft_pose_);
  head_->SetUserMatrix(head_pose_);
  disc_->SetUserMatrix(disc_pose_);
  for (vtkActor* actor : {shaft_.Get(), head_.Get(), disc_.Get()}) {
    actor->GetProperty()->SetAmbient(0.5);
    actor->GetProperty()->SetDiffuse(0.6);
    actor->VisibilityOff();
  }
}

void ForceArrow::place(const Push& push, double newtons_per_metre, double thickness) {
  const double size = push.force.norm();
  const int visible = size > kLeastForce ? 1 : 0;
  for (vtkActor* actor : {shaft_.Get(), head_.Get(), disc_.Get()}) {
    actor->SetVisibility(visible);
  }
  if (visible == 0) {
    return;
  }
  const double length = size / newtons_per_metre;
  const double head = std::min(thickness * kHead, 0.5 * length);
  const Eigen::Vector3d direction = push.force / size;
  Eigen::Matrix4d shaft = along(push.point, direction, length - head);
  shaft.leftCols<2>() *= thickness;
  copy_to(shaft * standing(), *shaft_pose_);
  Eigen::Matrix4d tip = along(push.point + (length - head) * direction, direction, 1.0);
  tip.topLeftCorner<3, 3>() *= head / kHead;
  copy_to(tip, *head_pose_);
  Eigen::Matrix4d disc = along(push.point, Eigen::Vector3d::UnitZ(), 1.0);
  disc.leftCols<2>() *= thickness;
  copy_to(disc, *disc_pose_);
}

StretchSector::StretchSector(vtkRenderer* renderer)
    : fill_(vtkSmartPointer<vtkPolyData>::New()), edge_(vtkSmartPointer<vtkPolyData>::New()) {
  const vtkSmartPointer<vtkActor> fill = actor_of(fill_, stretch_color(), renderer);
  fill->GetProperty()->LightingOff();
  fill->GetProperty()->SetOpacity(0.75);
  const vtkSmartPointer<vtkActor> edge = actor_of(edge_, 0.6 * stretch_color(), renderer);
  edge->GetProperty()->LightingOff();
  edge->GetProperty()->SetLineWidth(2.0F);
}

void StretchSector::place(const Stretch& stretch, double exaggeration) {
  const double amount = exaggeration * stretch.amount;
  vtkNew<vtkPoints> points;
  const auto add = [&](const Eigen::Vector3d& p_J) {
    const Eigen::Vector3d p = stretch.X_WJ * p_J;
    return points->InsertNextPoint(p.data());
  };
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkCellArray> lines;
  if (stretch.turns) {
    const double radius = 0.9 * stretch.link;
    const double sweep = std::clamp(amount, -M_PI, M_PI);
    const vtkIdType center = add(Eigen::Vector3d::Zero());
    for (int k = 0; k <= kPieces; ++k) {
      const double angle = -sweep * k / kPieces;
      const vtkIdType id = add(radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
      if (k > 0) {
        cells->InsertNextCell({center, id - 1, id});
      }
    }
    if (std::abs(sweep) > kSeen) {
      lines->InsertNextCell({center, center + 1 + kPieces});
    }
  } else {
    const std::array<Eigen::Vector3d, 4> corners{
        Eigen::Vector3d(kBarWidth, 0.0, 0.0), Eigen::Vector3d(kBarWidth, 0.0, -amount),
        Eigen::Vector3d(-kBarWidth, 0.0, -amount), Eigen::Vector3d(-kBarWidth, 0.0, 0.0)};
    for (const Eigen::Vector3d& corner : corners) {
      add(corner);
    }
    cells->InsertNextCell({0, 1, 2, 3});
    lines->InsertNextCell({1, 2});
  }
  fill_->SetPoints(points);
  fill_->SetPolys(cells);
  edge_->SetPoints(points);
  edge_->SetLines(lines);
}

}  // namespace plumbline::render
