#include "simulator/render/vtk_stage.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace plumbline::render {
namespace {

constexpr double kFine = 0.1;       // m between lines
constexpr double kCoarse = 0.5;     // m between stronger lines
constexpr double kLayer = 0.0012;   // m between ground, grid and shadow
constexpr double kStepWidth = 0.8;  // m, of a platform

const Color kGround(0.905, 0.915, 0.925);
const Color kLine(0.62, 0.66, 0.70);

/// Points with colours, and cells over them. Nothing is translucent: that would cost as much as all the rest.
struct Sheet {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  Sheet() { colors->SetNumberOfComponents(3); }

  vtkIdType add(double x, double y, double z, const Color& color) {
    const Eigen::Matrix<unsigned char, 3, 1> rgb = (255.0 * color).array().round().cast<unsigned char>();
    colors->InsertNextTypedTuple(rgb.data());
    return points->InsertNextPoint(x, y, z);
  }
  vtkSmartPointer<vtkActor> actor(bool lines) const {
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    lines ? data->SetLines(cells) : data->SetPolys(cells);
    data->GetPointData()->SetScalars(colors);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    vtkSmartPointer<vtkActor> actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    return actor;
  }
};

/// 1 at the centre, 0 at the end of the ground.
double presence(double distance, double reach) {
  const double s = std::clamp((distance - 0.35 * reach) / (0.65 * reach), 0.0, 1.0);
  return 1.0 - s * s * (3.0 - 2.0 * s);
}

Color ground_color(double distance, double reach) {
  const double here = presence(distance, reach);
  return here * kGround + (1.0 - here) * background_color();
}

void add_floor(const Stage& stage, double reach, vtkRenderer& renderer) {
  constexpr int kRings = 24;
  constexpr int kSpokes = 72;
  Sheet sheet;
  for (int ring = 0; ring <= kRings; ++ring) {
    const double r = reach * ring / kRings;
    const Color color = ground_color(r, reach);
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double angle = 2.0 * M_PI * spoke / kSpokes;
      sheet.add(stage.center.x() + r * std::cos(angle), stage.center.y() + r * std::sin(angle),
                stage.height - 2.0 * kLayer, color);
    }
  }
  for (int ring = 0; ring < kRings; ++ring) {
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const int next = (spoke + 1) % kSpokes;
      sheet.cells->InsertNextCell({ring * kSpokes + spoke, ring * kSpokes + next, (ring + 1) * kSpokes + next,
                                   (ring + 1) * kSpokes + spoke});
    }
  }
  renderer.AddActor(sheet.actor(false));
}

/// One line in pieces, each fading on its own.
void add_line(Sheet& sheet, const Stage& stage, double reach, bool along_x, double at, double strength) {
  const int pieces = 40;
  const double across = along_x ? stage.center.y() : stage.center.x();
  const double middle = along_x ? stage.center.x() : stage.center.y();
  for (int k = 0; k <= pieces; ++k) {
    const double s = middle + reach * (2.0 * k / pieces - 1.0);
    const double distance = std::hypot(s - middle, at - across);
    const double here = strength * presence(distance, reach);
    const Color color = here * kLine + (1.0 - here) * ground_color(distance, reach);
    const vtkIdType id = sheet.add(along_x ? s : at, along_x ? at : s, stage.height - kLayer, color);
    if (k > 0) {
      sheet.cells->InsertNextCell({id - 1, id});
    }
  }
}

void add_grid(const Stage& stage, double reach, double distance, double strength, vtkRenderer& renderer) {
  Sheet sheet;
  for (const bool along_x : {true, false}) {
    const double middle = along_x ? stage.center.y() : stage.center.x();
    const auto first = static_cast<long>(std::ceil((middle - reach) / distance));
    const auto last = static_cast<long>(std::floor((middle + reach) / distance));
    for (long line = first; line <= last; ++line) {
      add_line(sheet, stage, reach, along_x, static_cast<double>(line) * distance, strength);
    }
  }
  const vtkSmartPointer<vtkActor> actor = sheet.actor(true);
  actor->GetProperty()->SetLineWidth(1.0F);
  renderer.AddActor(actor);
}

void add_step(const Stage& stage, const Step& step, vtkRenderer& renderer) {
  vtkNew<vtkCubeSource> box;
  const double low = std::min(stage.height, step.height) - (step.height < stage.height ? 0.0 : 0.02);
  const double high = std::max(stage.height, step.height);
  const double half = 0.5 * kStepWidth;
  box->SetBounds(step.from, step.to, stage.center.y() - half, stage.center.y() + half, low, high);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(box->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.80, 0.83, 0.86);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(kLine.x(), kLine.y(), kLine.z());
  actor->GetProperty()->SetAmbient(0.45);
  actor->GetProperty()->SetDiffuse(0.6);
  if (step.height < stage.height) {  // sunken ground shows as its outline
    actor->GetProperty()->SetRepresentationToWireframe();
  }
  renderer.AddActor(actor);
}

}  // namespace

Color background_color() { return {0.975, 0.98, 0.985}; }
Color shadow_color() { return {0.80, 0.815, 0.835}; }
double shadow_lift() { return 0.2 * kLayer; }

void add_stage(const Stage& stage, vtkRenderer& renderer) {
  const Color back = background_color();
  renderer.SetBackground(back.x(), back.y(), back.z());
  if (!stage.ground) {
    return;
  }
  const double reach = 1.6 * stage.reach;
  add_floor(stage, reach, renderer);
  if (reach < 8.0) {
    add_grid(stage, reach, kFine, 0.28, renderer);
  }
  add_grid(stage, reach, kCoarse, 0.55, renderer);
  for (const Step& step : stage.steps) {
    add_step(stage, step, renderer);
  }
}

}  // namespace plumbline::render
