// A display to draw on where there is none.
#pragma once

#include <memory>
#include <string>

#include "simulator/render/child_process.h"

namespace plumbline::render {

/// VTK's windows need an X server, also for pictures in memory. When DISPLAY names one that answers, this
/// does nothing; else it starts an Xvfb on a free number, sets DISPLAY to it, and ends it and restores
/// DISPLAY in the destructor. Throws std::runtime_error when there is no Xvfb.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  std::unique_ptr<ChildProcess> server_;
  std::string before_;
  bool was_set_ = false;
};

}  // namespace plumbline::render
