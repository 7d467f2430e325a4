#include "simulator/render/virtual_display.h"

#include <X11/Xlib.h>

#include <cstdlib>
#include <stdexcept>

namespace plumbline::render {
namespace {

constexpr double kPatience = 20.0;  // s, for a busy machine

bool answers(const char* name) {
  Display* display = XOpenDisplay(name);
  if (display != nullptr) {
    XCloseDisplay(display);
  }
  return display != nullptr;
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  const char* named = std::getenv("DISPLAY");
  was_set_ = named != nullptr;
  before_ = was_set_ ? named : "";
  if (!before_.empty() && answers(named)) {
    return;
  }
  if (!program_exists("Xvfb")) {
    throw std::runtime_error(
        "there is no display to draw on, and no Xvfb to stand in (Debian: package xvfb)");
  }
  server_ = std::make_unique<ChildProcess>(std::vector<std::string>{
      "Xvfb", "-displayfd", "{}", "-screen", "0", "64x64x24", "-nolisten", "tcp", "-noreset"});
  const std::string number = server_->read_status(kPatience);
  if (number.empty()) {
    const std::string words = server_->last_words();
    server_.reset();
    throw std::runtime_error("Xvfb did not start" + (words.empty() ? "" : ": " + words));
  }
  setenv("DISPLAY", (":" + number).c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ == nullptr) {
    return;
  }
  was_set_ ? setenv("DISPLAY", before_.c_str(), 1) : unsetenv("DISPLAY");
}

}  // namespace plumbline::render
