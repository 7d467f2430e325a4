// Small matrices of a size that is known when compiled: no allocation, the standard library only.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace plumbline::controllers {

/// R x C numbers, row by row; all zero unless given.
template <int R, int C>
struct Matrix {
  std::array<double, static_cast<std::size_t>(R) * static_cast<std::size_t>(C)> values{};

  double& operator()(int r, int c) { return values[static_cast<std::size_t>(r * C + c)]; }
  double operator()(int r, int c) const { return values[static_cast<std::size_t>(r * C + c)]; }
  /// Of a column.
  double& operator[](int r) { return values[static_cast<std::size_t>(r * C)]; }
  double operator[](int r) const { return values[static_cast<std::size_t>(r * C)]; }

  static Matrix diagonal(const std::array<double, static_cast<std::size_t>(R)>& entries) {
    static_assert(R == C);
    Matrix result;
    for (int n = 0; n < R; ++n) {
      result(n, n) = entries[static_cast<std::size_t>(n)];
    }
    return result;
  }
  static Matrix identity() {
    std::array<double, static_cast<std::size_t>(R)> ones{};
    ones.fill(1.0);
    return diagonal(ones);
  }
  Matrix<C, R> transposed() const {
    Matrix<C, R> result;
    for (int r = 0; r < R; ++r) {
      for (int c = 0; c < C; ++c) {
        result(c, r) = (*this)(r, c);
      }
    }
    return result;
  }
};

template <int R, int C>
Matrix<R, C> operator+(Matrix<R, C> a, const Matrix<R, C>& b) {
  for (std::size_t n = 0; n < a.values.size(); ++n) {
    a.values[n] += b.values[n];
  }
  return a;
}

template <int R, int C>
Matrix<R, C> operator*(double factor, Matrix<R, C> a) {
  for (double& value : a.values) {
    value *= factor;
  }
  return a;
}

template <int R, int C>
Matrix<R, C> operator-(const Matrix<R, C>& a, const Matrix<R, C>& b) {
  return a + (-1.0) * b;
}

template <int R, int K, int C>
Matrix<R, C> operator*(const Matrix<R, K>& a, const Matrix<K, C>& b) {
  Matrix<R, C> result;
  for (int r = 0; r < R; ++r) {
    for (int k = 0; k < K; ++k) {
      for (int c = 0; c < C; ++c) {
        result(r, c) += a(r, k) * b(k, c);
      }
    }
  }
  return result;
}

/// Largest absolute difference of two entries.
template <int R, int C>
double distance(const Matrix<R, C>& a, const Matrix<R, C>& b) {
  double most = 0.0;
  for (std::size_t n = 0; n < a.values.size(); ++n) {
    most = std::fmax(most, std::abs(a.values[n] - b.values[n]));
  }
  return most;
}

/// a^-1 b by elimination with row pivots. Of a singular `a` the result holds infinities or is not a number.
template <int N, int C>
Matrix<N, C> solve(Matrix<N, N> a, Matrix<N, C> b) {
  for (int k = 0; k < N; ++k) {
    int pivot = k;
    for (int r = k + 1; r < N; ++r) {
      pivot = std::abs(a(r, k)) > std::abs(a(pivot, k)) ? r : pivot;
    }
    for (int c = 0; c < N; ++c) {
      std::swap(a(k, c), a(pivot, c));
    }
    for (int c = 0; c < C; ++c) {
      std::swap(b(k, c), b(pivot, c));
    }
    for (int r = 0; r < N; ++r) {
      if (r == k) {
        continue;
      }
      const double factor = a(r, k) / a(k, k);
      for (int c = k; c < N; ++c) {
        a(r, c) -= factor * a(k, c);
      }
      for (int c = 0; c < C; ++c) {
        b(r, c) -= factor * b(k, c);
      }
    }
  }
  for (int r = 0; r < N; ++r) {
    for (int c = 0; c < C; ++c) {
      b(r, c) /= a(r, r);
    }
  }
  return b;
}

}  // namespace plumbline::controllers
