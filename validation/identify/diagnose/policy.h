// The constants that decide what a diagnosis says.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plumbline::validation {

/// Everything that bears on a verdict and is a choice of ours. None has a dimension: errors are in floors (1:
/// what the sensors alone leave), the others are shares, counts, or numbers of standard deviations.
/// docs/method-constants.md has the reasons.
struct Policy {
  // Where an error is.
  double at_floor = 1.1;   ///< nothing is left to explain
  double finished = 1.2;   ///< what was named is an answer
  double far = 3.0;        ///< more is missing than one effect
  double hopeless = 20.0;  ///< so much is missing that no pair is looked for
  double nearer = 1.5;     ///< above it: to be sought on shorter windows, a law must promise this there

  // When a law is named.
  double material = 0.05;     ///< least relative fall of the error that counts (held-out where there is one)
  double simpler = 0.02;      ///< relative rise of the error at which a simpler law is still preferred
  double simpler_far = 0.25;  ///< the same above `far`, of two laws of one family at one place
  double stable = 0.7;        ///< least share of resamples that choose the effect, its family or a rival
  double fair = 0.05;         ///< least share of resamples in which a law must be better to be a rival
  double told = 2.0;          ///< deviations by which a strength differs from nothing

  // The model's own parameters.
  double parameter_width = 3.0;  ///< stated standard deviations that they may move
  double evidence = 100.0;       ///< least odds with which the stated values are believed, or given up

  // How far is searched.
  int most_effects = 4;       ///< rounds in which an effect is named
  int most_as_stated = 1;     ///< rounds with the model parameters exactly as stated
  int refits = 8;             ///< candidates that are refitted in each round
  int refits_segments = 5;    ///< the same on segments, where a straight line keeps its promise
  int constants = 3;          ///< of these at most so many constants of the robot and its sensors
  int firsts = 3;             ///< single effects that are continued to pairs
  int seconds = 4;            ///< refits after each of them
  int linear_pairs = 5;       ///< refits of pairs that were linearised together
  double near_best = 0.15;    ///< relative rise of the squared error up to which a refit is finished
  double kept_promise = 2.5;  ///< beside an answer: times the best up to which a promise is tried
  double still_better = 0.5;  ///< share of it that a law with corners must promise for the long way
  double explained = 0.7;    ///< share of the squared error below which laws that take much work are left out
  bool dear = true;          ///< above `hopeless` also laws that take many times the model's work
  std::size_t windows = 24;  ///< of each role on which candidates are tried; results are for all windows
  int resamples = 400;
  unsigned seed = 1;
};

/// A constant by its name, to be listed and varied.
struct PolicyConstant {
  std::string name;
  std::variant<double Policy::*, int Policy::*> member;
  double origin = 0.0;             ///< from which it is measured: an error of 1.2 is 0.2 above the floor
  std::optional<double> absent{};  ///< the value with which its rule decides nothing; empty: there is none

  double value(const Policy& policy) const;
  /// origin + factor * (value - origin); counts are rounded, and at least 1.
  void scale(Policy& policy, double factor) const;
  void set(Policy& policy, double value) const;
};

/// All numbers of Policy but `windows`, `resamples` and `seed`, in the order in which they stand there.
const std::vector<PolicyConstant>& policy_constants();

}  // namespace plumbline::validation
