// The search of one window's initial state.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

/// Errors below this are at the floor, where there is no other minimum to look for.
constexpr double kFits = 1.2;

/// When a window's initial state counts as settled.
struct Settling {
  int steps = 6;
  double much = 0.05;  ///< share of the cost: what the next step promises to take is less
  /// A step that made the window worse is shortened, not turned: for one that begins where it ended before.
  bool straight = false;
};

constexpr Settling kRoughly{24, 1e-2};

/// Does the next step of the window's initial state promise little?
bool is_settled(const Reduced& reduced, const Settling& settling);

/// An initial state, and the equations there.
struct Settled {
  Eigen::VectorXd x0;
  Reduced reduced;
};

/// One window of a pool, the parameters as they are. What is given must outlive it.
class StateSearch {
 public:
  StateSearch(PredictorPool& pool, int window, const std::vector<FreeParameter>& parameters,
              const Eigen::VectorXd& theta, const Eigen::VectorXd& units)
      : pool_(pool), window_(window), parameters_(parameters), theta_(theta), units_(units) {}

  /// The equations; of a start from which it cannot be integrated an infinite cost.
  Settled from(const Eigen::VectorXd& x0);
  /// One step after the other, those that do not help damped, until the state is settled.
  void settle(const Settling& settling, Settled& at);
  /// The equations there if it is better than this, else a cost alone that is no lower: the slopes are most
  /// of the work.
  Settled if_better(const Eigen::VectorXd& x0, const Reduced& than);
  /// The equations at hand promise one more step. Where it would still matter it is tried: taken when the
  /// window is the better for it, and its residuals are those that are there, not the promised.
  void take_last_step(Settled& at);
  /// Settled on the window's first tenth, then on two tenths from there, and so on to the whole. Where a foot
  /// lands or a pulley meets its stop what comes later bends with where the window begins, and a search over
  /// all of it ends beside its minimum; the beginning is nearly straight, and what it tells of the state
  /// leaves little to search in the next tenth. A model that misses a beginning by far is not followed
  /// further: the search then goes on over the whole from there.
  Settled grown(const Eigen::VectorXd& start, const Settling& settling);

 private:
  const Window& whole() const { return pool_.data().windows[static_cast<std::size_t>(window_)]; }
  Settled from(const Window& part, const Eigen::VectorXd& x0, bool with_parameters);
  void settle(const Window& part, const Settling& settling, Settled& at);
  Settled if_better(const Window& part, const Eigen::VectorXd& x0, bool with_parameters, const Reduced& than);

  PredictorPool& pool_;
  int window_;
  const std::vector<FreeParameter>& parameters_;
  const Eigen::VectorXd& theta_;
  const Eigen::VectorXd& units_;
};

}  // namespace plumbline::validation
