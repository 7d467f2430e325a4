#include "tests/battery/worlds/visibility.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace plumbline::battery::worlds {
namespace {

constexpr double kWindow = 0.5;  // s
constexpr double kMove = 1e-3;   // of a deviation, for slopes; moves of states are that share of their ranges

double floor_of(const Sensor& sensor) {
  return std::sqrt(sensor.resolution * sensor.resolution / 12.0 + sensor.noise * sensor.noise);
}

/// Readings of a window in floors, one behind the other.
Eigen::VectorXd shown(const Rig& rig, const Motion& motion, Eigen::Index first, Eigen::Index count,
                      double period) {
  const auto sensors = static_cast<Eigen::Index>(rig.sensors.size());
  Eigen::VectorXd all(sensors * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    all.segment(k * sensors, sensors) = readings_at(rig, motion, first + k, period);
  }
  for (Eigen::Index s = 0; s < sensors; ++s) {
    const double floor = floor_of(rig.sensors[static_cast<std::size_t>(s)]);
    for (Eigen::Index k = 0; k < count; ++k) {
      all[k * sensors + s] /= floor;
    }
  }
  return all;
}

struct Window {
  Eigen::Index first, count;
};

class Seen {
 public:
  explicit Seen(const Recording& truth) : truth_(truth) {}

  Eigen::VectorXd run(const Rig& rig, const Window& window, const Eigen::VectorXd* moved = nullptr) const {
    const Machine machine(rig, truth_.locked, truth_.start);
    // What only bristles under a foot know is as it was.
    const Vector bristles =
        truth_.motion.bristles.cols() > 0 ? Vector(truth_.motion.bristles.col(window.first)) : Vector();
    State x = machine.state_of(truth_.motion.positions.col(window.first),
                               truth_.motion.rates.col(window.first), bristles);
    if (moved != nullptr) {
      x.head(2 * machine.positions()) += *moved;
    }
    const Motion motion = machine.run(
        x, window.first, window.count, truth_.period,
        [&](Eigen::Index k, const Eigen::VectorXd&, Vector& u) { u = truth_.motion.commands.col(k); });
    return shown(rig, motion, 0, window.count, truth_.period);
  }

  Eigen::VectorXd measured(const Window& window) const {
    return shown(truth_.rig, truth_.motion, window.first, window.count, truth_.period);
  }

  /// Ranges of positions and rates over the recording, in the state of `rig`.
  Eigen::VectorXd ranges(const Rig& rig) const {
    const Machine machine(rig, truth_.locked, truth_.start);
    Eigen::VectorXd least = Eigen::VectorXd::Constant(2 * machine.positions(), 1e300);
    Eigen::VectorXd most = -least;
    for (Eigen::Index k = 0; k < truth_.motion.positions.cols(); ++k) {
      const State x = machine.state_of(truth_.motion.positions.col(k), truth_.motion.rates.col(k));
      const Eigen::VectorXd head = x.head(least.size());
      least = least.cwiseMin(head);
      most = most.cwiseMax(head);
    }
    return (most - least).cwiseMax(1e-6);
  }

 private:
  const Recording& truth_;
};

}  // namespace

double visibility(const Recording& recording, const Rig& without, const std::vector<Unknown>& stated) {
  const Seen seen(recording);
  const Eigen::VectorXd steps = 1e-4 * seen.ranges(without);
  const auto numbers = static_cast<Eigen::Index>(stated.size());
  const auto count = static_cast<Eigen::Index>(std::lround(kWindow / recording.period));
  // Normal equations of the stated numbers, each a priori 0 with deviation 1.
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(numbers, numbers);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(numbers);
  double squares = 0.0;
  double rows = 0.0;
  for (Eigen::Index first = 0; first + count <= recording.motion.positions.cols(); first += count) {
    const Window window{first, count};
    const Eigen::VectorXd here = seen.run(without, window);
    Eigen::VectorXd r = seen.measured(window) - here;
    Eigen::MatrixXd by_state(r.size(), steps.size());
    for (Eigen::Index i = 0; i < steps.size(); ++i) {
      Eigen::VectorXd moved = Eigen::VectorXd::Zero(steps.size());
      moved[i] = steps[i];
      by_state.col(i) = (seen.run(without, window, &moved) - here) / steps[i];
    }
    Eigen::MatrixXd by_number(r.size(), numbers);
    for (Eigen::Index i = 0; i < numbers; ++i) {
      Rig moved = without;
      stated[static_cast<std::size_t>(i)].move(moved, kMove);
      by_number.col(i) = (seen.run(moved, window) - here) / kMove;
    }
    // Where the window begins is free.
    Eigen::MatrixXd both(r.size(), numbers + 1);
    both << by_number, r;
    const Eigen::VectorXd scale = by_state.colwise().norm().cwiseMax(1e-12);
    by_state = by_state * scale.cwiseInverse().asDiagonal();
    both -= by_state * by_state.colPivHouseholderQr().solve(both);
    A += both.leftCols(numbers).transpose() * both.leftCols(numbers);
    b += both.leftCols(numbers).transpose() * both.col(numbers);
    squares += both.col(numbers).squaredNorm();
    rows += static_cast<double>(r.size());
  }
  const double explained = numbers > 0 ? b.dot(A.ldlt().solve(b)) : 0.0;
  const double left = std::max(squares - explained, 0.0);
  return std::sqrt(1.0 + left / rows);
}

}  // namespace plumbline::battery::worlds
