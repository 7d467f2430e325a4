// The parts of a Machine that play what no catalogue has.
#include <cmath>

#include "tests/battery/worlds/machine.h"
#include "tests/battery/worlds/outside.h"

namespace plumbline::battery::worlds {

bool Machine::add_outside(const Hidden& effect, std::size_t motor) {
  if (effect.effect == "slow_reversal") {
    loops_.push_back({motor, static_cast<int>(states_++), effect});
    return true;
  }
  if (effect.effect == "creeping_load") {
    loads_.push_back({effect, rig_.place(effect.at)->row, static_cast<int>(states_++)});
    return true;
  }
  if (effect.effect == "tilting_mount") {
    tilting_.push_back({effect, {}, static_cast<int>(states_++)});
    gravities_.assign(3, rig_);
    gravities_[0].gravity = 0.0;
    gravities_[1].tilt = 0.0;
    gravities_[2].tilt = 0.5 * 3.14159265358979323846;
    return true;
  }
  return false;
}

// Gravity is linear in the cosine and the sine of its tilt: its share of the bias is summed from a level
// mounting, and from one that lies on its side.
void Machine::tilt(double angle, const Vector& p, const Vector& v, Vector& bias) const {
  Vector without = Vector::Zero(n_);
  Matrix unused = Matrix::Zero(n_, n_);
  gravities_[0].equations(gravities_[0], p, v, unused, without);
  bias = without;
  const double shares[2] = {std::cos(angle), std::sin(angle)};
  for (std::size_t i = 0; i < 2; ++i) {
    Vector one = Vector::Zero(n_);
    gravities_[i + 1].equations(gravities_[i + 1], p, v, unused, one);
    bias += shares[i] * (one - without);
  }
}

void Machine::equations(const State& x, const Vector& p, const Vector& v, Matrix& links, Vector& bias,
                        State& rate) const {
  rig_.equations(rig_, p, v, links, bias);
  for (const Wandering& one : tilting_) {
    rate[one.state] = one.effect["rate"];
    tilt(rig_.tilt + x[one.state], p, v, bias);
  }
  for (const Wandering& one : loads_) {
    const Carried load = carried(one.effect, {one.row.dot(p), one.row.dot(v), 0.0}, x[one.state],
                                 rig_.gravity * std::cos(rig_.tilt), rig_.gravity * std::sin(rig_.tilt));
    links += load.inertia * one.row * one.row.transpose();
    bias -= load.force * one.row;
    rate[one.state] = load.creeping;
  }
}

}  // namespace plumbline::battery::worlds
