#include "validation/identify/predict/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "validation/identify/predict/box_least_squares.h"
#include "validation/identify/predict/foretell.h"

namespace plumbline::validation {
namespace {

constexpr double kDeviations = 2.0;  // where the cost is looked at
constexpr double kBetter = 0.5;      // of the cost at the floor: less does not move a value by a deviation

/// Change of a train cost that counts: kBetter in units of the residuals' mean square. Far above the floor
/// the residuals are that much larger, and so is what a deviation changes.
double better_than(const Data& data, double cost) {
  double residuals = 0.0;
  for (const int w : data.windows_of(Role::train)) {
    residuals += readings(data, w);
  }
  return kBetter * std::max(1.0, cost / std::max(residuals, 1.0));
}

/// Relative change of such a cost at which a fit stops: well below what counts.
double tolerance_of(const Data& data, double cost) {
  return better_than(data, cost) / 5.0 / std::max(cost, 1e-300);
}

/// The same windows without those of the held-out trials, which have no say.
Data train_only(const Data& all) {
  Data train = all;
  train.windows.clear();
  for (const int w : all.windows_of(Role::train)) {
    train.windows.push_back(all.windows[static_cast<std::size_t>(w)]);
  }
  return train;
}

std::vector<Eigen::VectorXd> states_of_train(const Data& all, const std::vector<Eigen::VectorXd>& x0) {
  std::vector<Eigen::VectorXd> some;
  for (const int w : all.windows_of(Role::train)) {
    some.push_back(x0[static_cast<std::size_t>(w)]);
  }
  return some;
}

/// Deviations of a parameter: in its own unit, and to either side where it is searched.
struct Known {
  double deviation = 0.0, below = 0.0, above = 0.0;
};

/// A fit with one parameter held.
struct Held {
  double distance = 0.0;  // of the parameter, search units
  double rise = 0.0;      // of the cost
  Estimate estimate;
};

class Profile {
 public:
  Profile(PredictorPool& train, const std::vector<FreeParameter>& parameters, const Estimate& at,
          std::vector<Eigen::VectorXd> x0, const Precision& precision, bool look_for_better)
      : pool_(train),
        parameters_(parameters),
        at_(at),
        x0_(std::move(x0)),
        precision_(precision),
        look_for_better_(look_for_better) {
    units_ = search_units(parameters, at.theta);
    room_ = room(parameters, at.theta, units_);
    counts_ = better_than(train.data(), at.cost);
  }

  /// Nothing where a better estimate was met.
  std::optional<Known> known(Eigen::Index p) {
    Known result{precision_.deviations[p], precision_.below[p], precision_.above[p]};
    if (is_collapsed(p)) {
      const double largest = largest_told(p);
      result.deviation = std::max(result.deviation, (largest - at_.theta[p]) / kDeviations);
      result.above = std::log(largest / at_.theta[p]) / kDeviations;
      return result;
    }
    if (precision_.inverse(p, p) * kPriorPrecision > 0.5) {
      return result;  // hardly seen
    }
    for (const double side : {1.0, -1.0}) {
      const std::optional<Way> way = on_side(p, side);
      if (!way) {
        return {};
      }
      const double own = std::abs(value(p, side * way->distance) - at_.theta[p]);
      result.deviation = std::max(result.deviation, own / kDeviations);
      double& here = side > 0.0 ? result.above : result.below;
      here = way->at_bound ? kInfinity : std::max(here, way->distance * units_[p] / kDeviations);
    }
    return result;
  }

  /// Would a parameter that has collapsed do as well where slopes tell it? Then `better` is there.
  bool lift(Eigen::Index p) {
    if (!is_collapsed(p)) {
      return false;
    }
    for (const double large : large_values(p)) {
      const std::optional<Held> held = fit_held(p, distance_to(p, large), here());
      if (held && held->rise < counts_) {
        better_ = held->estimate;
        return true;
      }
    }
    return false;
  }

  const Estimate& better() const { return better_; }

 private:
  /// To where the cost has risen.
  struct Way {
    double distance = 0.0;  // search units
    bool at_bound = false;  // it has not risen so far
  };

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kFactor = 2.0;
  static constexpr double kFar = 20.0;        // times its value: known to less than an order is not known
  static constexpr double kAsForetold = 0.6;  // of the rise: the cost need not be a parabola to a tenth

