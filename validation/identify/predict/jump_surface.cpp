#include "validation/identify/predict/jump_surface.h"

#include <cmath>

namespace plumbline::validation {

JumpSurface surface_at(model::Plant& plant, int index, const Eigen::VectorXd& x) {
  constexpr double kStep = 1e-6;
  const Eigen::Index nz = plant.positions();
  Eigen::VectorXd g(plant.switch_count());
  const auto value_at = [&](const Eigen::VectorXd& state) {
    plant.switches(state.data(), g.data());
    return g[index];
  };
  JumpSurface surface{value_at(x), Eigen::RowVectorXd(nz), 0.0};
  Eigen::VectorXd moved = x;
  for (Eigen::Index i = 0; i < nz; ++i) {
    moved[i] = x[i] + kStep;
    surface.slope[i] = (value_at(moved) - surface.value) / kStep;
    moved[i] = x[i];
  }
  surface.rate = surface.slope.dot(x.segment(nz, nz));
  return surface;
}

Eigen::VectorXd rate_beside(model::Plant& plant, const JumpSurface& surface, const Eigen::VectorXd& x,
                            const double* command, double side) {
  constexpr double kHair = 1e-9;
  Eigen::VectorXd beside = x;
  beside.head(plant.positions()) +=
      surface.slope.transpose() * ((side * kHair - surface.value) / surface.slope.squaredNorm());
  Eigen::VectorXd rate(x.size());
  plant.rate(beside.data(), command, rate.data());
  return rate;
}

void begin_inside(model::Plant& plant, const double* command, const Eigen::VectorXd& deviations,
                  double period, Eigen::VectorXd& x) {
  constexpr double kClose = 2.0;  // deviations
  constexpr double kSoon = 4.0;   // samples in which a deviation is crossed: faster is not at rest
  const Eigen::Index nz = plant.positions();
  for (const model::Plant::Jump& jump : plant.jumps()) {
    const JumpSurface surface = surface_at(plant, jump.index, x);
    const double deviation = surface.slope.cwiseAbs().dot(deviations);
    if (!(std::abs(surface.value) < kClose * deviation) ||
        std::abs(surface.rate) * kSoon * period > deviation) {
      continue;
    }
    Eigen::VectorXd resting = x;
    resting.segment(nz, nz) -= surface.slope.transpose() * (surface.rate / surface.slope.squaredNorm());
    const double above =
        surface.slope.dot(rate_beside(plant, surface, resting, command, 1.0).segment(nz, nz));
    const double below =
        surface.slope.dot(rate_beside(plant, surface, resting, command, -1.0).segment(nz, nz));
    if ((above > 0.0) != (below > 0.0)) {
      continue;
    }
    const double side = above > 0.0 ? 1.0 : -1.0;
    if (side * surface.value < deviation) {
      x = resting;
      x.head(nz) +=
          surface.slope.transpose() * ((side * deviation - surface.value) / surface.slope.squaredNorm());
    }
  }
}

}  // namespace plumbline::validation
