// A running gait on one model after the other, from the one that it was designed on to the whole robot: which
// effect does it not survive?
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/control/gait/gait_run.h"

namespace plumbline::validation {

/// One rung: a scenario with another model, another controller, another period, sensors with or without
/// counts. Empty and zero: as the scenario has it.
struct LadderRung {
  std::string name, model, controller;
  double period = 0.0;                              ///< s
  bool counts = true;                               ///< sensors show counts; otherwise exact positions
  std::vector<std::pair<std::string, double>> set;  ///< constants of the controller, SI
};

struct RunningLadder {
  std::string file, title, scenario;
  std::string paper;  ///< published_running/1: the motion in continuous time on its own model; may be empty
  long cycles = 100;
  std::string pushed;  ///< velocity of the scenario's start that is changed to find the contraction
  double push = 0.0;   ///< by so much, m/s
  std::vector<LadderRung> rungs;
};

/// `plumbline: running_ladder/1`. Throws InputError (one line: file, line, key, found, expected).
RunningLadder read_running_ladder(const std::string& path);

struct RungResult {
  std::string name;
  long steps = 0;  ///< from the scenario's start
  bool fell = false;
  std::string end;  ///< why, in words
  /// By which what a push leaves in the speed shrinks from stride to stride: the largest multiplier, as a run
  /// shows it. In continuous time on the paper's model: of the return map itself.
  std::optional<double> contraction;
  std::string no_contraction;        ///< why there is none
  double period = 0.0, speed = 0.0;  ///< of the last stride, s and m/s; 0: none was made
};

/// Throws InputError where the files of a rung do not fit together, and Stopped.
std::vector<RungResult> climb(const RunningLadder& ladder, const StopFlag* stop,
                              const std::function<void(const RungResult&)>& done);

}  // namespace plumbline::validation
