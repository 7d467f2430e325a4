// A figure as VTK's actors, moved from snapshot to snapshot. Included by the files of the painter only.
#pragma once

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "simulator/render/painter.h"

namespace plumbline::render {

class RobotActors {
 public:
  RobotActors(const Figure& figure, vtkRenderer* renderer);

  /// Moves the parts; of springs the colour goes from the part's own to spring_colors().back() at `spring`.
  void place(const Snapshot& shot, double spring);
  /// All parts in one colour, without edges.
  void become_ghost(const Color& color);
  /// Parts whose body is where the other snapshot has it are not shown.
  void hide_what_coincides(const Snapshot& shot, const Snapshot& other);
  void show(bool visible);
  /// Where the robot keeps light from level ground at this height. Drawn as one flat colour.
  void add_shadow(double height, const Color& color, vtkRenderer* renderer);

 private:
  struct Item {
    int body;
    Eigen::Isometry3d X_BP;
    Color color;
    vtkSmartPointer<vtkActor> actor, edges, shadow;
    vtkSmartPointer<vtkMatrix4x4> pose, shadow_pose;
    bool hidden = false;
  };
  std::vector<Item> items_;
  Eigen::Matrix4d to_ground_ = Eigen::Matrix4d::Identity();
};

}  // namespace plumbline::render