  double search_deviation(Eigen::Index p) const { return precision_.above[p] / units_[p]; }

  /// Of logarithmic scale, and so small that no slope tells it to a factor of e: the others then depend on it
  /// as if it were known.
  bool is_collapsed(Eigen::Index p) const {
    const FreeParameter& parameter = parameters_[static_cast<std::size_t>(p)];
    return parameter.scale == effects::Scale::logarithm && precision_.above[p] > 1.0 &&
           !large_values(p).empty();
  }

  /// Several times what is typical of a parameter, and parts of that, as long as they are well above its
  /// value.
  std::vector<double> large_values(Eigen::Index p) const {
    constexpr double kPart = 0.25;
    constexpr int kParts = 7;
    constexpr double kTimes = 16.0;
    const FreeParameter& parameter = parameters_[static_cast<std::size_t>(p)];
    std::vector<double> values;
    double large = std::min(kTimes * parameter.typical, parameter.upper);
    for (int part = 0; part < kParts && large * kPart > at_.theta[p]; ++part, large *= kPart) {
      values.push_back(large);
    }
    return values;
  }

  /// The largest value of one that has collapsed which the cost does not speak against.
  double largest_told(Eigen::Index p) {
    const double wanted = wanted_rise(p);
    double above = 0.0;
    for (const double large : large_values(p)) {
      const std::optional<Held> held = fit_held(p, distance_to(p, large), here());
      if (held && held->rise < wanted) {
        return above > 0.0 ? std::sqrt(above * large) : large;
      }
      above = large;
    }
    return above;
  }

  /// The longest way that is gone, search units.
  double reach_of(Eigen::Index p) const {
    constexpr double kMost = 20.0;
    const bool is_logarithm = parameters_[static_cast<std::size_t>(p)].scale == effects::Scale::logarithm;
    return is_logarithm ? std::log(kFar) / units_[p] : kMost;
  }

  /// To the bound; infinite stiffness, 1/0, is taken as met at some times the value.
  double room_to_bound(Eigen::Index p, double side) const {
    const double all = side > 0.0 ? room_.upper[p] : -room_.lower[p];
    const FreeParameter& parameter = parameters_[static_cast<std::size_t>(p)];
    const bool to_rigid =
        parameter.scale == effects::Scale::reciprocal && side < 0.0 && !std::isfinite(parameter.upper);
    return to_rigid ? all * (1.0 - 1.0 / kFar) : all;
  }

  double distance_to(Eigen::Index p, double to) const {
    const effects::Scale scale = parameters_[static_cast<std::size_t>(p)].scale;
    return (to_search(scale, to) - to_search(scale, at_.theta[p])) / units_[p];
  }

  /// Of the cost, at two deviations.
  double wanted_rise(Eigen::Index p) const {
    return std::pow(kDeviations * search_deviation(p), 2) / precision_.inverse(p, p);
  }

  Held here() const {
    Held held{0.0, 0.0, at_};
    held.estimate.x0 = x0_;
    return held;
  }

  /// The parameter's value so many search units from here.
  double value(Eigen::Index p, double distance) const {
    return stepped(parameters_, at_.theta, units_, Eigen::VectorXd::Unit(at_.theta.size(), p) * distance)[p];
  }

  /// How far two deviations are; nothing where a better estimate was met.
  std::optional<Way> on_side(Eigen::Index p, double side) {
    const double slopes = search_deviation(p);
    const double wanted = wanted_rise(p);
    const double bound = room_to_bound(p, side);
    const double most = std::min(reach_of(p), bound);
    Held last = here();
    while (last.distance < most) {
      const double next = last.distance == 0.0 ? kDeviations * slopes : kFactor * last.distance;
      const std::optional<Held> held = fit_held(p, side * std::min(next, most), last);
      if (!held) {
        break;  // it cannot be integrated there: no value of these data
      }
      if (look_for_better_ && held->rise < -counts_) {
        better_ = held->estimate;
        return {};
      }
      if (held->rise >= kAsForetold * wanted) {
        return Way{crossing(last, *held, wanted), false};
      }
      last = *held;
    }
    return Way{last.distance, last.distance >= bound};
  }

