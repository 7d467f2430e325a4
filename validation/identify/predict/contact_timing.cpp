// Predicted instants of touchdown and lift-off against those that a contact switch shows.
#include <algorithm>
#include <cmath>

#include "validation/identify/predict/windows.h"

namespace plumbline::validation {
namespace {

/// Cubic through the depths and rates at both ends of a piece of length h, at the share s of it.
double depth_at(const model::FootDepth& a, const model::FootDepth& b, double h, double s) {
  const double t = 1.0 - s;
  return t * t * ((1.0 + 2.0 * s) * a.depth + s * h * a.rate) +
         s * s * ((3.0 - 2.0 * s) * b.depth - t * h * b.rate);
}

/// Where the cubic is zero, by halving: it has opposite signs at the ends.
double zero_of(const model::FootDepth& a, const model::FootDepth& b, double h) {
  constexpr int kHalvings = 30;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const bool before = (depth_at(a, b, h, middle) > 0.0) == (a.depth > 0.0);
    (before ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Where a straight line from a to b, which have different signs, is zero. The integrator's steps in the
/// ground are short.
double share_of(double a, double b) { return a == b ? 0.5 : std::clamp(a / (a - b), 0.0, 1.0); }

/// A predicted instant that is farther off counts as none, and costs at most as much as one that is as far
/// off: a foot that just leaves the ground in one motion and just not in the other must not outweigh all
/// else; s.
constexpr double kFarthest = 0.01;

/// Slower than this a foot does not cross the surface, it lies on it; m/s.
constexpr double kSlowest = 1e-4;

/// Where an instant that was not predicted between 0 and `end` counts as: outside of that, as near to `time`
/// as it can be. Just behind the window's end it would else be as far off as one that does not come at all.
double unseen(double time, double end, double farthest) {
  const double before = std::max(0.0, time);
  const double behind = std::max(0.0, end - time);
  return before < std::min(behind, farthest) ? time - before : time + std::min(behind, farthest);
}

}  // namespace

// Samples `from` to `to` around `first` without those on the other side of a gap, or of an impact, which are
// another motion. Where too few would be left the impact is taken in.
void Predictor::stay_in_phase(Eigen::Index first, Eigen::Index& from, Eigen::Index& to) const {
  constexpr Eigen::Index kFewest = 5;
  for (const Stretch& stretch : trial_.stretches) {
    if (stretch.first <= first && first < stretch.end) {
      from = std::max(from, stretch.first);
      to = std::min(to, stretch.end - 1);
    }
  }
  Eigen::Index begin = from;
  Eigen::Index end = to;
  for (const ContactEvent& event : trial_.contact_events) {
    (event.sample <= first ? begin : end) =
        event.sample <= first ? std::max(begin, event.sample) : std::min(end, event.sample - 1);
  }
  if (end - begin + 1 >= kFewest) {
    from = begin;
    to = end;
  }
}

Predictor::Crossing Predictor::nearest_crossing(int foot, double threshold, bool touchdown, double time,
                                                double farthest) {
  Crossing nearest;
  nearest.time = time + farthest;
  // How far the foot's vertical force is above the threshold.
  const auto excess = [&](Eigen::Index node) {
    return plant_.touches(states_.col(node).data())[static_cast<std::size_t>(foot)].force.z() - threshold;
  };
  const auto is_closed = [&](const model::FootDepth& at, Eigen::Index node) {
    return at.depth > 0.0 && (threshold == 0.0 || excess(node) > 0.0);
  };
  model::FootDepth before = plant_.foot_depth(foot, states_.col(0).data());
  bool closed = is_closed(before, 0);
  for (Eigen::Index n = 0; n + 1 < nodes_; ++n) {
    const model::FootDepth behind = plant_.foot_depth(foot, states_.col(n + 1).data());
    const bool closes = is_closed(behind, n + 1);
    if (closed != closes && closes == touchdown) {
      const double h = length_of(n);
      const double share = threshold == 0.0 ? zero_of(before, behind, h) : share_of(excess(n), excess(n + 1));
      const double at = node_times_[static_cast<std::size_t>(n)] + share * h;
      if (std::abs(at - time) < std::abs(nearest.time - time)) {
        nearest = {n, share, at, (1.0 - share) * before.rate + share * behind.rate};
      }
    }
    before = behind;
    closed = closes;
  }
  if (nearest.node < 0) {
    nearest.time = unseen(time, node_times_[static_cast<std::size_t>(nodes_ - 1)], farthest);
  }
  return nearest;
}

std::vector<Predictor::Crossing> Predictor::crossings_of(const Window& window) {
  std::vector<Crossing> all;
  for (const int e : window.events) {
    const ContactEvent& event = trial_.contact_events[static_cast<std::size_t>(e)];
    const int foot = foot_of_switch_[static_cast<std::size_t>(event.record)];
    if (foot < 0 || !plant_.meets_ground()) {
      all.push_back({});
      all.back().time = event.time - trial_.time[window.first] + kFarthest;
    } else {
      const SwitchRecord& record = trial_.switches[static_cast<std::size_t>(event.record)];
      const double late = plant_.switch_lateness(record.name, event.touchdown);
      all.push_back(nearest_crossing(foot, plant_.model().find_switch(record.name)->threshold,
                                     event.touchdown, event.time - late - trial_.time[window.first],
                                     kFarthest));
      all.back().time += late;
    }
  }
  return all;
}

void Predictor::timing_residuals(const Window& window, Eigen::VectorXd& r) {
  const std::vector<Crossing> crossings = crossings_of(window);
  for (std::size_t e = 0; e < crossings.size(); ++e) {
    const ContactEvent& event = trial_.contact_events[static_cast<std::size_t>(window.events[e])];
    r[window.count * channels() + static_cast<Eigen::Index>(e)] =
        (event.time - trial_.time[window.first] - crossings[e].time) / timing_floor(trial_, event.record);
  }
}

// The depth is what it is at the instant t (zero, or where the force is at the switch's threshold, which
// moves little): dt = -(d(depth)/dx dx + d(depth)/dp dp) / (rate of the depth), and as much later as the
// switch.
void Predictor::timing_slopes(const Window& window, const std::vector<Crossing>& crossings, Eigen::Index node,
                              const Eigen::MatrixXd& before, const Eigen::MatrixXd& behind,
                              const std::vector<model::ParameterId>& ids, Linearisation& out) {
  for (std::size_t e = 0; e < crossings.size(); ++e) {
    const Crossing& crossing = crossings[e];
    if (crossing.node != node || std::abs(crossing.rate) < kSlowest) {
      continue;
    }
    const ContactEvent& event = trial_.contact_events[static_cast<std::size_t>(window.events[e])];
    const int foot = foot_of_switch_[static_cast<std::size_t>(event.record)];
    const std::string& name = trial_.switches[static_cast<std::size_t>(event.record)].name;
    const Eigen::Index nz = plant_.positions();
    const Eigen::Index nx = plant_.states();
    const Eigen::MatrixXd S =
        (1.0 - crossing.share) * before.topRows(nz) + crossing.share * behind.topRows(nz);
    const Eigen::RowVectorXd slope = plant_.depth_slope(foot, states_.col(node).data()) * S;
    const double scale = -1.0 / (crossing.rate * timing_floor(trial_, event.record));
    const Eigen::Index row = window.count * channels() + static_cast<Eigen::Index>(e);
    out.Jx.row(row) = scale * slope.head(nx);
    out.Jp.row(row) =
        scale * (slope.tail(slope.size() - nx) + plant_.depth_slope(foot, states_.col(node).data(), ids)) +
        plant_.switch_lateness_slope(name, event.touchdown, ids) / timing_floor(trial_, event.record);
  }
}

}  // namespace plumbline::validation
