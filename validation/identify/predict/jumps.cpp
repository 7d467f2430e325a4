// Windows through points at which a force jumps: a stop whose damping acts at once, play that closes.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "validation/identify/predict/jump_surface.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

// The integrator stopped there: the points become nodes, so that no piece runs across one.
// Contacts that are more than the samples could show none of: a law that chatters is no explanation of them,
// and its slopes cost as much as all others together.
void Predictor::add_jumps(const std::vector<integrate::Event>& events, double t0) {
  constexpr std::size_t kSome = 30;
  for (; events_seen_ < events.size(); ++events_seen_) {
    const integrate::Event& event = events[events_seen_];
    add_node(event.time - t0, event.state);
    jump_nodes_.push_back({nodes_ - 1, jumps_[static_cast<std::size_t>(event.index)], event.direction});
    if (jump_nodes_.size() > kSome && 2 * static_cast<Eigen::Index>(jump_nodes_.size()) > nodes_) {
      throw std::runtime_error("it chatters: contacts open and close more often than samples were taken");
    }
  }
}

bool Predictor::is_behind_jump(Eigen::Index node) const {
  return std::any_of(jump_nodes_.begin(), jump_nodes_.end(),
                     [node](const JumpNode& jump) { return jump.node == node; });
}

void Predictor::jump_slopes(Eigen::Index node, const std::vector<model::ParameterId>& ids,
                            const Eigen::VectorXd& steps, Eigen::MatrixXd& S) {
  for (const JumpNode& jump : jump_nodes_) {
    if (jump.node == node) {
      jump_slopes(jump, ids, steps, S);
    }
  }
}

// A motion that deviates by S reaches the point g(x, p) = 0 earlier or later, and has for so long another
// rate:
//   S <- S + (f_behind - f_before) (dg/dx S + dg/dp) / (dg/dx f_before),
// the saltation matrix (Leine and Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems,
// 2004, chapter 7). g is a function of positions and parameters. Both rates are taken a hair beside the
// point; what a glance leaves of dg/dt is not divided by.
void Predictor::jump_slopes(const JumpNode& at, const std::vector<model::ParameterId>& ids,
                            const Eigen::VectorXd& steps, Eigen::MatrixXd& S) {
  constexpr double kSlowest = 1e-6;
  const Eigen::Index nx = plant_.states();
  const Eigen::Index nz = plant_.positions();
  const Eigen::VectorXd x = states_.col(at.node);
  const JumpSurface surface = surface_at(plant_, at.jump.index, x);
  if (std::abs(surface.rate) < kSlowest) {
    return;
  }
  const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant_.motors());
  const Eigen::VectorXd jump = rate_beside(plant_, surface, x, idle.data(), at.direction) -
                               rate_beside(plant_, surface, x, idle.data(), -at.direction);
  Eigen::RowVectorXd later = surface.slope * S.topRows(nz);
  for (std::size_t p = 0; p < ids.size(); ++p) {
    if (ids[p].effect != at.jump.effect) {
      continue;
    }
    const auto i = static_cast<Eigen::Index>(p);
    const double value = plant_.value(ids[p]);
    plant_.set_value(ids[p], value + steps[i]);
    later[nx + i] += (surface_at(plant_, at.jump.index, x).value - surface.value) / steps[i];
    plant_.set_value(ids[p], value);
  }
  S += jump * (later / surface.rate);
}

}  // namespace plumbline::validation
