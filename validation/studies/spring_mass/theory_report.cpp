#include "validation/studies/spring_mass/theory_report.h"

#include <fmt/core.h>

#include <cmath>

namespace plumbline::spring_mass {
namespace {

template <int N>
std::string text_of(const Matrix<N, N>& matrix) {
  std::string text;
  for (int r = 0; r < N; ++r) {
    text += "   ";
    for (int c = 0; c < N; ++c) {
      text += fmt::format(" {:7.2f}", matrix(r, c));
    }
    text += "\n";
  }
  return text;
}

template <int N>
std::string eigenvalue_text(const Matrix<N, N>& matrix) {
  std::string text;
  for (const std::complex<double>& value : eigenvalues(matrix)) {
    const double real = std::abs(value.real()) < 5e-10 ? 0.0 : value.real();
    text += text.empty() ? "" : ", ";
    text += std::abs(value.imag()) < 1e-9 ? fmt::format("{:.3f}", real)
                                          : fmt::format("{:.3f}{:+.3f}i", real, value.imag());
  }
  return text;
}

/// Of constant gains: P of u = -K x for the double integrator with mass m, from the two gains and r.
Matrix<2, 2> cost_of(const Gait& gait, const Matrix<1, 2>& gain, double r) {
  Matrix<2, 2> cost;
  cost(0, 0) = gain(0, 0) * gain(0, 1) * r;
  cost(0, 1) = cost(1, 0) = gait.mass * gain(0, 0) * r;
  cost(1, 1) = gait.mass * gain(0, 1) * r;
  return cost;
}

std::string vertical_text(const Gait& gait) {
  const Matrix<2, 2> flight = vertical_flight(gait);
  const Weights<2, 1> weights = published_vertical_weights(), dear = published_vertical_weights(40.0);
  const Matrix<1, 2> high = vertical_lqr(gait, 100.0, 1.0, weights.input(0, 0));
  const Matrix<1, 2> low = vertical_lqr(gait, 100.0, 1.0, dear.input(0, 0));
  const Matrix<2, 2> high_map = vertical_stance(gait, {high}) * flight;
  const Matrix<2, 2> low_stance = vertical_stance(gait, {low});
  std::string text = "Vertical error (z, z'), section 6.4\n";
  text += fmt::format("  constant gains by LQR: kp {:.0f} N/m, kd {:.0f} N s/m; printed about 6200, 1100\n",
                      high(0, 0), high(0, 1));
  text += fmt::format("  multipliers of T_s T_f: {}; printed 0, 0.09\n", eigenvalue_text(high_map));
  text += fmt::format("  with 40 R (kp {:.0f}, kd {:.0f}): {}; printed 0, 1.4\n", low(0, 0), low(0, 1),
                      eigenvalue_text(low_stance * flight));
  const Regulator<2> periodic =
      vertical_infinite(gait, dear, flight, {}, cost_of(gait, low, dear.input(0, 0)));
  text += fmt::format("  40 R, jump Riccati ({} strides): {}; printed 0, 0.1 after about 3\n",
                      periodic.strides, eigenvalue_text(vertical_stance(gait, periodic.gains) * flight));
  const LinearSystem<2, 1> placed{low_stance * flight, low_stance * vertical_placement(gait)};
  const Weights<2, 1> even{Matrix<2, 2>::identity(), Matrix<1, 1>::identity()};
  const Matrix<1, 2> landing = controllers::discrete_lqr(placed, even);
  text += fmt::format(
      "  40 R, landing height {:+.2f} z {:+.3f} z': {}; printed 0, 0.45 (weights not printed; here all 1)\n",
      -landing(0, 0), -landing(0, 1), eigenvalue_text(placed.a - placed.b * landing));
  text += "\nError bounds (vertical), chapter 7\n";
  const double by_cost = weighted_norm(high_map, cost_of(gait, high, weights.input(0, 0)));
  const double by_one = weighted_norm(high_map, lyapunov(high_map, Matrix<2, 2>::identity()));
  text +=
      fmt::format("  |A_d| weighed with the LQR's cost: {:.3f}, ellipse times {:.2f}; printed 0.19, 1.23\n",
                  by_cost, 1.0 / (1.0 - by_cost));
  text += fmt::format(
      "  |A_d| by the Lyapunov equation, Q = I: {:.4f}, ellipse times {:.2f}; printed 0.869, 7.63\n", by_one,
      1.0 / (1.0 - by_one));
  const double drift = largest_drift(gait, {high}, 1.0);
  text += fmt::format(
      "  drift in one stance: {:.2f} cm for each 100 N of force error; the printed 5 cm are those of a bound "
      "of "
      "{:.0f} N (the bound is lost with figure 7.2)\n",
      1e4 * drift, 0.05 / drift);
  return text;
}

std::string sagittal_text(const Gait& gait) {
  std::string text = "\nx and pitch (x, x', pitch, pitch'), section 6.5\n";
  text += fmt::format(
      "  The trunk's inertia that equation 6.9 asks for by L' = m g x: {:.1f} (finite) and {:.1f} kg m^2 "
      "(infinite); stated: "
      "{:.1f}\n",
      inertia_of(gait, printed_finite_stance()), inertia_of(gait, printed_infinite_stance()), gait.inertia);
  Gait right = gait;
  for (const double inertia : {gait.inertia, 6.6}) {
    right.inertia = inertia;
    const Regulator<4> finite =
        sagittal_finite(right, published_sagittal_weights(), published_sagittal_penalty());
    const Matrix<4, 4> stance = sagittal_stance(right, finite.gains);
    text += fmt::format(
        "  T_s, finite horizon, the repository's weights, inertia {:.1f} kg m^2 (farthest from print: "
        "{:.2f}):\n{}"
        "    eigenvalues {}\n",
        inertia, distance(stance, printed_finite_stance()), text_of(stance), eigenvalue_text(stance));
    const Matrix<4, 4> product = sagittal_flight(right) * stance;
    text += fmt::format("    of T_f T_s: {}\n", eigenvalue_text(product));
  }
  text += "  printed, finite horizon:\n" + text_of(printed_finite_stance());
  text += "    eigenvalues of the print " + eigenvalue_text(printed_finite_stance()) +
          "; printed 3.06, 0.34, 0.23, 0.00\n";
  const Matrix<4, 4> flight = sagittal_flight(gait);
  text += "    T_f T_s of the print (the thesis calls it T_s T_f; same eigenvalues):\n" +
          text_of(flight * printed_finite_stance()) + "    eigenvalues " +
          eigenvalue_text(flight * printed_finite_stance()) + "; printed 0.08+-0.09i\n";
  text += "  printed, infinite horizon: eigenvalues " + eigenvalue_text(printed_infinite_stance()) +
          "; printed 3.10, 0.33, -0.01+-0.08i\n    of T_f T_s " +
          eigenvalue_text(flight * printed_infinite_stance()) + "; printed -0.05+-0.07i\n";
  const Matrix<1, 4> adjust = deadbeat_adjustment(printed_infinite_stance(), flight);
  text += fmt::format(
      "  Placement that cancels pitch (equation 6.11): -[{:.0f} {:.0f} {:.3f} {:+.3f}]; printed -[0 0 0.06 "
      "-0.04]: "
      "the last sign is a slip\n",
      adjust(0, 0), adjust(0, 1), adjust(0, 2), adjust(0, 3));
  text += fmt::format("  Speed error of a pitch of 0.5 rad at touchdown: {:.2f} m/s; printed 0.14\n",
                      0.5 * printed_infinite_stance()(1, 2));
  return text;
}

}  // namespace

Weights<2, 1> published_vertical_weights(double factor_of_r) {
  return {Matrix<2, 2>::diagonal({100.0, 1.0}), Matrix<1, 1>::diagonal({2.5e-6 * factor_of_r})};
}

Weights<4, 1> published_sagittal_weights() {
  return {Matrix<4, 4>::diagonal({1.0, 1.0, 25.0, 1.0}), Matrix<1, 1>::diagonal({0.4e-4})};
}

Matrix<4, 4> published_sagittal_penalty() { return Matrix<4, 4>::diagonal({0.0, 0.0, 5.0, 0.03}); }

Matrix<4, 4> printed_finite_stance() {
  return {{1.68, 0.37, 0.09, 0.03, 4.82, 1.65, 0.25, 0.15, 0.16, 0.03, 0.29, 0.01, 2.41, 0.49, -0.89, 0.00}};
}

Matrix<4, 4> printed_infinite_stance() {
  return {
      {1.70, 0.38, 0.11, 0.03, 4.88, 1.66, 0.28, 0.15, 0.06, -0.01, 0.11, 0.02, 2.62, 0.54, -0.89, -0.07}};
}

Matrix<1, 4> deadbeat_adjustment(const Matrix<4, 4>& stance, const Matrix<4, 4>& flight) {
  const Matrix<4, 4> product = stance * flight;
  Matrix<1, 4> row;
  for (int c = 0; c < 4; ++c) {
    row(0, c) = product(1, c) / stance(1, 0);
  }
  return row;
}

std::string theory_report(const Gait& gait) {
  return fmt::format(
             "Gait: {:.0f} kg on a vertical spring of {:.0f} N/m, landing at {:.2f} m with {:.3f} m/s; "
             "stance {:.4f} s, "
             "flight {:.4f} s, peak force {:.0f} N.\n\n",
             gait.mass, gait.stiffness, gait.landing, gait.landing_speed(), gait.stance_time(),
             gait.flight_time(), gait.force(0.5 * gait.stance_time())) +
         vertical_text(gait) + sagittal_text(gait);
}

}  // namespace plumbline::spring_mass
