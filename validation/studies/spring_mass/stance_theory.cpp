#include "validation/studies/spring_mass/stance_theory.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plumbline::spring_mass {
namespace {

constexpr int steps = 400;  // of a stance: the matrices are then exact to 1e-9

template <int N, class SystemAt>
Matrix<N, N> transition(const SystemAt& system_at, const std::vector<Matrix<1, N>>& gains, double from,
                        double to) {
  const auto rate = [&](double time, double whole, const Matrix<N, N>& phi) {
    const LinearSystem<N, 1> system = system_at(time);
    const double place = gains.size() < 2 ? 0.0 : time / whole * static_cast<double>(gains.size() - 1);
    const auto low =
        std::min(static_cast<std::size_t>(std::max(0.0, place)), gains.size() < 2 ? 0 : gains.size() - 2);
    const double share = place - static_cast<double>(low);
    const Matrix<1, N> gain =
        gains.size() < 2 ? gains.front() : gains[low] + share * (gains[low + 1] - gains[low]);
    return (system.a - system.b * gain) * phi;
  };
  const double whole = to;
  Matrix<N, N> phi = Matrix<N, N>::identity();
  const double h = (to - from) / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = from + n * h;
    const Matrix<N, N> k1 = rate(t, whole, phi);
    const Matrix<N, N> k2 = rate(t + 0.5 * h, whole, phi + 0.5 * h * k1);
    const Matrix<N, N> k3 = rate(t + 0.5 * h, whole, phi + 0.5 * h * k2);
    const Matrix<N, N> k4 = rate(t + h, whole, phi + h * k3);
    phi = phi + (h / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return phi;
}

template <int N>
Eigen::Matrix<double, N, N> to_eigen(const Matrix<N, N>& matrix) {
  Eigen::Matrix<double, N, N> result;
  for (int r = 0; r < N; ++r) {
    for (int c = 0; c < N; ++c) {
      result(r, c) = matrix(r, c);
    }
  }
  return result;
}

/// The system at half steps of a stance, as the Riccati integration asks for it.
auto sagittal_at(const Gait& gait) {
  return [&gait](int half) { return sagittal_system(gait, gait.stance_time() * half / (2.0 * steps)); };
}

auto vertical_at(const Gait& gait) {
  return [system = vertical_system(gait)](int) { return system; };
}

}  // namespace

double Gait::landing_speed() const { return std::sqrt(2.0 * gravity * hop); }
double Gait::flight_time() const { return 2.0 * landing_speed() / gravity; }

double Gait::stance_time() const {
  // z - z0 + m g/k swings from its touchdown value through the lowest point back to the same value.
  const double omega = std::sqrt(stiffness / mass);
  return 2.0 / omega * (3.14159265358979323846 - std::atan(landing_speed() * omega / gravity));
}

double Gait::height(double time) const {
  const double omega = std::sqrt(stiffness / mass), sag = mass * gravity / stiffness;
  return landing - sag + sag * std::cos(omega * time) - landing_speed() / omega * std::sin(omega * time);
}

double Gait::force(double time) const { return stiffness * (landing - height(time)); }

LinearSystem<2, 1> vertical_system(const Gait& gait) {
  LinearSystem<2, 1> system;
  system.a(0, 1) = 1.0;
  system.b[1] = 1.0 / gait.mass;
  return system;
}

LinearSystem<4, 1> sagittal_system(const Gait& gait, double time) {
  LinearSystem<4, 1> system;
  system.a(0, 1) = 1.0;
  system.a(2, 3) = 1.0;
  system.a(3, 0) = gait.force(time) / gait.inertia;
  system.b[1] = 1.0 / gait.mass;
  system.b[3] = -gait.height(time) / gait.inertia;
  return system;
}

Matrix<2, 2> vertical_flight(const Gait& gait) {
  Matrix<2, 2> flight;
  flight(1, 0) = -gait.gravity / gait.landing_speed();
  flight(1, 1) = -1.0;
  return flight;
}

Matrix<4, 4> sagittal_flight(const Gait& gait) {
  Matrix<4, 4> flight;
  flight(2, 2) = 1.0;
  flight(2, 3) = gait.flight_time();
  flight(3, 3) = 1.0;
  return flight;
}

Matrix<2, 1> vertical_placement(const Gait& gait) {
  Matrix<2, 1> placement;
  placement[0] = 1.0;
  placement[1] = gait.gravity / gait.landing_speed();
  return placement;
}

Matrix<2, 2> vertical_stance(const Gait& gait, const std::vector<Matrix<1, 2>>& gains) {
  const LinearSystem<2, 1> system = vertical_system(gait);
  return transition<2>([&](double) { return system; }, gains, 0.0, gait.stance_time());
}

Matrix<4, 4> sagittal_stance(const Gait& gait, const std::vector<Matrix<1, 4>>& gains) {
  return transition<4>([&](double time) { return sagittal_system(gait, time); }, gains, 0.0,
                       gait.stance_time());
}

Matrix<1, 2> vertical_lqr(const Gait& gait, double q1, double q2, double r) {
  Matrix<1, 2> gain;
  gain(0, 0) = std::sqrt(q1 / r);
  gain(0, 1) = std::sqrt(q2 / r + 2.0 * gait.mass * gain(0, 0));
  return gain;
}

Regulator<2> vertical_finite(const Gait& gait, const Weights<2, 1>& weights, const Matrix<2, 2>& penalty) {
  Regulator<2> result;
  result.gains.resize(steps + 1);
  result.cost = controllers::riccati_backward(penalty, vertical_at(gait), weights, gait.stance_time(), steps,
                                              result.gains.data());
  return result;
}

Regulator<4> sagittal_finite(const Gait& gait, const Weights<4, 1>& weights, const Matrix<4, 4>& penalty) {
  Regulator<4> result;
  result.gains.resize(steps + 1);
  result.cost = controllers::riccati_backward(penalty, sagittal_at(gait), weights, gait.stance_time(), steps,
                                              result.gains.data());
  return result;
}

Regulator<2> vertical_infinite(const Gait& gait, const Weights<2, 1>& weights, const Matrix<2, 2>& flight,
                               const Matrix<2, 2>& penalty, const Matrix<2, 2>& last) {
  Regulator<2> result;
  result.gains.resize(steps + 1);
  result.cost = last;
  result.strides = controllers::riccati_periodic(result.cost, vertical_at(gait), weights, flight, penalty,
                                                 gait.stance_time(), steps, result.gains.data(), 1e-3)
                       .strides;
  return result;
}

Regulator<4> sagittal_infinite(const Gait& gait, const Weights<4, 1>& weights, const Matrix<4, 4>& penalty) {
  Regulator<4> result;
  result.gains.resize(steps + 1);
  result.cost = penalty;
  result.strides =
      controllers::riccati_periodic(result.cost, sagittal_at(gait), weights, sagittal_flight(gait), penalty,
                                    gait.stance_time(), steps, result.gains.data(), 1e-3)
          .strides;
  return result;
}

template <int N>
std::vector<std::complex<double>> eigenvalues(const Matrix<N, N>& matrix) {
  const Eigen::MatrixXd dynamic = to_eigen(matrix);
  const Eigen::VectorXcd found = Eigen::EigenSolver<Eigen::MatrixXd>(dynamic, false).eigenvalues();
  std::vector<std::complex<double>> values(found.data(), found.data() + found.size());
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
  });
  return values;
}
template std::vector<std::complex<double>> eigenvalues<2>(const Matrix<2, 2>&);
template std::vector<std::complex<double>> eigenvalues<4>(const Matrix<4, 4>&);

