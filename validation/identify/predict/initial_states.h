// The windows' initial states on the way of a search.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "validation/identify/predict/state_search.h"

namespace plumbline::validation {

/// Where a search stands: values of the parameters, and the initial state of each window.
struct Point {
  Eigen::VectorXd theta;
  std::vector<Eigen::VectorXd> x0;
};

constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

/// Steps of the initial states, each window by itself. With empty units the parameters have the values that
/// the point gives them and no equations.
class InitialStates {
 public:
  InitialStates(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                const Eigen::VectorXd& units)
      : pool_(pool), parameters_(parameters), units_(units) {}

  /// Those that are empty: from the measurements.
  void begin(Point& point);
  /// The equations of all windows.
  std::vector<Reduced> reduce_at(const Point& point);
  /// The same; windows that cannot be integrated from where they are begin anew from the measurements.
  std::vector<Reduced> reduce_or_begin_anew(Point& point);
  /// The equations of some windows, in their places among all; of one that cannot be integrated from where it
  /// is, an infinite cost.
  std::vector<Reduced> reduce_some(const std::vector<int>& windows, const Point& point);
  /// Steps of the initial states alone (StateSearch::settle).
  void settle(const std::vector<int>& windows, const Settling& settling, Point& point,
              std::vector<Reduced>& reduced);
  /// All windows in the order of time: from the states they have; those without one from where the one before
  /// ends, and above the floor from the measurements; those that are astray from where the one before ends,
  /// then grown (StateSearch::grown). In the midst of a contact the measurements hardly tell how deep a foot
  /// is in the ground, how far its bristles are bent and how hard a pulley is in its stop, but a model that
  /// explains what came before does. Squared residuals of each window are `expected`; none: what its
  /// equations promise. The equations where they end; an infinite cost where none is found. Where more than
  /// `most` go astray the rest is left, with infinite costs.
  std::vector<Reduced> settle_in_turn(const Settling& settling, Point& point,
                                      const std::vector<double>& expected = {},
                                      std::size_t most = kAnyNumber);
  /// Windows that have gone astray of the promised squared residuals: once more from where they began, then
  /// from where the one before ends, then from the measurements, and `thoroughly` grown from there. Nothing
  /// is tried where more than most_lost() are.
  void settle_lost(const std::vector<double>& promised, const Settling& settling, bool thoroughly,
                   const Point& from, Point& point, std::vector<Reduced>& reduced);
  /// All windows from where they are, or from the measurements; the equations where they end.
  std::vector<Reduced> settle_all(const Settling& settling, Point& point);
  /// Some windows once more from the measurements, where that ends better.
  void settle_anew(const std::vector<int>& windows, const Settling& settling, Point& point,
                   std::vector<Reduced>& reduced);
  /// Halves the steps of initial states that made their windows worse, as a touchdown missed or gained does:
  /// the other windows' steps are none of their business. Where the parameters move too, a window may lose a
  /// little.
  void shorten(const Point& from, const std::vector<Reduced>& before, Point& to, std::vector<Reduced>& after);
  /// The last step of every initial state (StateSearch::take_last_step).
  void take_last_step(Point& point, std::vector<Reduced>& reduced);

 private:
  StateSearch search(int window, const Point& point);
  /// Windows that a step made worse begin where they began before it, where that is better.
  void stay_where_better(const Point& from, const std::vector<Reduced>& before,
                         const std::vector<int>& windows, Point& to, std::vector<Reduced>& after);
  std::vector<Reduced> reduce_those_that_run(const std::vector<int>& windows, const Point& point);
  /// The state in which the window that ends where this one begins ends.
  std::optional<Eigen::VectorXd> end_of_the_one_before(int window, int before, const Point& point);
  Eigen::VectorXd measured_start(int window, const Point& point);
  /// Where none was found yet, too.
  static void take_if_better(int window, Settled found, Point& point, Reduced& reduced);
  void try_start(int window, const Eigen::VectorXd& start, const Settling& settling, Point& point,
                 Reduced& reduced);
  void try_from_before(int window, int before, const Settling& settling, Point& point, Reduced& reduced);
  void try_grown(int window, const Eigen::VectorXd& start, const Settling& settling, Point& point,
                 Reduced& reduced);
  /// Work on each window after that on the one before (-1: none) is done. With `segments_alone` that is one
  /// of the same window, and more is done at once.
  void in_turn(bool segments_alone, const std::function<void(int window, int before)>& work);

  PredictorPool& pool_;
  const std::vector<FreeParameter>& parameters_;
  Eigen::VectorXd units_;
};

/// The initial states of all windows, the parameters as they are; the equations there.
std::vector<Reduced> settle_all(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                const Settling& settling, Point& at);

/// Does a window's squared error mean a root mean square residual of more than `fits` floors?
bool is_above_floor(const Data& data, int window, double sse, double fits = kFits);

/// Above the floor: has a window more than twice the squared residuals that are expected of it, or does the
/// next step promise to take a third? Such a search is not at its end, whatever it says. Where nothing is
/// expected of any window: than its equations promise.
bool is_astray(const Data& data, int window, const std::vector<Reduced>& reduced,
               const std::vector<double>& expected);

/// A quarter of so many windows: where more are lost it is not their states that are wrong, but the model.
std::size_t most_lost(std::size_t windows);

/// The windows that are above the floor where they are.
std::vector<int> above_floor(const Data& data, const std::vector<Reduced>& reduced, double fits = kFits);

/// The windows that are not linear in where they begin.
std::vector<int> curved(const std::vector<Reduced>& reduced);

}  // namespace plumbline::validation
