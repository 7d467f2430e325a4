#include "validation/identify/predict/foot_paths.h"

#include <algorithm>
#include <cmath>

namespace plumbline::validation {

std::vector<FootPath> foot_paths(const model::Model& model, const Data& data, double spacing,
                                 Eigen::Index most) {
  std::vector<FootPath> paths;
  for (const Trial& trial : data.trials) {
    Predictor predictor(model, trial, data.predict);
    model::Plant& plant = predictor.plant();
    if (!plant.meets_ground()) {
      continue;
    }
    const Eigen::MatrixXd positions = predictor.measured_positions();
    const auto stride = std::max<Eigen::Index>(1, std::lround(spacing / trial.period));
    const Eigen::Index count = std::min<Eigen::Index>((positions.cols() - 1) / stride + 1, most);
    const std::size_t first = paths.size();
    for (std::size_t f = 0; f < model.feet.size(); ++f) {
      paths.push_back({f, static_cast<double>(stride) * trial.period, Eigen::MatrixXd(4, count)});
    }
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    for (Eigen::Index k = 0; k < count; ++k) {
      x.head(positions.rows()) = positions.col(k * stride);
      const std::vector<model::Touch> touches = plant.touches(x.data());
      for (std::size_t f = 0; f < touches.size(); ++f) {
        paths[first + f].places.col(k) << touches[f].position,
            plant.foot_depth(static_cast<int>(f), x.data()).depth;
      }
    }
  }
  return paths;
}

double depth_reached(std::vector<double> depths) {
  constexpr double kDeepest = 0.05;
  const auto at =
      depths.begin() + static_cast<std::ptrdiff_t>((1.0 - kDeepest) * static_cast<double>(depths.size() - 1));
  std::nth_element(depths.begin(), at, depths.end());
  return *at;
}

}  // namespace plumbline::validation
