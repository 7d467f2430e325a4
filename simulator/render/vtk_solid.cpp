#include "simulator/render/vtk_solid.h"

#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

namespace plumbline::render {
namespace {

constexpr int kRound = 40;      // sides of a circle
constexpr double kEdge = 35.0;  // degrees

vtkSmartPointer<vtkPolyData> transformed(vtkPolyData* surface, vtkTransform* transform) {
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(surface);
  filter->SetTransform(transform);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> with_normals(vtkPolyData* surface) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(kEdge);
  normals->Update();
  return normals->GetOutput();
}

struct ToSurface {
  vtkSmartPointer<vtkPolyData> operator()(const model::BoxShape& box) const {
    vtkNew<vtkCubeSource> source;
    source->SetXLength(box.size.x());
    source->SetYLength(box.size.y());
    source->SetZLength(box.size.z());
    source->Update();
    return source->GetOutput();
  }
  vtkSmartPointer<vtkPolyData> operator()(const model::CylinderShape& cylinder) const {
    vtkNew<vtkCylinderSource> source;  // along y
    source->SetRadius(cylinder.radius);
    source->SetHeight(cylinder.length);
    source->SetResolution(kRound);
    source->Update();
    vtkNew<vtkTransform> upright;
    upright->RotateX(90.0);
    return transformed(source->GetOutput(), upright);
  }
  vtkSmartPointer<vtkPolyData> operator()(const model::SphereShape& sphere) const {
    return (*this)(model::EllipsoidShape{Eigen::Vector3d::Constant(sphere.radius)});
  }
  vtkSmartPointer<vtkPolyData> operator()(const model::EllipsoidShape& ellipsoid) const {
    vtkNew<vtkSphereSource> source;
    source->SetRadius(1.0);
    source->SetThetaResolution(kRound);
    source->SetPhiResolution(kRound / 2);
    source->Update();
    vtkNew<vtkTransform> scale;
    scale->Scale(ellipsoid.radii.data());
    return transformed(source->GetOutput(), scale);
  }
  vtkSmartPointer<vtkPolyData> operator()(const std::shared_ptr<const mesh::Mesh>& mesh) const {
    vtkNew<vtkPoints> points;
    for (const Eigen::Vector3d& point : mesh->points) {
      points->InsertNextPoint(point.data());
    }
    vtkNew<vtkCellArray> cells;
    for (const auto& [a, b, c] : mesh->triangles) {
      cells->InsertNextCell({a, b, c});
    }
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->SetPolys(cells);
    return with_normals(surface);
  }
};

}  // namespace

vtkSmartPointer<vtkPolyData> surface_of(const Solid& solid) { return std::visit(ToSurface(), solid); }

void copy_to(const Eigen::Matrix4d& X, vtkMatrix4x4& matrix) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      matrix.SetElement(i, j, X(i, j));
    }
  }
}

}  // namespace plumbline::render
