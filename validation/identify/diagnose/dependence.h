// What a force follows: position, velocity, load, time, the motor's angle or the phase of a stance; and how
// to say it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumbline::validation {

/// Mean of a force, or of its size, in bins of one variable that hold equal numbers of samples.
struct Dependence {
  std::string variable;  ///< "position", "velocity", "direction", "load", "time", "motor angle", "stance"
  std::string unit;
  double share = 0.0;  ///< of the variance (of the force, or of its size) that the bins' means explain
  std::vector<double> center, mean;
  bool of_size = false;  ///< of |force|: the force comes and goes without keeping a sign
  int repeats = 0;       ///< "motor angle": how often the strongest harmonic repeats in a turn
};

/// What a force is looked at against; equally long, SI.
struct ForceSamples {
  Eigen::VectorXd force, position, velocity, load, time;
  Eigen::VectorXd stance{};  ///< share of the time on the ground that has passed; empty: not known
  std::string force_unit;
  std::string of{};     ///< whose position and velocity these are, for the words; empty: the motor's
  bool angular = true;  ///< position in rad, else m
};

/// All dependences, strongest first, those of the size counted half. The motor's angle, where `of` is empty,
/// is that of the position; its share is that of the best harmonic a cos(n x) + b sin(n x), n = 1 to 60, by
/// least squares.
std::vector<Dependence> dependences_of(const ForceSamples& samples);

/// The strongest in words: "grows over the trial", "repeats 12 times in a turn of the motor", "is there only
/// under load", "depends on the velocity of leg". Below a tenth of the variance nothing is said to be
/// followed.
std::string in_words(const std::vector<Dependence>& strongest_first, const std::string& of = {});

}  // namespace plumbline::validation