  /// Where between two fits the cost has risen by so much; the way there is taken as a parabola's.
  static double crossing(const Held& one, const Held& other, double wanted) {
    const double from = std::sqrt(std::max(one.rise, 0.0));
    const double to = std::sqrt(other.rise);
    const double share = (std::sqrt(wanted) - from) / std::max(to - from, 1e-300);
    return one.distance + std::clamp(share, 0.0, 1.0) * (other.distance - one.distance);
  }

  std::optional<Held> fit_held(Eigen::Index p, double to, const Held& from) {
    constexpr int kIterations = 8;
    const double step = to - std::copysign(from.distance, to);
    const Eigen::VectorXd others = precision_.inverse.col(p) / precision_.inverse(p, p) * step;
    Eigen::VectorXd theta = stepped(parameters_, from.estimate.theta, units_, others);
    theta[p] = value(p, to);
    std::vector<FreeParameter> held = parameters_;
    FreeParameter& pinned = held[static_cast<std::size_t>(p)];
    pinned.lower = pinned.upper = theta[p];
    try {
      const Estimate found = gauss_newton(pool_, held, theta, from.estimate.x0,
                                          {kIterations, tolerance_of(pool_.data(), at_.cost), false});
      return Held{std::abs(to), found.cost - at_.cost, found};
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      return {};
    }
  }

  PredictorPool& pool_;
  const std::vector<FreeParameter>& parameters_;
  const Estimate& at_;
  std::vector<Eigen::VectorXd> x0_;
  const Precision& precision_;
  bool look_for_better_;
  double counts_ = 0.0;  // change of the cost that counts
  Eigen::VectorXd units_;
  Room room_;
  Estimate better_;
};

/// All values from those that were met with one of them held, on all windows; nothing where the held-out
/// ones cannot be integrated from there.
std::optional<Estimate> from_there(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                   const Estimate& was, const Estimate& met) {
  constexpr int kIterations = 12;
  std::vector<Eigen::VectorXd> x0 = was.x0;
  const std::vector<int> train = pool.data().windows_of(Role::train);
  for (std::size_t i = 0; i < train.size(); ++i) {
    x0[static_cast<std::size_t>(train[i])] = met.x0[i];
  }
  try {
    return gauss_newton(pool, parameters, met.theta, x0,
                        {kIterations, tolerance_of(pool.data(), was.cost), false});
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return {};
  }
}

/// False where a better estimate was met.
bool profile_all(Profile& profile, const std::vector<int>& which, Profiled& result) {
  for (const int p : which) {
    if (!(result.slopes.deviations[p] > 0.0)) {
      continue;
    }
    const std::optional<Known> known = profile.known(p);
    if (!known) {
      return false;
    }
    result.held.deviations[p] = known->deviation;
    result.held.below[p] = known->below;
    result.held.above[p] = known->above;
  }
  return true;
}

bool lift_any(Profile& profile, const std::vector<int>& which) {
  return std::any_of(which.begin(), which.end(), [&](int p) { return profile.lift(p); });
}

}  // namespace

Profiled profile(PredictorPool& pool, const std::vector<FreeParameter>& parameters, const Estimate& at,
                 const std::vector<int>& which) {
  constexpr int kBegins = 6;
  const Data train = train_only(pool.data());
  const std::vector<int> windows = pool.data().windows_of(Role::train);
  PredictorPool some(pool.model(), train);
  Profiled result;
  result.estimate = at;
  bool may_lift = true;
  bool is_last = false;
  for (int begin = 0;; ++begin) {
    is_last = is_last || begin == kBegins;
    result.slopes = precision_of(pool, windows, parameters, result.estimate);
    result.held = result.slopes;
    Profile one(some, parameters, result.estimate, states_of_train(pool.data(), result.estimate.x0),
                result.slopes, !is_last);
    const bool lifted = !is_last && may_lift && lift_any(one, which);
    if (!lifted && profile_all(one, which, result)) {
      return result;
    }
    may_lift = !lifted;
    const std::optional<Estimate> next = from_there(pool, parameters, result.estimate, one.better());
    const double counts = better_than(pool.data(), result.estimate.cost);
    const double most = result.estimate.cost + (lifted ? counts : -counts);
    if (next && next->cost <= most) {
      result.estimate = *next;
    } else {
      is_last = true;  // not on all windows at once
    }
  }
}

}  // namespace plumbline::validation
