// The key of a picture: what its colours and lengths stand for.
#pragma once

#include <vector>

#include "simulator/render/painter.h"
#include "simulator/render/snapshot.h"

namespace plumbline::render {

struct KeyContents {
  bool ghost = false, forces = false, stretches = false;
  const Snapshots* springs = nullptr;  ///< null: none is shown
};

std::vector<KeyLine> key_of(const Scales& scales, const KeyContents& contents);

/// "t = 1.203 s   phase II"
std::string time_line(const Snapshot& shot, const std::vector<std::string>& phase_names);

/// The largest of 1, 2, 5, 10, ... that is not above `value`; of 0.5, 0.2, ... below one.
double round_down(double value);

}  // namespace plumbline::render
