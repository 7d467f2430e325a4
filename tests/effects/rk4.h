// Classical Runge-Kutta steps, so that the laws' tests need no integrator of the project.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace plumbline::effects {

using State = std::vector<double>;
using Rate = std::function<State(const State&)>;

inline State moved(const State& x, const State& rate, double h) {
  State y = x;
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += h * rate[i];
  return y;
}

inline State rk4_step(const Rate& rate, const State& x, double h) {
  const State a = rate(x), b = rate(moved(x, a, h / 2)), c = rate(moved(x, b, h / 2)),
              d = rate(moved(x, c, h));
  State y = x;
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  return y;
}

inline State rk4(const Rate& rate, State x, double duration, int steps) {
  for (int i = 0; i < steps; ++i) x = rk4_step(rate, x, duration / steps);
  return x;
}

}  // namespace plumbline::effects
