#include "controllers/atrias_running/planner.h"

#include <algorithm>
#include <cmath>

namespace plumbline::controllers::atrias {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Place of a time among `samples` + 1 entries, and the share of the next one.
struct Place {
  std::size_t low;
  double share;
};
Place place_of(double time, double whole, int samples) {
  const double at = std::clamp(time / whole, 0.0, 1.0) * samples;
  const auto low = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(samples) - 1);
  return {low, at - static_cast<double>(low)};
}

}  // namespace

VerticalHop::VerticalHop(const GaitNumbers& gait)
    : mass_(gait.mass),
      gravity_(gait.gravity),
      stiffness_(gait.stiffness),
      landing_(gait.landing),
      landing_speed_(std::sqrt(2.0 * gait.gravity * gait.hop)),
      omega_(std::sqrt(gait.stiffness / gait.mass)),
      sag_(gait.mass * gait.gravity / gait.stiffness),
      stance_time_(2.0 / omega_ * (pi - std::atan(landing_speed_ * omega_ / gravity_))) {}

double VerticalHop::height(double time) const {
  return landing_ - sag_ + sag_ * std::cos(omega_ * time) - landing_speed_ / omega_ * std::sin(omega_ * time);
}

double VerticalHop::rate(double time) const {
  return -sag_ * omega_ * std::sin(omega_ * time) - landing_speed_ * std::cos(omega_ * time);
}

double VerticalHop::force(double time) const { return stiffness_ * (landing_ - height(time)); }

Planner::Planner(const GaitNumbers& gait) : gait_(gait), hop_(gait) {
  Matrix<2, 2> phi = Matrix<2, 2>::identity();
  transition_[0] = phi;
  const double h = hop_.stance_time() / samples;
  const auto rate = [&](double time, const Matrix<2, 2>& now) {
    Matrix<2, 2> a;
    a(0, 1) = 1.0;
    a(1, 0) = hop_.force(time) / (gait_.mass * hop_.height(time));
    return a * now;
  };
  for (int n = 0; n < samples; ++n) {
    const double t = n * h;
    const Matrix<2, 2> k1 = rate(t, phi), k2 = rate(t + 0.5 * h, phi + 0.5 * h * k1);
    const Matrix<2, 2> k3 = rate(t + 0.5 * h, phi + 0.5 * h * k2), k4 = rate(t + h, phi + h * k3);
    phi = phi + (h / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    transition_[static_cast<std::size_t>(n) + 1] = phi;
  }
  end_ = phi;
}

double Planner::placement(double now, double wanted) const {
  return std::clamp((wanted - end_(1, 1) * now) / end_(1, 0), -gait_.reach, gait_.reach);
}

double Planner::next_speed(double x, double speed) const { return end_(1, 0) * x + end_(1, 1) * speed; }

Reference Planner::at(double time, double x, double speed) const {
  const Place place = place_of(time, hop_.stance_time(), samples);
  const Matrix<2, 2> phi =
      transition_[place.low] + place.share * (transition_[place.low + 1] - transition_[place.low]);
  Reference result;
  result.x = phi(0, 0) * x + phi(0, 1) * speed;
  result.x_rate = phi(1, 0) * x + phi(1, 1) * speed;
  const double inside = std::clamp(time, 0.0, hop_.stance_time());
  result.z = hop_.height(inside);
  result.z_rate = hop_.rate(inside);
  result.force_z = hop_.force(inside);
  result.force_x = result.force_z * result.x / result.z;
  return result;
}

StanceRegulator::StanceRegulator(const GaitNumbers& gait, const Design& design)
    : stance_time_(VerticalHop(gait).stance_time()),
      gain_z_(std::sqrt(design.q_z / design.r_z)),
      gain_z_rate_(std::sqrt(design.q_z_rate / design.r_z + 2.0 * gait.mass * gain_z_)) {
  const VerticalHop hop(gait);
  const auto system_at = [&](int half) {
    const double time = stance_time_ * half / (2.0 * samples);
    LinearSystem<4, 1> system;
    system.a(0, 1) = 1.0;
    system.a(2, 3) = 1.0;
    system.a(3, 0) = hop.force(time) / gait.inertia;
    system.b[1] = 1.0 / gait.mass;
    system.b[3] = -hop.height(time) / gait.inertia;
    return system;
  };
  const Weights<4, 1> weights{Matrix<4, 4>::diagonal(design.q), Matrix<1, 1>::diagonal({design.r_x})};
  const Matrix<4, 4> penalty = Matrix<4, 4>::diagonal(design.h);
  if (!design.infinite) {
    riccati_backward(penalty, system_at, weights, stance_time_, samples, gains_.data());
    return;
  }
  Matrix<4, 4> flight;  // the deadbeat placement leaves no horizontal error; pitch turns on
  flight(2, 2) = 1.0;
  flight(2, 3) = 2.0 * hop.landing_speed() / gait.gravity;
  flight(3, 3) = 1.0;
  Matrix<4, 4> cost = penalty;
  riccati_periodic(cost, system_at, weights, flight, penalty, stance_time_, samples, gains_.data());
}

Matrix<1, 4> StanceRegulator::gains(double time) const {
  const Place place = place_of(time, stance_time_, samples);
  return gains_[place.low] + place.share * (gains_[place.low + 1] - gains_[place.low]);
}

void SpeedAdaptation::learn(double wanted, double achieved) {
  const double error = achieved - wanted;
  sum_ww_ += wanted * wanted;
  sum_w_ += wanted;
  sum_we_ += wanted * error;
  sum_e_ += error;
  ++count_;
}

double SpeedAdaptation::foretold(double wanted) const {
  if (count_ < wait_ || count_ == 0) {
    return 0.0;
  }
  const double spread = count_ * sum_ww_ - sum_w_ * sum_w_;
  if (spread < 1e-6 * count_ * count_) {
    return sum_e_ / count_;  // one wanted speed only: no slope to be told
  }
  const double slope = (count_ * sum_we_ - sum_w_ * sum_e_) / spread;
  return slope * wanted + (sum_e_ - slope * sum_w_) / count_;
}

}  // namespace plumbline::controllers::atrias
