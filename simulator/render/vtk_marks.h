// Arrows of ground forces and sectors of cable stretch. Included by the files of the painter only.
#pragma once

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "simulator/render/painter.h"

namespace plumbline::render {

/// An arrow from a foot along the ground's force, and a disc on the ground where the foot bears.
class ForceArrow {
 public:
  explicit ForceArrow(vtkRenderer* renderer);
  void place(const Push& push, double newtons_per_metre, double thickness);

 private:
  vtkSmartPointer<vtkActor> shaft_, head_, disc_;
  vtkSmartPointer<vtkMatrix4x4> shaft_pose_, head_pose_, disc_pose_;
};

/// A sector at a joint from where a rigid cable would hold the link to where it is; at a joint that slides, a
/// bar.
class StretchSector {
 public:
  explicit StretchSector(vtkRenderer* renderer);
  void place(const Stretch& stretch, double exaggeration);

 private:
  vtkSmartPointer<vtkPolyData> fill_, edge_;
};

}  // namespace plumbline::render
