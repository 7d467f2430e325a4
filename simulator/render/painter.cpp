#include "simulator/render/painter.h"

#include <vtkCamera.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

#include "simulator/render/vtk_captions.h"
#include "simulator/render/vtk_marks.h"
#include "simulator/render/vtk_robot.h"
#include "simulator/render/vtk_stage.h"

namespace plumbline::render {
namespace {

constexpr double kGhost = 0.45;    // opacity of what is measured
constexpr int kSamples = 4;        // for smooth edges
constexpr double kBehind = 0.004;  // m
constexpr double kNear = 0.25;     // what is seen begins and ends here, in distances to the target
constexpr double kFar = 8.0;

void look(vtkRenderer& renderer, const View& view) {
  vtkCamera* camera = renderer.GetActiveCamera();
  camera->SetPosition(view.eye.data());
  camera->SetFocalPoint(view.target.data());
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(view.angle * 180.0 / M_PI);
  // Not further forward than needed: depth must tell a line on a surface from one a millimetre behind it.
  const double distance = (view.eye - view.target).norm();
  camera->SetClippingRange(kNear * distance, kFar * distance);
}

/// A hair further from the eye: what coincides with the model is hidden by it.
Snapshot behind(Snapshot shot, const View& view) {
  const Eigen::Vector3d away = kBehind * (view.target - view.eye).normalized();
  for (Eigen::Isometry3d& pose : shot.poses) {
    pose.pretranslate(away);
  }
  return shot;
}

}  // namespace

// Two layers: things, and above them marks and words. A ghost is not drawn translucent, which would show its
// inside: the picture is drawn with and without it, and both are mixed.
struct Painter::Scene {
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> things, marks;
  vtkNew<vtkLightKit> lights;
  RobotActors robot, ghost;
  CaptionActors captions;
  std::vector<ForceArrow> arrows;
  std::vector<StretchSector> sectors;
  Scales scales;
  int width, height;

  Scene(const Figure& figure, const Stage& stage, const Scales& how, int w, int h)
      : robot(figure, things),
        ghost(figure, things),
        captions(marks, w, h),
        scales(how),
        width(w),
        height(h) {
    window->SetOffScreenRendering(1);
    window->SetShowWindow(false);
    window->SetSize(w, h);
    window->SetMultiSamples(kSamples);
    window->SetNumberOfLayers(2);
    window->AddRenderer(things);
    window->AddRenderer(marks);
    marks->SetLayer(1);
    marks->SetActiveCamera(things->GetActiveCamera());
    lights->SetKeyLightIntensity(0.85);
    lights->SetKeyLightAngle(48.0, -28.0);
    lights->SetKeyToFillRatio(2.2);
    lights->SetKeyToBackRatio(3.0);
    lights->AddLightsToRenderer(things);
    lights->AddLightsToRenderer(marks);
    add_stage(stage, *things);
    ghost.become_ghost(ghost_color());
    if (stage.ground) {
      robot.add_shadow(stage.height + shadow_lift(), shadow_color(), things);
    }
  }

  Image picture(bool with_ghost) {
    ghost.show(with_ghost);
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels);
    Image image(width, height);
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    for (int y = 0; y < height; ++y) {
      const unsigned char* from = pixels->GetPointer(static_cast<vtkIdType>(row) * (height - 1 - y));
      std::copy(from, from + row, image.rgb.begin() + static_cast<std::ptrdiff_t>(row) * y);
    }
    return image;
  }

  void place_marks(const Snapshot& shot) {
    while (arrows.size() < shot.pushes.size()) {
      arrows.emplace_back(marks);
    }
    for (std::size_t f = 0; f < shot.pushes.size(); ++f) {
      arrows[f].place(shot.pushes[f], scales.newtons_per_metre, scales.arrow);
    }
    while (scales.stretch > 0.0 && sectors.size() < shot.stretches.size()) {
      sectors.emplace_back(marks);
    }
    for (std::size_t k = 0; k < sectors.size(); ++k) {
      sectors[k].place(shot.stretches[k], scales.stretch);
    }
  }
};

Painter::Painter(const Figure& figure, const Stage& stage, const Scales& scales, int width, int height)
    : scene_(std::make_unique<Scene>(figure, stage, scales, width, height)) {}
Painter::~Painter() = default;

Image Painter::paint(const Snapshot& shot, const Snapshot* ghost, const View& view,
                     const Captions& captions) {
  Scene& scene = *scene_;
  scene.robot.place(shot, scene.scales.spring);
  scene.place_marks(shot);
  scene.captions.write(captions);
  look(*scene.things, view);
  if (ghost == nullptr) {
    return scene.picture(false);
  }
  scene.ghost.place(behind(*ghost, view), 0.0);
  scene.ghost.hide_what_coincides(*ghost, shot);
  const Image with = scene.picture(true);
  return blend(with, scene.picture(false), kGhost);
}

const std::vector<Color>& spring_colors() {
  static const std::vector<Color> colors{Color(0.62, 0.64, 0.67), Color(0.75, 0.70, 0.50),
                                         Color(0.87, 0.76, 0.33), Color(0.98, 0.82, 0.15)};
  return colors;
}
Color ghost_color() { return {0.00, 0.62, 0.45}; }
Color force_color() { return {0.84, 0.30, 0.00}; }
Color stretch_color() { return {0.80, 0.40, 0.62}; }

}  // namespace plumbline::render
