// The return map of a gait from touchdown to touchdown (equation 30), its multipliers, and the outer loop's
// gains.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "validation/studies/running/hybrid.h"

namespace plumbline::validation {

/// The section just before the next touchdown; none: the robot falls. `facts` of the stride, where wanted.
std::optional<monopod::Section> next_touchdown(const monopod::Constants& c, const monopod::Gait& gait,
                                               const monopod::Section& section, double step = 5e-4,
                                               StrideFacts* facts = nullptr);

/// Steps on the paper's model where multipliers and touchdowns are reported.
inline constexpr double kIntegrationStep = 2.5e-4;  // s

struct LinearReturn {
  Eigen::Matrix<double, 8, 8> by_state;  ///< dP/dx
  Eigen::Matrix<double, 8, 3> by_beta;   ///< dP/dbeta
};

/// Central differences about the gait's section with the outer loop as it stands in the gait. Throws
/// std::runtime_error where a neighbour falls.
LinearReturn linear_return(const monopod::Constants& c, const monopod::Gait& gait, double step = 5e-4);

/// Absolute values of the eigenvalues, largest first.
std::vector<double> multipliers(const Eigen::MatrixXd& by_state);

/// Errors that count alike: the cost is the sum over touchdowns of (x/state)^2 + (beta/parameter)^2.
struct OuterLoopWeights {
  monopod::Section state = monopod::Section::Ones();
  monopod::Betas parameter = monopod::Betas::Ones();
};

/// K of equation 31: beta = beta_nominal + K (x - x_nominal), which minimises that cost on the linearised
/// map.
Eigen::Matrix<double, 3, 8> outer_loop(const LinearReturn& map, const OuterLoopWeights& weights);

/// One touchdown after another from a section. Ends early where the robot falls.
std::vector<monopod::Section> touchdowns(const monopod::Constants& c, const monopod::Gait& gait,
                                         const monopod::Section& start, int steps, double step = 5e-4,
                                         std::vector<StrideFacts>* facts = nullptr);

}  // namespace plumbline::validation
