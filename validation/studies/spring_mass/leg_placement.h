// Where the leg is put: the deadbeat law from a scanned behaviour, the same law over the time since the apex,
// and the classical law.
#pragma once

#include <optional>
#include <vector>

#include "validation/studies/spring_mass/behaviour.h"

namespace plumbline::spring_mass {

/// A leg placement and the deflection that it is expected to bring.
struct Placement {
  LegAngles leg;
  double deflection = 0.0;  ///< rad; the wanted one, or the nearest that the contour reaches
};

/// The two stages of equations 3.6 and 3.7: of all placements that lead to the next apex `target` the one
/// whose deflection is nearest to the wanted one. The behaviour is interpolated linearly along the cells'
/// edges, and linearly between two crossings within a cell (the contour of bilinear interpolation, and what a
/// plot of contours draws).
class DeadbeatLaw {
 public:
  DeadbeatLaw(const Behaviour& behaviour, double target);
  double target() const { return target_; }
  const Behaviour& behaviour() const { return *behaviour_; }
  /// From the k-th apex of the scan. None: no placement leads to the target from there. Of several placements
  /// with the same deflection the steepest leg is taken.
  std::optional<Placement> at(int k, double deflection) const;

 private:
  struct Crossing {
    double attack = 0.0, splay = 0.0, deflection = 0.0;
  };
  struct Piece {
    Crossing from, to;
  };
  std::optional<Crossing> crossing(int k, int i, int j, int di, int dj) const;
  void add_cell(int k, int i, int j);
  const Behaviour* behaviour_;
  double target_;
  std::vector<std::vector<Piece>> contours_;  ///< one for each apex of the scan
};

/// The leg angles over the time since the apex for one wanted deflection (equations 3.8 and 3.9): at t the
/// placement that the deadbeat law takes from the apex from which the foot lands at t. Before the first entry
/// and behind the last one the nearest entry holds.
class TimeLaw {
 public:
  TimeLaw(const DeadbeatLaw& law, double deflection);
  bool empty() const { return times_.empty(); }
  Placement at(double time) const;
  const std::vector<double>& times() const { return times_; }
  const std::vector<Placement>& placements() const { return placements_; }

 private:
  std::vector<double> times_;
  std::vector<Placement> placements_;
};

/// Time laws for deflections from 0 to pi in equal steps, as section 3.2.2 keeps its policy: wanted
/// deflections between two entries are interpolated, and the last entry that can be reached stands for all
/// beyond it.
class PolicyTable {
 public:
  /// `step` in rad.
  PolicyTable(const DeadbeatLaw& law, double step);
  /// At this time after the apex. The placement's deflection is the wanted one, clipped where the model's own
  /// limit is: what the table falls short of it is an error.
  Placement at(double time, double wanted) const;

 private:
  bool reaches(std::size_t entry, const Placement& placement) const;
  double step_;
  std::vector<TimeLaw> laws_;
};

/// The classical law of equation 3.11: foot at `neutral` along the velocity plus gain*(v - v_wanted) before
/// the mass, in the horizontal plane. `neutral` is the neutral point's distance in m, `gain` has the unit s.
LegAngles classical_placement(const Body& body, const Eigen::Vector2d& velocity, double neutral, double gain,
                              const Eigen::Vector2d& wanted);

/// The gain that fits the slope of the behaviour at the steady gait of apex `target`: dx_f/dv that leads back
/// to the target at once, by central differences. In s.
double matched_gain(const Body& body, double target);

/// The attack angle of the steady gait, by bisection: next apex equals the apex. Throws std::runtime_error
/// where there is none.
double steady_attack(const Body& body, double apex);

}  // namespace plumbline::spring_mass
