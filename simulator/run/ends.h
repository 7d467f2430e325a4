// When a run is over before its time, and why, in words.
#pragma once

#include <string>
#include <vector>

#include "simulator/run/simulation.h"
#include "simulator/run/wired_controller.h"

namespace plumbline::run {

/// One condition that ends a run. Times in s.
struct End {
  enum class Kind {
    above,        ///< a position (coordinate, motor, joint) above the limit
    below,        ///< a position below the limit
    on_ground,    ///< some foot in the ground all the time, for longer than the limit
    unchanged,    ///< a value that the controller logs has not changed for longer than the limit
    after_fault,  ///< longer than the limit after the controller gave up
  };
  Kind kind = Kind::above;
  std::string watched;  ///< position or logged value
  double limit = 0.0;   ///< SI
  std::string words;    ///< what is said of it: "the hip is down"
};

/// Looks at a run sample by sample. While a controller has given up, conditions on its log and on standing
/// are not looked at: a robot without power lies. A state that is not finite always ends a run.
class EndWatch {
 public:
  EndWatch(const std::vector<End>& ends, const WiredController* controller);

  /// After the controller's step of a sample. Empty while the run may go on; otherwise the reason with its
  /// time.
  std::string look(const Simulation& simulation);

 private:
  struct Watched {
    End end;
    int log = -1;
    double last = 0.0;
    double since = 0.0;
    bool known = false;
  };
  std::string reason(const Simulation& simulation);
  std::string look_at(Watched& one, const Simulation& simulation) const;

  std::vector<Watched> ends_;
  const WiredController* controller_;
  double last_flight_ = 0.0;
  bool stood_ = false;     // has been on the ground
  bool flown_ = false;     // has left it after that
  double faulted_ = -1.0;  // s, when the controller gave up
  std::string fault_;
};

}  // namespace plumbline::run
