#include "validation/identify/predict/states_by_parts.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "validation/identify/predict/contact_changes.h"

namespace plumbline::validation {
namespace {

/// Of the windows' lengths, tried one after the other before the whole.
constexpr std::array<double, 6> kParts{0.1, 0.2, 0.35, 0.5, 0.65, 0.8};

/// Those of the windows that are well at the floor and settled there: a beginning that is nearly at it may be
/// in a minimum that leads nowhere.
void keep(const Data& part, const std::vector<double>& shares, const Point& at,
          const std::vector<Reduced>& reduced, const std::vector<int>& windows, Grown& grown) {
  constexpr double kWell = 1.05;
  const std::vector<int> above = above_floor(part, reduced, kWell);
  for (const int w : windows) {
    const auto i = static_cast<std::size_t>(w);
    if (is_settled(reduced[i], kRoughly) && !std::binary_search(above.begin(), above.end(), w)) {
      grown.share[i] = shares[i];
      grown.x0[i] = at.x0[i];
    }
  }
}

/// Settles the open windows on the given shares of their lengths, from `at`, and keeps those that come to the
/// floor.
void try_on(const PredictorPool& pool, const std::vector<FreeParameter>& parameters,
            const std::vector<double>& shares, const std::vector<int>& open, Point at, Grown& grown) {
  const Data data = pool.data().beginnings(shares);
  PredictorPool part(pool.model(), data);
  InitialStates states(part, parameters, {});
  states.begin(at);
  std::vector<Reduced> reduced = states.reduce_some(open, at);
  states.settle(open, {kRoughly.steps, kRoughly.much, true}, at, reduced);
  keep(data, shares, at, reduced, open, grown);
}

/// A short beginning, from the measurements, of windows of which none was at the floor.
void begin_anew(const PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                std::vector<int> open, Point at, Grown& grown) {
  constexpr double kShortPart = 0.05;
  const auto has_begun = [&](int w) { return grown.share[static_cast<std::size_t>(w)] > 0.0; };
  open.erase(std::remove_if(open.begin(), open.end(), has_begun), open.end());
  if (open.empty()) {
    return;
  }
  for (const int w : open) {
    at.x0[static_cast<std::size_t>(w)].resize(0);
  }
  try_on(pool, parameters, std::vector<double>(grown.share.size(), kShortPart), open, at, grown);
}

/// Lengthens windows from the part that was at the floor, each by steps that double where it stays there and
/// halve where it does not. One that comes to its end has found its state.
void grow(const PredictorPool& pool, const std::vector<FreeParameter>& parameters, std::vector<int> open,
          Grown& grown, Point& at) {
  constexpr double kFirstStep = 0.1;
  constexpr double kLeastStep = 0.02;
  std::vector<double> step(grown.share.size(), kFirstStep);
  const auto is_done = [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    return grown.share[i] == 0.0 || grown.share[i] >= 1.0 || step[i] < kLeastStep;
  };
  for (;;) {
    open.erase(std::remove_if(open.begin(), open.end(), is_done), open.end());
    if (open.empty()) {
      return;
    }
    std::vector<double> shares(grown.share.size(), 1.0);
    Point tried = at;
    for (const int w : open) {
      const auto i = static_cast<std::size_t>(w);
      shares[i] = std::min(1.0, grown.share[i] + step[i]);
      tried.x0[i] = grown.x0[i];
    }
    const std::vector<double> before = grown.share;
    try_on(pool, parameters, shares, open, tried, grown);
    for (const int w : open) {
      const auto i = static_cast<std::size_t>(w);
      step[i] *= grown.share[i] > before[i] ? 2.0 : 0.5;
      if (grown.share[i] >= 1.0) {
        at.x0[i] = grown.x0[i];
      }
    }
  }
}

/// Where its sensors show the window to begin: does a contact close or open in it? With switches windows are
/// cut in the flights, and each knows its contacts.
bool has_impacts(Predictor& predictor, const Trial& trial, const Window& window) {
  if (!predictor.plant().meets_anything() || !trial.switches.empty()) {
    return false;
  }
  try {
    predictor.residual(window, predictor.search_start(window));
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return false;  // it cannot be followed
  }
  return do_contacts_change(predictor);
}

struct ByParts {
  Point at;
  Grown grown;
  std::vector<Reduced> reduced;
};

ByParts by_parts(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                 const Eigen::VectorXd& theta) {
  const std::size_t count = pool.data().windows.size();
  ByParts found{{theta, {}}, {std::vector<double>(count, 0.0), std::vector<Eigen::VectorXd>(count)}, {}};
  for (const double share : kParts) {
    const Data data = pool.data().beginnings(share);
    PredictorPool part(pool.model(), data);
    const std::vector<Reduced> reduced = settle_all(part, parameters, kRoughly, found.at);
    keep(data, std::vector<double>(count, share), found.at, reduced, data.all_windows(), found.grown);
  }
  found.reduced = settle_all(pool, parameters, kRoughly, found.at);
  InitialStates(pool, parameters, {})
      .settle_anew(above_floor(pool.data(), found.reduced), kRoughly, found.at, found.reduced);
  return found;
}

}  // namespace

bool has_corners(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                 const Eigen::VectorXd& theta) {
  const Data& data = pool.data();
  bool any = false;
  for (std::size_t w = 0; !any && w < data.windows.size(); ++w) {
    const Window& window = data.windows[w];
    bool meets_nothing = false;
    pool.with(static_cast<int>(w), parameters, theta, [&](Predictor& predictor) {
      meets_nothing = !predictor.plant().meets_anything();
      any = !predictor.plant().jumps().empty() ||
            has_impacts(predictor, data.trials[static_cast<std::size_t>(window.trial)], window);
    });
    if (meets_nothing) {
      return any;
    }
  }
  return any;
}

Point states_by_parts(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                      const Eigen::VectorXd& theta) {
  return by_parts(pool, parameters, theta).at;
}

Point grown_states(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                   const Eigen::VectorXd& theta, Grown* how_far) {
  ByParts found = by_parts(pool, parameters, theta);
  const std::vector<double> at_floor(found.reduced.size(), 0.0);  // squares: whatever is above it is lost
  InitialStates states(pool, parameters, {});
  const auto settle_lost = [&] {
    states.settle_lost(at_floor, kRoughly, true, Point(found.at), found.at, found.reduced);
  };
  settle_lost();
  const std::vector<int> open = above_floor(pool.data(), found.reduced);
  begin_anew(pool, parameters, open, found.at, found.grown);
  grow(pool, parameters, open, found.grown, found.at);
  if (!open.empty()) {  // the windows before them may be found by now
    const std::vector<Reduced> grown = states.reduce_some(open, found.at);
    for (const int w : open) {
      found.reduced[static_cast<std::size_t>(w)] = grown[static_cast<std::size_t>(w)];
    }
    settle_lost();
  }
  if (how_far != nullptr) {
    *how_far = std::move(found.grown);
  }
  return found.at;
}

}  // namespace plumbline::validation
