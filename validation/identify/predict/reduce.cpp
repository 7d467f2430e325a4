// Normal equations of windows with their initial states eliminated.
#include <utility>

#include "validation/identify/predict/contact_changes.h"
#include "validation/identify/predict/eliminate.h"
#include "validation/identify/predict/estimate.h"
#include "validation/identify/predict/spread.h"

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
  Eigen::MatrixXd X(rows + nx, nx);  // of the window, then of what is known of its start
  X.topRows(rows) = lin.Jx;
  X.bottomRows(nx) = anchor.slope.asDiagonal();
  Eigen::VectorXd r(rows + nx);
  r << lin.r, anchor.r;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows + nx, lin.Jp.cols());
  J.topRows(rows) = lin.Jp * slopes.asDiagonal();
  Eliminated left = eliminate(X, J, r);
  out.curved = predictor.is_curved() || do_contacts_change(predictor);
  out.expansion = predictor.expansion(window, lin.Jx);
  out.raw_sse = r.squaredNorm();
  out.sse = left.sse;
  out.square = predictor.squares(window, left.r.head(rows));
  out.x_H = left.R.transpose() * left.R;
  out.x_shift = std::move(left.step);
  out.x_slope = std::move(left.slope);
  out.H = std::move(left.H);
  out.g = std::move(left.g);
  if (!moving.empty()) {
    out.channel_slopes = sums_by_channel(left.J.topRows(rows), window.count, predictor.channels());
  }
  return out;
}

std::vector<Reduced> reduce(PredictorPool& pool, const std::vector<int>& windows,
                            const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                            const std::vector<Eigen::VectorXd>& x0, const Eigen::VectorXd& units) {
  const Data& data = pool.data();
  std::vector<Reduced> all(windows.size());
  const std::vector<FreeParameter> moving = units.size() > 0 ? parameters : std::vector<FreeParameter>();
  const Eigen::VectorXd slopes = search_slopes(moving, units, theta);
  const auto work = [&](int i) {
    const int w = windows[static_cast<std::size_t>(i)];
    pool.with(w, parameters, theta, [&](Predictor& predictor) {
      const Window& window = data.windows[static_cast<std::size_t>(w)];
      const Eigen::VectorXd& given = x0[static_cast<std::size_t>(w)];
      all[static_cast<std::size_t>(i)] = reduce(
          predictor, window, given.size() > 0 ? given : predictor.initial_state(window), moving, slopes);
    });
  };
  for_each_item(data, static_cast<int>(windows.size()),
                spread_of("reducing a window", pool.model(), moving.size(), work, all));
  return all;
}

}  // namespace plumbline::validation
