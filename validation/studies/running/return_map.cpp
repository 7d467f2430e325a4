#include "validation/studies/running/return_map.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>

namespace plumbline::validation {
namespace {

using namespace monopod;

// By which the map's arguments are moved: large against the integration's error, small against the basin.
constexpr double kStateSteps[8] = {1e-5, 1e-5, 1e-5, 1e-4, 1e-4, 1e-4, 1e-5, 1e-5};
constexpr double kBetaSteps[3] = {1e-5, 1e-4, 1e-5};

Section mapped(const Constants& c, const Gait& gait, const Section& from, double step) {
  const auto to = next_touchdown(c, gait, from, step);
  if (!to) {
    throw std::runtime_error("a neighbour of the periodic motion falls within a stride");
  }
  return *to;
}

}  // namespace

std::optional<Section> next_touchdown(const Constants& c, const Gait& gait, const Section& section,
                                      double step, StrideFacts* facts) {
  HybridRun run(Running(c, gait), step);
  run.state = state_at(c, section);
  if (!run.stand() || !run.fly()) {
    return std::nullopt;
  }
  if (facts != nullptr) {
    *facts = run.facts;
  }
  return run.facts.section;
}

LinearReturn linear_return(const Constants& c, const Gait& gait, double step) {
  LinearReturn map;
  for (int i = 0; i < 8; ++i) {
    Section ahead = gait.section, behind = gait.section;
    ahead[i] += kStateSteps[i];
    behind[i] -= kStateSteps[i];
    map.by_state.col(i) =
        (mapped(c, gait, ahead, step) - mapped(c, gait, behind, step)) / (2.0 * kStateSteps[i]);
  }
  for (int i = 0; i < 3; ++i) {
    Gait ahead = gait, behind = gait;
    ahead.shift[i] += kBetaSteps[i];
    behind.shift[i] -= kBetaSteps[i];
    map.by_beta.col(i) = (mapped(c, ahead, gait.section, step) - mapped(c, behind, gait.section, step)) /
                         (2.0 * kBetaSteps[i]);
  }
  return map;
}

std::vector<double> multipliers(const Eigen::MatrixXd& by_state) {
  const Eigen::VectorXd values = by_state.eigenvalues().cwiseAbs();
  std::vector<double> sizes(values.data(), values.data() + values.size());
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

Eigen::Matrix<double, 3, 8> outer_loop(const LinearReturn& map, const OuterLoopWeights& weights) {
  const Eigen::MatrixXd a = map.by_state, c = map.by_beta;
  const Eigen::MatrixXd q = weights.state.cwiseAbs2().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd r = weights.parameter.cwiseAbs2().cwiseInverse().asDiagonal();
  Eigen::MatrixXd p = q, k;
  constexpr int kMost = 100000;
  for (int i = 0; i < kMost; ++i) {
    const Eigen::MatrixXd inner = r + c.transpose() * p * c;
    k = -inner.llt().solve(c.transpose() * p * a);
    const Eigen::MatrixXd closed = a + c * k;
    const Eigen::MatrixXd next = q + k.transpose() * r * k + closed.transpose() * p * closed;
    const double change = (next - p).norm() / next.norm();
    p = next;
    if (change < 1e-13) {
      return k;
    }
    if (!(p.norm() < 1e18)) {
      break;
    }
  }
  throw std::runtime_error("no outer loop stabilises this motion");
}

std::vector<Section> touchdowns(const Constants& c, const Gait& gait, const Section& start, int steps,
                                double step, std::vector<StrideFacts>* facts) {
  std::vector<Section> sections{start};
  while (static_cast<int>(sections.size()) < steps) {
    StrideFacts one;
    const auto next = next_touchdown(c, gait, sections.back(), step, &one);
    if (!next) {
      break;
    }
    if (facts != nullptr) {
      facts->push_back(one);
    }
    sections.push_back(*next);
  }
  return sections;
}

}  // namespace plumbline::validation
