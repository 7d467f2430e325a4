// Where within a motion the model breaks: what jumps between segments that are predicted on their own.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// The next segment begins elsewhere than the one before it ends. SI.
struct Defect {
  std::string trial;
  Role role = Role::train;
  double time = 0.0;
  std::string at;           ///< coordinate or motor
  std::string unit;         ///< of the jump: m, rad, m/s or rad/s
  bool is_speed = true;     ///< false: the position jumps
  double jump = 0.0;        ///< next segment's start less the end of the one before
  double impulse = 0.0;     ///< of a speed: jump times the inertia that the place feels, N s or N m s
  double deviations = 0.0;  ///< |jump| in standard deviations
};

/// Windows are cut into segments of an eighth of their length, each predicted from its own estimated start
/// (multiple shooting; Bock 1981), with the model as it is and as far as it can be integrated. With x the
/// start of a segment, x_e where the prediction of the one before ends, H the information that the residuals
/// give of a start (Reduced::x_H) and F = d(x_e)/d(x0), the defect
///   d = x - x_e,   cov(d) = s^2 (H^-1 + F H_before^-1 F'),
/// s >= 1 the error of the segments in floors: what the model misses at all times is no event. An impulse
/// that the model does not know, a stop, a step of the ground stands out at its time and place, where a
/// window's free start would swallow it. Of each instant the place that jumps by most deviations; those above
/// four, largest first. Source: H. G. Bock, Numerical treatment of inverse problems in chemical reaction
/// kinetics, 1981.
std::vector<Defect> defects(const model::Model& model, const Data& data);

}  // namespace plumbline::validation
