#include "simulator/integrate/plate_means.h"

namespace plumbline::integrate {

PlateMeans::PlateMeans(model::Plant& plant)
    : plant_(plant),
      any_(plant.model().has_force_plate()),
      force_(plant.sensors()),
      next_(plant.sensors()),
      impulse_(Eigen::VectorXd::Zero(plant.sensors())) {}

void PlateMeans::begin(double time, const double* x) {
  if (any_) {
    plant_.outputs(x, force_.data());
    impulse_.setZero();
    begin_ = last_ = time;
  }
}

void PlateMeans::add(double time, const double* x) {
  if (any_) {
    plant_.outputs(x, next_.data());
    impulse_ += 0.5 * (time - last_) * (force_ + next_);
    force_ = next_;
    last_ = time;
  }
}

void PlateMeans::write(double* y) const {
  for (int s = 0; any_ && last_ > begin_ && s < plant_.sensors(); ++s) {
    if (plant_.model().sensors[static_cast<std::size_t>(s)].is_force_plate()) {
      y[s] = impulse_[s] / (last_ - begin_);
    }
  }
}

}  // namespace plumbline::integrate
