// The behaviour function of the spring-mass model on a grid, kept on disk.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/studies/spring_mass/spring_mass.h"

namespace plumbline::spring_mass {

/// The grid of Wu 2017, section 3.2.2: 22 x 45 x 150. The thesis gives the ranges 45 to 90, 0 to 180 degrees
/// and 0.71 to 2.27 m. Even degrees are read from its results: of all layouts tried (even and odd degrees,
/// even division) only these give its steady errors, and the largest turn of 74 degrees is the one of a leg
/// at 46 degrees.
struct Grid {
  int attacks = 22;  ///< from lowest_attack up
  int splays = 45;   ///< from 0 up; the other half is the mirror image
  int apexes = 150;  ///< from lowest_apex to E/(m g)
  double lowest_attack =
      0.80285145591739148;  ///< rad, 46 degrees (45 is atan(1/mu) for a friction coefficient of 1)
  double attack_step = 0.034906585039886591;  ///< rad, 2 degrees
  double splay_step = 0.069813170079773182;   ///< rad, 4 degrees
  double lowest_apex = 0.70710678118654757;   ///< m, where the leg at 45 degrees touches the ground
};

/// f on the grid: where a step does not end in an apex both values are not a number.
class Behaviour {
 public:
  Behaviour(Body body, Grid grid);
  const Body& body() const { return body_; }
  const Grid& grid() const { return grid_; }
  double attack(int i) const;
  double splay(int j) const;
  double apex(int k) const;
  double next_apex(int i, int j, int k) const { return next_apex_[index(i, j, k)]; }
  double deflection(int i, int j, int k) const { return deflection_[index(i, j, k)]; }

  /// Integrates every cell, on `threads` threads (0: as many as there are cores).
  void scan(int threads = 0);
  /// Writes all numbers, behind a line that says which model and grid they are of.
  void keep(const std::string& file) const;
  /// Reads what keep() wrote. False: there is no such file, or it is of another model or grid.
  bool recall(const std::string& file);

 private:
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(grid_.splays) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(grid_.attacks) +
           static_cast<std::size_t>(i);
  }
  void scan_apex(int k);
  std::string heading() const;
  Body body_;
  Grid grid_;
  std::vector<double> next_apex_, deflection_;
};

}  // namespace plumbline::spring_mass
