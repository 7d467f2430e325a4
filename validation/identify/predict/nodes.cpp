// The points at which a predicted window is known: its samples, and points between them.
#include <algorithm>
#include <cmath>

#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

void Predictor::begin_nodes(const Window& window) {
  states_.resize(plant_.states(), window.count);
  nodes_ = 1;
  held_from_ = window.count - 1;
  node_of_sample_.clear();
  node_times_.clear();
  jumps_ = plant_.jumps();
  jump_nodes_.clear();
  events_seen_ = 0;
  if (plant_.meets_anything() || !jumps_.empty()) {
    node_of_sample_.assign(1, 0);
    node_times_.assign(1, 0.0);
  }
}

void Predictor::add_node(double time, const Eigen::VectorXd& state) {
  if (nodes_ == states_.cols()) {
    states_.conservativeResize(Eigen::NoChange, 2 * states_.cols());
  }
  states_.col(nodes_++) = state;
  node_times_.push_back(time);
}

void Predictor::add_sample(Eigen::Index sample, const Eigen::VectorXd& state) {
  if (node_of_sample_.empty()) {
    states_.col(nodes_++) = state;
    return;
  }
  node_of_sample_.push_back(nodes_);
  add_node(static_cast<double>(sample) * trial_.period, state);
}

// All samples behind this one are its node.
void Predictor::hold(const Window& window, Eigen::Index sample) {
  if (node_of_sample_.empty()) {
    for (Eigen::Index k = 0; k < nodes_; ++k) {
      node_of_sample_.push_back(k);
      node_times_.push_back(static_cast<double>(k) * trial_.period);
    }
  }
  held_from_ = sample;
  node_of_sample_.resize(static_cast<std::size_t>(window.count), node_of(sample));
}

// A foot that is not in the ground but would be there within two samples may meet it in this one; links that
// may meet each other likewise.
bool Predictor::is_near_ground(Eigen::Index node) {
  if (!plant_.meets_anything()) {
    return false;
  }
  const auto is_near = [&](double depth, double rate) {
    return depth > 0.0 || depth + 2.0 * trial_.period * rate > 0.0;
  };
  for (std::size_t f = 0; f < plant_.model().feet.size(); ++f) {
    const model::FootDepth foot = plant_.foot_depth(static_cast<int>(f), states_.col(node).data());
    if (is_near(foot.depth, foot.rate)) {
      return true;
    }
  }
  const std::vector<model::LinkTouch> links = plant_.link_touches(states_.col(node).data());
  return std::any_of(links.begin(), links.end(),
                     [&](const model::LinkTouch& one) { return is_near(one.depth, one.rate()); });
}

// Between two nodes that are not neighbours: do the ground's slopes at the middle hold over all of it? Every
// foot that is in the ground stays there and is far below its surface beside what it moves, the force's
// slope changes by as little, and nothing jumps or is timed on the way.
bool Predictor::is_even(Eigen::Index from, Eigen::Index to, const std::vector<Crossing>& crossings) {
  constexpr double kShareOfDepth = 0.1;
  const auto inside = [&](Eigen::Index node) { return node >= from && node < to; };
  if (std::any_of(jump_nodes_.begin(), jump_nodes_.end(),
                  [&](const JumpNode& jump) { return inside(jump.node); }) ||
      std::any_of(crossings.begin(), crossings.end(),
                  [&](const Crossing& crossing) { return inside(crossing.node); })) {
    return false;
  }
  const auto feet = static_cast<Eigen::Index>(plant_.model().feet.size());
  const auto depths_at = [&](Eigen::Index node) {  // of all contacts at once: they share the kinematics
    Eigen::ArrayXd depths(feet + plant_.link_points());
    for (Eigen::Index f = 0; f < feet; ++f) {
      depths[f] = plant_.foot_depth(static_cast<int>(f), states_.col(node).data()).depth;
    }
    const std::vector<model::LinkTouch> links = plant_.link_touches(states_.col(node).data());
    for (std::size_t k = 0; k < links.size(); ++k) {
      depths[feet + static_cast<Eigen::Index>(k)] = links[k].depth;
    }
    return depths;
  };
  const Eigen::ArrayXd before = depths_at(from);
  const Eigen::ArrayXd behind = depths_at(to);
  for (Eigen::Index f = 0; f < before.size(); ++f) {
    const double least = std::min(before[f], behind[f]);
    const double most = std::max(before[f], behind[f]);
    if (most > 0.0 && !(most - least <= kShareOfDepth * least)) {
      return false;
    }
  }
  return true;
}

// The whole sample where the ground is even over it: samples that are taken often against what the ground
// does. Else, near the ground, the integrator's steps.
std::vector<Predictor::Piece> Predictor::pieces_of(Eigen::Index sample,
                                                   const std::vector<Crossing>& crossings) {
  const Eigen::Index from = node_of(sample);
  const Eigen::Index to = node_of(sample + 1);
  if (to > from + 1 && is_even(from, to, crossings)) {
    return {{from, to}};
  }
  std::vector<Piece> pieces;
  for (Eigen::Index n = from; n < to; ++n) {
    pieces.push_back({n, n + 1});
  }
  return pieces;
}

Eigen::Index Predictor::node_of(Eigen::Index sample) const {
  return node_of_sample_.empty() ? sample : node_of_sample_[static_cast<std::size_t>(sample)];
}

Eigen::MatrixXd Predictor::predicted_states() const {
  if (node_of_sample_.empty()) {
    return states_.leftCols(nodes_);
  }
  const auto samples = static_cast<Eigen::Index>(node_of_sample_.size());
  Eigen::MatrixXd states(states_.rows(), samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    states.col(k) = states_.col(node_of(k));
  }
  return states;
}

double Predictor::node_time(Eigen::Index node) const {
  return node_times_.empty() ? static_cast<double>(node) * trial_.period
                             : node_times_[static_cast<std::size_t>(node)];
}

double Predictor::length_of(const Piece& piece) const {
  return piece.to == piece.from + 1 ? length_of(piece.from) : node_time(piece.to) - node_time(piece.from);
}

double Predictor::length_of(Eigen::Index node) const {
  return node_times_.empty() ? trial_.period : node_time(node + 1) - node_time(node);
}

}  // namespace plumbline::validation
