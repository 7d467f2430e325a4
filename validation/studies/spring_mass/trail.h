// A run of the spring-mass model from way-point to way-point, over flat ground or random tiles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/studies/spring_mass/leg_placement.h"

namespace plumbline::spring_mass {

/// Square tiles with heights that are uniform between -half_range and half_range, drawn from the tile's place
/// and the seed: the same for whoever asks, however far away.
class Tiles {
 public:
  Tiles(double side, double half_range, std::uint64_t seed)
      : side_(side), half_range_(half_range), seed_(seed) {}
  static Tiles flat() { return {1.0, 0.0, 0}; }
  double height(double x, double y) const;

 private:
  double side_, half_range_;
  std::uint64_t seed_;
};

enum class LawKind { deadbeat, constrained, classical };
std::string to_string(LawKind kind);

/// What differs between the model that runs and the one that the law was made for.
struct Disturbance {
  double energy = 0.0;     ///< share of the law's energy
  double stiffness = 0.0;  ///< share of the law's stiffness
  double attack = 0.0;     ///< rad, added to the commanded attack angle
  double splay = 0.0;      ///< rad, added to the commanded splay angle
  double delay = 0.0;      ///< s, by which the time law comes late
};

/// How a trail is run.
struct TrailSettings {
  LawKind law = LawKind::deadbeat;
  int steps = 500;
  double turn_limit = 0.34906585039886591;  ///< rad for each step, of constrained and classical
  double waypoint_radius = 0.5;             ///< m, from where the next way-point is headed for
  double arena = 100.0;                     ///< m, side of the square of the way-points
  double least_way = 15.0;  ///< m between two way-points; nearer than two turning circles can be out of reach
  bool straight = false;    ///< no way-points: straight on
  double first_apex = 1.0;  ///< m above the ground of height 0
  double gain = 0.0;        ///< s, of the classical law; 0: matched_gain()
  /// Of the classical law: the neutral point is v T_s/2 as equation 3.11 prints it, v the speed in flight.
  /// Otherwise it is half of the way that the mass ran in the stance before, which is the same with the mean
  /// speed of that stance.
  bool neutral_from_flight = false;
  /// rad between two entries of the deadbeat policy's table over wanted deflections; 0: each is looked up in
  /// the scan itself.
  double policy_step = 0.0;
  std::uint64_t seed = 1;
  Disturbance disturbance;
};

/// One step of a trail.
struct TrailStep {
  double x = 0.0, y = 0.0;  ///< m, of the apex that the step begins from
  double apex = 0.0;        ///< m, its height above ground of height 0
  double heading = 0.0;     ///< rad, of the velocity at that apex
  double foot_x = 0.0, foot_y = 0.0,
         ground = 0.0;      ///< m, where the foot landed and how high the ground is there
  double apex_error = 0.0;  ///< m, next apex above this ground minus the target
  double deflection_error =
      0.0;              ///< rad, against the wanted deflection or the nearest that the law can reach
  double wanted = 0.0;  ///< rad, deflection that the law was asked for
  double stumbling_margin = 0.0;  ///< m, from the foot at the apex down to the ground under the step before
  bool clipped = false;           ///< the law could not reach the wanted deflection
};

struct Trail {
  Ending ending = Ending::apex;  ///< of the last step; all before ended in an apex
  std::vector<TrailStep> steps;
  std::vector<Eigen::Vector2d> waypoints;  ///< those that were headed for
  std::vector<Eigen::Vector3d> path;       ///< m, of the mass; filled only where asked for
  double worst_apex() const;
  double rms_apex() const;
  double worst_deflection() const;
  double rms_deflection() const;
  /// Mean of the last fifty apex errors: of a straight run the steady error.
  double last_apex_error() const;
};

/// Runs a trail; ends before the asked number of steps only where the model does not reach an apex.
Trail run_trail(const DeadbeatLaw& law, const Tiles& ground, const TrailSettings& settings,
                bool with_path = false);

}  // namespace plumbline::spring_mass
