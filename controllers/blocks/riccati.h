// Linear quadratic regulators: over a stance of finite length, over infinitely many stances with jumps
// between them, for a constant system, and for a discrete one. No allocation; the standard library only.
#pragma once

#include "controllers/blocks/matrix.h"

namespace plumbline::controllers {

/// A linear system at one time: dx/dt = a x + b u.
template <int N, int M>
struct LinearSystem {
  Matrix<N, N> a;
  Matrix<N, M> b;
};

/// The cost's weights: the integral of x' state x + u' input u.
template <int N, int M>
struct Weights {
  Matrix<N, N> state;
  Matrix<M, M> input;
};

/// The feedback u = -K x that the cost matrix asks for: K = R^-1 B' P.
template <int N, int M>
Matrix<M, N> gain(const Matrix<N, N>& cost, const LinearSystem<N, M>& system, const Weights<N, M>& weights) {
  return solve(weights.input, system.b.transposed() * cost);
}

/// -dP/dt = Q - P B R^-1 B' P + P A + A' P (Kwakernaak and Sivan, Linear Optimal Control Systems,
/// section 3.3).
template <int N, int M>
Matrix<N, N> riccati_rate(const Matrix<N, N>& cost, const LinearSystem<N, M>& system,
                          const Weights<N, M>& weights) {
  const Matrix<N, N> drift = cost * system.a;
  const Matrix<M, N> feedback = gain(cost, system, weights);
  return weights.state - (cost * system.b) * feedback + drift + drift.transposed();
}

/// Integrates the Riccati equation from `cost` at the end back to the beginning, in `steps` Runge-Kutta steps
/// of fourth order. `system_at(i)` gives the system at i half steps after the beginning. `gains`, unless
/// null, gets steps + 1 gains, the n-th for n steps after the beginning. Returns the cost matrix at the
/// beginning.
template <int N, int M, class SystemAt>
Matrix<N, N> riccati_backward(Matrix<N, N> cost, const SystemAt& system_at, const Weights<N, M>& weights,
                              double duration, int steps, Matrix<M, N>* gains) {
  const double h = duration / steps;
  for (int n = steps; n > 0; --n) {
    const LinearSystem<N, M> late = system_at(2 * n), middle = system_at(2 * n - 1),
                             early = system_at(2 * n - 2);
    if (gains != nullptr) {
      gains[n] = gain(cost, late, weights);
    }
    const Matrix<N, N> k1 = riccati_rate(cost, late, weights);
    const Matrix<N, N> k2 = riccati_rate(cost + 0.5 * h * k1, middle, weights);
    const Matrix<N, N> k3 = riccati_rate(cost + 0.5 * h * k2, middle, weights);
    const Matrix<N, N> k4 = riccati_rate(cost + h * k3, early, weights);
    cost = cost + (h / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    if (gains != nullptr && n == 1) {
      gains[0] = gain(cost, early, weights);
    }
  }
  return cost;
}

/// The cost before a jump x -> jump*x that is followed by `cost`, with a penalty once in a stride (jump
/// Riccati equation).
template <int N>
Matrix<N, N> before_jump(const Matrix<N, N>& cost, const Matrix<N, N>& jump, const Matrix<N, N>& penalty) {
  return jump.transposed() * cost * jump + penalty;
}

/// How an iteration for a periodic solution ended.
struct Convergence {
  int strides = 0;
  bool reached = false;
};

/// Infinitely many stances with jumps between them: integrates back until two strides' cost matrices at
/// touchdown agree to `tolerance` of the largest entry, at most `most` strides. `cost` begins as the cost at
/// the last lift-off and ends as the periodic one at touchdown.
template <int N, int M, class SystemAt>
Convergence riccati_periodic(Matrix<N, N>& cost, const SystemAt& system_at, const Weights<N, M>& weights,
                             const Matrix<N, N>& jump, const Matrix<N, N>& penalty, double duration,
                             int steps, Matrix<M, N>* gains, double tolerance = 1e-6, int most = 200) {
  Convergence result;
  Matrix<N, N> before;
  Matrix<N, N> at_liftoff = cost;
  for (result.strides = 1; result.strides <= most; ++result.strides) {
    cost = riccati_backward(at_liftoff, system_at, weights, duration, steps, gains);
    if (result.strides > 1 && distance(cost, before) <= tolerance * distance(cost, Matrix<N, N>{})) {
      result.reached = true;
      return result;
    }
    before = cost;
    at_liftoff = before_jump(cost, jump, penalty);
  }
  return result;
}

/// x_next = a x + b u with the cost of infinitely many steps: the gain of u = -K x, by iterating the discrete
/// Riccati equation P = Q + A' P (A - B K) at most `most` times.
template <int N, int M>
Matrix<M, N> discrete_lqr(const LinearSystem<N, M>& system, const Weights<N, M>& weights, int most = 10000) {
  Matrix<N, N> cost = weights.state;
  Matrix<M, N> feedback;
  for (int n = 0; n < most; ++n) {
    const Matrix<M, N> pull = system.b.transposed() * cost;
    feedback = solve(weights.input + pull * system.b, pull * system.a);
    const Matrix<N, N> next = weights.state + system.a.transposed() * cost * (system.a - system.b * feedback);
    const double change = distance(next, cost), size = distance(next, Matrix<N, N>{});
    cost = next;
    if (change <= 1e-13 * size) {
      break;
    }
  }
  return feedback;
}

}  // namespace plumbline::controllers
