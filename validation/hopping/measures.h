// What can be measured on a hopping run and held against a published value: a fixed list.
#pragma once

#include <string>
#include <vector>

#include "controllers/mabel_hopping/hopping_config.h"
#include "validation/hopping/hop_run.h"

namespace plumbline::validation {

/// A quantity that the program knows how to measure.
struct Measure {
  enum class Kind {
    of_a_hop,     ///< one value for each settled hop
    of_a_run,     ///< one value for each run
    of_an_orbit,  ///< one value for a controller
    of_a_model,   ///< one value, without a run
  };
  std::string name;
  std::string unit;  ///< SI
  Kind kind;
  std::string how;  ///< in words, for people
};

/// In the order of the documentation.
const std::vector<Measure>& measures();
/// nullptr when there is none of this name.
const Measure* find_measure(const std::string& name);

/// Mean and standard deviation of `count` values.
struct Spread {
  double mean = 0.0, deviation = 0.0;
  long count = 0;
};
Spread spread_of(const std::vector<double>& values);

/// Hops behind the transient and before a fall: without a run's first five, and without the last three of a
/// run that fell.
std::vector<Hop> settled_hops(const std::vector<HopRun>& runs);

/// A measure of kind of_a_hop of one hop, SI. Throws std::invalid_argument for another kind.
double measure_of(const Measure& measure, const Hop& hop, const controllers::HoppingConfig& config);

}  // namespace plumbline::validation
