// Ground, grid and platforms. Included by the files of the painter only.
#pragma once

#include <vtkRenderer.h>

#include "simulator/render/painter.h"

namespace plumbline::render {

/// Draws the stage; the picture's background has the colour into which the ground fades.
void add_stage(const Stage& stage, vtkRenderer& renderer);
Color background_color();
Color shadow_color();
/// Height at which a shadow lies above the ground's surface, m.
double shadow_lift();

}  // namespace plumbline::render
