// Pictures of snapshots. VTK is behind this door.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "simulator/render/figure.h"
#include "simulator/render/image.h"
#include "simulator/render/snapshot.h"
#include "simulator/render/view.h"

namespace plumbline::render {

/// A raised stretch of ground, m.
struct Step {
  double from, to, height;
};

/// What stands still.
struct Stage {
  bool ground = true;
  double height = 0.0;                               ///< of the ground, m
  std::vector<Step> steps;                           ///< platforms
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< around which the ground is drawn, m
  double reach = 3.0;                                ///< how far it is drawn at least, m
};

/// A line of the key: a colour (or a scale of colours) and what it stands for.
struct KeyLine {
  std::vector<Color> colors;
  std::string text;
};

/// What is written into the picture.
struct Captions {
  std::string title;
  std::vector<std::string> lines;  ///< under the title
  std::vector<std::string> notes;  ///< under these, smaller; broken where they would reach the middle
  std::vector<KeyLine> key;        ///< in the other corner
};

/// How quantities become lengths and colours.
struct Scales {
  double newtons_per_metre = 2000.0;  ///< of arrows
  double arrow = 1.0;                 ///< thickness of arrows, 1 for a robot of a person's size
  double stretch = 1.0;               ///< exaggeration of cable stretch
  double spring = 0.0;  ///< deflection of the full colour, rad or m; 0: springs are not coloured
};

/// Draws snapshots of one robot, all of one size. It needs a display: see VirtualDisplay. The same input
/// gives the same bytes.
class Painter {
 public:
  Painter(const Figure& figure, const Stage& stage, const Scales& scales, int width, int height);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// The model as `shot` and, unless null, the measured robot as a translucent ghost.
  Image paint(const Snapshot& shot, const Snapshot* ghost, const View& view, const Captions& captions);

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

/// The colours of springs: relaxed to fully deflected.
const std::vector<Color>& spring_colors();
Color ghost_color();
Color force_color();
Color stretch_color();

}  // namespace plumbline::render
