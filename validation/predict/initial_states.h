// The windows' initial states on the way of a search.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "validation/predict/estimate.h"

namespace plumbline::validation {

/// Where a search stands: values of the parameters, and the initial state of each window.
struct Point {
  Eigen::VectorXd theta;
  std::vector<Eigen::VectorXd> x0;
};

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
  /// Steps of the initial states alone, in those of the `open` windows whose next step still promises much.
  void settle(std::vector<int> open, const Settling& settling, Point& point, std::vector<Reduced>& reduced);
  /// All windows in the order of time, those without a state from where the one before ends or from the
  /// measurements, whichever leads further: in the midst of a contact the measurements hardly tell how deep a
  /// foot is in the ground, how far its bristles are bent and how hard a pulley is in its stop, but a model
  /// that explains what came before does. The equations where they end; an infinite cost where none is found.
  std::vector<Reduced> settle_in_turn(const Settling& settling, Point& point);
  /// Windows above the floor whose squared residuals are more than twice what was promised: once more from
  /// where they began, then from where the one before ends, then from the measurements, where that ends
  /// better. Nothing is tried where more than a quarter of all are.
  void settle_lost(const std::vector<double>& promised, const Settling& settling, const Point& from,
                   Point& point, std::vector<Reduced>& reduced);
  /// All windows from where they are, or from the measurements; the equations where they end.
  std::vector<Reduced> settle_all(const Settling& settling, Point& point);
  /// Some windows once more from the measurements, where that ends better.
  void settle_anew(const std::vector<int>& windows, const Settling& settling, Point& point,
                   std::vector<Reduced>& reduced);
  /// Halves the steps of initial states that made their windows worse, as a touchdown missed or gained does:
  /// the other windows' steps are none of their business. Where the parameters move too, a window may lose a
  /// little.
  void shorten(const Point& from, const std::vector<Reduced>& before, Point& to, std::vector<Reduced>& after);
  /// The equations at hand promise one more step of every initial state. Where it would still matter it is
  /// tried: taken when the window is the better for it, and its residuals are those that are there, not the
  /// promised.
  void take_last_step(Point& point, std::vector<Reduced>& reduced);

 private:
  Reduced reduce_if_it_runs(int window, const Point& point);
  /// The state in which the window that ends where this one begins ends.
  std::optional<Eigen::VectorXd> end_of_the_one_before(int window, int before, const Point& point);
  /// The window from other starts, where that ends better.
  void try_start(int window, const Eigen::VectorXd& start, const Settling& settling, Point& point,
                 Reduced& reduced);
  void try_from_before(int window, int before, const Settling& settling, Point& point, Reduced& reduced);
  void try_from_measurements(int window, const Settling& settling, Point& point, Reduced& reduced);
  /// Work on each window after that on the one before (-1: none) is done.
  void in_turn(const std::function<void(int window, int before)>& work);
  std::vector<Reduced> reduce_those_that_run(const std::vector<int>& windows, const Point& point);
  /// The equations of those windows that are better at `point` than there; of the others raw_sse alone, since
  /// the slopes are most of the work.
  std::vector<Reduced> reduce_those_better(const std::vector<int>& windows, const Point& point,
                                           const std::vector<Reduced>& than);

  PredictorPool& pool_;
  const std::vector<FreeParameter>& parameters_;
  Eigen::VectorXd units_;
};

/// The initial states of all windows, the parameters as they are; the equations there.
std::vector<Reduced> settle_all(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                const Settling& settling, Point& at);

/// Does a window's squared error mean a root mean square residual of more than `fits` floors?
bool is_above_floor(const Data& data, int window, double sse, double fits = kFits);

/// The windows that are above the floor where they are.
std::vector<int> above_floor(const Data& data, const std::vector<Reduced>& reduced, double fits = kFits);

/// The windows that are not linear in where they begin.
std::vector<int> curved(const std::vector<Reduced>& reduced);

}  // namespace plumbline::validation
