// Long work of the library under Python: off the interpreter's thread, with progress and Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "validation/identify/diagnose/screen.h"

namespace plumbline::python {

/// Runs `work` on a thread of its own without the interpreter's lock. Meanwhile this thread hands what the
/// work reports to `progress(what, fraction)`, unless that is None, and looks for Ctrl-C ten times a second:
/// it raises the flag, at which the work ends cleanly, and true is returned. What the work throws is thrown
/// here; Stopped is not, for that is the answer to the flag.
bool run(const pybind11::object& progress,
         const std::function<void(const validation::StopFlag&, const validation::Progress&)>& work);

}  // namespace plumbline::python
