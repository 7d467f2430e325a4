// Solids as VTK's surfaces. Included by the files of the painter only.
#pragma once

#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>

#include "simulator/render/figure.h"

namespace plumbline::render {

/// With normals for smooth shading; edges sharper than 35 degrees stay edges.
vtkSmartPointer<vtkPolyData> surface_of(const Solid& solid);

void copy_to(const Eigen::Matrix4d& X, vtkMatrix4x4& matrix);

}  // namespace plumbline::render
