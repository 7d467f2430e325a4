// What is measured on a cycle of a gait: small functions over the cycle's samples.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/yaml_node.h"
#include "validation/control/gait/channels.h"

namespace plumbline::validation {

/// The samples of one cycle: from the one that begins it to the one that ends it and begins the next. The
/// command of the first sample still belongs to the cycle before as far as `largest` and `time_at_limit` are
/// concerned, so that each sample counts once.
struct CycleSamples {
  const Eigen::MatrixXd& rows;  ///< samples x channels
  const Eigen::VectorXd& time;  ///< s
  const std::vector<double>&
      touchdowns;  ///< when each foot of the gait came down last, s, at the cycle's end
};

/// A measure as a file states it: a word ("duration"), or a map of one word and channels
/// ({change: travel}, {largest: [u_left, u_right]}).
struct Measure {
  enum class Kind {
    duration,           ///< s
    change,             ///< last less first
    at_end,             ///< at the sample that ends the cycle: the touchdown
    mean,               ///< over the cycle, by time
    largest,            ///< magnitude, of all channels
    swing,              ///< highest less lowest
    rate,               ///< change over duration
    rms,                ///< root mean square over the cycle, by time
    integral,           ///< over time
    positive_work,      ///< integral of the sum of what is above zero, of powers: J
    cost_of_transport,  ///< positive_work over weight and |change of travel|: 1
    time_at_limit,      ///< that a channel's magnitude is at the limit or beyond, summed over the channels, s
    touchdown_gap,      ///< between the first and the last foot's touchdown at the cycle's end, s
    share_down,         ///< share of the cycle that a foot is in the ground (duty factor)
    cycles,             ///< of a run: how many there were
    growth,             ///< of the orbit: largest multiplier of the return map
    growth_held,        ///< the same with what the controller updates from cycle to cycle held
    joint_of_stretch,   ///< of the model: angle of the joint for an angle of a ratio's stretch
  };
  /// What a measure is taken of.
  enum class Of { cycle, run, orbit, model };

  Kind kind = Kind::duration;
  std::vector<std::string> channels;  ///< of a joint_of_stretch: the ratio
  double limit = 0.0;                 ///< of time_at_limit, SI
  double weight = 0.0;                ///< of cost_of_transport, N; its travel is the last of the channels
  std::string text;                   ///< as written, for people
  Of of() const;
};

/// Reads and checks the form; names are checked by Channels. Throws InputError.
Measure read_measure(const model::YamlNode& node);

/// Its unit in SI, from its channels'. Throws InputError (`where`) when they differ.
std::string unit_of(const Measure& measure, const Channels& channels, const Place_in_file& where);

/// The value of one cycle, SI. Only for measures of a cycle.
double value_of(const Measure& measure, const Channels& channels, const CycleSamples& cycle);

/// Mean and standard deviation of `count` values.
struct Spread {
  double mean = 0.0, deviation = 0.0;
  long count = 0;
};
Spread spread_of(const std::vector<double>& values);

}  // namespace plumbline::validation
