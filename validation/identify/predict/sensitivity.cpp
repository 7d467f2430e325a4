#include "validation/identify/predict/sensitivity.h"

namespace plumbline::validation {

void Sensitivity::step(double h, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, int parts) {
  Z_ = h / parts * A;
  hB_ = h / parts * B;
  square_.noalias() = Z_ * Z_;
  D_.noalias() = Z_ * square_;
  D_ *= -1.0 / 60.0;
  D_ += 0.15 * square_ - 0.6 * Z_;
  D_.diagonal().array() += 1.0;
  factor_.compute(D_);
  before_ = S_;
  begins_ = S_;
  take_part();
  for (int part = 1; part < parts; ++part) {
    begins_ += S_;
    take_part();
  }
  begins_ /= parts;
}

void Sensitivity::take_part() {
  right_.noalias() = (0.4 * Z_ + 0.05 * square_) * S_;
  right_ += S_;
  auto driven = right_.rightCols(hB_.cols());
  driven += hB_;
  driven.noalias() += (square_ / 60.0 - 0.1 * Z_) * hB_;
  S_ = factor_.solve(right_);
}

Eigen::MatrixXd Sensitivity::mean() const {
  Eigen::MatrixXd right = begins_;
  right.noalias() += (square_ / 60.0 - 0.1 * Z_) * begins_;
  auto driven = right.rightCols(hB_.cols());
  driven += 0.5 * hB_;
  driven.noalias() += (square_ / 60.0 - 2.0 / 15.0 * Z_) * hB_;
  return factor_.solve(right);
}

}  // namespace plumbline::validation
