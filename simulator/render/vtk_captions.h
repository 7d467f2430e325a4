// Words and the key on the picture. Included by the files of the painter only.
#pragma once

#include <vtkActor2D.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <vector>

#include "simulator/render/painter.h"

namespace plumbline::render {

class CaptionActors {
 public:
  /// Sizes follow the picture's height.
  CaptionActors(vtkRenderer* renderer, int width, int height);
  void write(const Captions& captions);

 private:
  void add_text(const std::string& text, int x, int y, double size, bool bold, bool from_top);
  void write_key(const std::vector<KeyLine>& key, double letter, int margin);
  void add_swatch(const std::vector<Color>& colors, int x, int y, int width, int height);

  vtkRenderer* renderer_;
  int width_, height_;
  std::vector<vtkSmartPointer<vtkActor2D>> actors_;
};

}  // namespace plumbline::render
