#include "validation/identify/predict/eliminate.h"

#include <Eigen/QR>

namespace plumbline::validation {

Eliminated eliminate(const Eigen::MatrixXd& X, const Eigen::MatrixXd& J, const Eigen::VectorXd& r) {
  const Eigen::Index n = X.cols();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(X);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(X.rows(), n);
  Eliminated out;
  out.R = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const auto R = out.R.triangularView<Eigen::Upper>();
  const Eigen::VectorXd Qtr = Q.transpose() * r;
  out.step = R.solve(Qtr);
  out.r = r - Q * Qtr;
  out.sse = out.r.squaredNorm();
  out.H.setZero(J.cols(), J.cols());
  out.g.setZero(J.cols());
  out.slope.setZero(n, J.cols());
  if (J.cols() == 0) {
    return out;  // Eigen's products are not made for matrices without columns
  }
  const Eigen::MatrixXd QtJ = Q.transpose() * J;
  out.slope = R.solve(QtJ);
  // The difference of the rows, not of their products J'J and (Q'J)'Q'J: of those nothing would be left but
  // rounding, and H would not be positive.
  out.J = J;
  out.J.noalias() -= Q * QtJ;
  out.H.selfadjointView<Eigen::Lower>().rankUpdate(out.J.transpose());
  out.H.triangularView<Eigen::StrictlyUpper>() = out.H.transpose();
  out.g = out.J.transpose() * r;
  return out;
}

}  // namespace plumbline::validation
