// Normal equations of windows with their initial states eliminated.
#include <Eigen/QR>

#include "validation/predict/estimate.h"

namespace plumbline::validation {
namespace {

/// Of rows that are sorted by sample, then by channel; columns x channels.
Eigen::MatrixXd sums_by_channel(const Eigen::MatrixXd& rows, Eigen::Index samples, int channels) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(rows.cols(), channels);
  for (Eigen::Index k = 0; k < samples; ++k) {
    sums += rows.middleRows(k * channels, channels).transpose();
  }
  return sums;
}

}  // namespace

Reduced reduce(Predictor& predictor, const Window& window, const Eigen::VectorXd& x0,
               const std::vector<FreeParameter>& moving, const Eigen::VectorXd& slopes) {
  Reduced out;
  const Linearisation lin = predictor.linearise(window, x0, moving);
  const Predictor::Anchor anchor = predictor.anchor(window, x0, lin.r);
  const Eigen::Index nx = x0.size();
  const Eigen::Index rows = lin.r.size();
  Eigen::MatrixXd X(rows + nx, nx);
  X.topRows(rows) = lin.Jx;
  X.bottomRows(nx) = anchor.slope.asDiagonal();
  Eigen::VectorXd r(rows + nx);  // of the window, then of what is known of its start
  r << lin.r, anchor.r;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(X);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(rows + nx, nx);
  const Eigen::VectorXd Qtr = Q.transpose() * r;
  const auto R = qr.matrixQR().topRows(nx).triangularView<Eigen::Upper>();
  out.curved = predictor.is_curved();
  out.expansion = predictor.expansion(window, lin.Jx);
  out.raw_sse = r.squaredNorm();
  out.sse = out.raw_sse - Qtr.squaredNorm();
  out.square = predictor.squares(window, lin.r - Q.topRows(rows) * Qtr);
  out.x_shift = R.solve(Qtr);
  out.x_H = R.transpose() * R.toDenseMatrix();  // X'X
  out.H.setZero(lin.Jp.cols(), lin.Jp.cols());
  out.g.setZero(lin.Jp.cols());
  out.x_slope.setZero(nx, lin.Jp.cols());
  if (moving.empty()) {
    return out;  // Eigen's products are not made for matrices without columns
  }
  const Eigen::MatrixXd Jp = lin.Jp * slopes.asDiagonal();
  const Eigen::MatrixXd QtJ = Q.topRows(rows).transpose() * Jp;
  out.H.selfadjointView<Eigen::Lower>().rankUpdate(Jp.transpose()).rankUpdate(QtJ.transpose(), -1.0);
  out.H.triangularView<Eigen::StrictlyUpper>() = out.H.transpose();
  out.g = Jp.transpose() * lin.r - QtJ.transpose() * Qtr;
  out.x_slope = R.solve(QtJ);
  const int channels = predictor.channels();
  out.channel_slopes = sums_by_channel(Jp, window.count, channels);
  out.channel_slopes.noalias() -= QtJ.transpose() * sums_by_channel(Q, window.count, channels);
  return out;
}

std::vector<Reduced> reduce(PredictorPool& pool, const std::vector<int>& windows,
                            const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                            const std::vector<Eigen::VectorXd>& x0, const Eigen::VectorXd& units) {
  const Data& data = pool.data();
  std::vector<Reduced> all(windows.size());
  const std::vector<FreeParameter> moving = units.size() > 0 ? parameters : std::vector<FreeParameter>();
  const Eigen::VectorXd slopes = search_slopes(moving, units, theta);
  parallel_for(static_cast<int>(windows.size()), data.threads, [&](int i) {
    const int w = windows[static_cast<std::size_t>(i)];
    pool.with(w, parameters, theta, [&](Predictor& predictor) {
      const Window& window = data.windows[static_cast<std::size_t>(w)];
      const Eigen::VectorXd& given = x0[static_cast<std::size_t>(w)];
      all[static_cast<std::size_t>(i)] = reduce(
          predictor, window, given.size() > 0 ? given : predictor.initial_state(window), moving, slopes);
    });
  });
  return all;
}

}  // namespace plumbline::validation