double weighted_norm(const Matrix<2, 2>& a, const Matrix<2, 2>& weight) {
  // |a|^2 is the largest eigenvalue of W^-1 a' W a, which is similar to a symmetric matrix.
  const Matrix<2, 2> product = controllers::solve(weight, a.transposed() * weight * a);
  return std::sqrt(std::max(0.0, eigenvalues(product).front().real()));
}

Matrix<2, 2> lyapunov(const Matrix<2, 2>& a, const Matrix<2, 2>& q) {
  Matrix<2, 2> sum = q, term = q;
  for (int n = 0; n < 10000 && distance(term, Matrix<2, 2>{}) > 1e-16 * distance(sum, Matrix<2, 2>{}); ++n) {
    term = a.transposed() * term * a;
    sum = sum + term;
  }
  return sum;
}

double inertia_of(const Gait& gait, const Matrix<4, 4>& stance) {
  const double time = gait.stance_time(), x = stance(0, 3), rate = stance(1, 3);
  const double way = 0.5 * time * x - time * time / 12.0 * rate;  // integral of the cubic
  const double gained = gait.mass * (gait.landing * rate - gait.landing_speed() * x);
  return (gait.mass * gait.gravity * way - gained) / (stance(3, 3) - 1.0);
}

double largest_drift(const Gait& gait, const std::vector<Matrix<1, 2>>& gains, double force) {
  const LinearSystem<2, 1> system = vertical_system(gait);
  const double end = gait.stance_time();
  constexpr int pieces = 200;
  double sum = 0.0;
  for (int n = 0; n < pieces; ++n) {
    const double from = end * (n + 0.5) / pieces;
    sum += std::abs(transition<2>([&](double) { return system; }, gains, from, end)(0, 1)) / gait.mass;
  }
  return sum * end / pieces * force;
}

}  // namespace plumbline::spring_mass
