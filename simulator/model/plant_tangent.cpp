#include "simulator/model/plant_tangent.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "simulator/effects/parameters.h"
#include "simulator/model/asked_torque.h"
#include "simulator/model/supply.h"

namespace plumbline::model {
namespace {

constexpr int kPartsOfTurn = 6;  // of a sample in which a place turns round

/// Is any of these slots' laws, with the parameters that `values` gives, not at its null value?
template <typename Slots, typename Values>
bool any_acts(const Slots& slots, const Values& values) {
  return std::any_of(slots.begin(), slots.end(),
                     [&](const auto& slot) { return !slot.law->is_null(values(slot)); });
}

/// Difference of a rate with and without what `move` does, and undoes when called again.
template <typename Rate, typename Move>
Eigen::VectorXd slope_of_rate(const Rate& rate, const Move& move, int states, double step) {
  Eigen::VectorXd there = Eigen::VectorXd::Zero(states);
  Eigen::VectorXd here = there;
  move();
  rate(there.data());
  move();
  rate(here.data());
  return (there - here) / step;
}

/// On which sides of the points where its force jumps a law is.
std::vector<bool> sides_of_jumps(const ForceSlot& slot, const effects::Motion& at, const double* p) {
  std::vector<double> g;
  slot.law->switches(at, p, g);
  g.resize(static_cast<std::size_t>(slot.law->jumps(p)));
  std::vector<bool> sides;
  sides.reserve(g.size());
  for (const double one : g) {
    sides.push_back(one > 0.0);
  }
  return sides;
}

/// A hidden state that is faster than the sample has its mean far from the middle: of a law that is linear in
/// it, where its rate is the sample's change. Any other is taken in the middle.
double mean_of_fast_state(const ForceSlot& slot, const effects::Motion& at, const SampleMotion& sample,
                          double middle, const double* p) {
  constexpr double kLinear = 1e-3;
  const double wanted = sample.change[slot.state] / sample.period;
  const auto excess = [&](double s) {
    double rate = 0.0;
    slot.law->state_rate(at, &s, p, &rate);
    return rate - wanted;
  };
  const double step = 1e-7 * (1.0 + std::abs(middle));
  const double here = excess(middle);
  const double slope = (excess(middle + step) - here) / step;
  if (!(-slope * sample.period > 1.0)) {
    return middle;
  }
  const double mean = middle - here / slope;
  return std::abs(excess(mean)) <= kLinear * std::abs(here) ? mean : middle;
}

}  // namespace

PlantTangent::PlantTangent(PlantDynamics& plant)
    : plant_(plant),
      bodies_(plant.bodies()),
      S_tree_(plant.map().S_tree()),
      n_tree_(plant.map().tree()),
      nz_(plant.positions()),
      nx_(plant.states()) {}

// d(M^-1 (Q - h))/d(z, w) with effects and torques held: -M^-1 d(M a + h)/d(z, w) at the x and the
// acceleration a that tree_slopes_ was set for. What rotors and pulleys add to M is constant.
void PlantTangent::rigid_tangent() {
  Eigen::MatrixXd by_position;
  Eigen::MatrixXd by_velocity;
  tree_slopes_.inverse_dynamics(by_position, by_velocity);
  rigid_A_.leftCols(nz_).noalias() = -S_tree_.transpose() * by_position * S_tree_;
  rigid_A_.rightCols(nz_).noalias() = -S_tree_.transpose() * by_velocity * S_tree_;
  bodies_.factor().solveInPlace(rigid_A_);
}

// Half of what a place's position and velocity change by over a sample.
effects::Motion PlantTangent::half_change(const ForceSlot& slot, const double* change) const {
  effects::Motion half;
  if (change == nullptr) {
    return half;
  }
  for (const LinearForm::Entry& entry : slot.line.entries) {
    half.position += 0.5 * entry.value * change[entry.index];
    half.velocity += 0.5 * entry.value * change[nz_ + entry.index];
  }
  return half;
}

// Adds the effects' own slopes: scalar differences of each law, no dynamics.
void PlantTangent::effect_tangent(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A) {
  slopes_.setZero(nz_, nx_);
  plant_.aim_rods(x);
  for (const ForceSlot& slot : plant_.forces()) {
    if (slot.active) {
      force_tangent(slot, x, change, A);
    }
    if (slot.active && slot.rod >= 0) {
      rod_tangent(slot, x, A);
    }
  }
  plant_.feet().add_slopes(bodies_.tree(), x, plant_.on_ground(), change, slopes_, A);
  if (plant_.links() != nullptr) {
    link_tangent(*plant_.links(), x, change, A);
  }
  bodies_.accelerate_in_place(slopes_);
  A.middleRows(nz_, nz_) += slopes_;
  plant_.losses().add_slopes(x, change, A);
}

// How far the place may move either way without a jump: where a stop has just been met or left, a difference
// across its surface is no slope of what follows.
PlantTangent::Reach PlantTangent::reach_beside_jumps(const ForceSlot& slot, const effects::Motion& at,
                                                     double most) const {
  const double* p = values(slot.effect);
  if (slot.law->jumps(p) == 0) {
    return {most, most};
  }
  const std::vector<bool> here = sides_of_jumps(slot, at, p);
  const auto free = [&](double step) {
    return sides_of_jumps(slot, {at.position + step, at.velocity, at.load}, p) == here ? std::abs(step) : 0.0;
  };
  const Reach reach{free(most), free(-most)};
  return reach.up + reach.down > 0.0 ? reach : Reach{most, most};
}

// A difference as wide as the change over a sample is the mean slope on the way, also of a law that jumps
// there. The force's slopes go to slopes_, those of the states' rates to A.
void PlantTangent::force_tangent(const ForceSlot& slot, const double* x, const double* change,
                                 Eigen::Ref<Eigen::MatrixXd> A) {
  const double* p = values(slot.effect);
  const effects::Motion at = plant_.motion(slot, x);
  const int states = slot.state >= 0 ? slot.law->state_count() : 0;
  FewStates s = FewStates::Zero(std::max(states, 1));
  FewStates up = s;
  FewStates down = s;
  for (int k = 0; k < states; ++k) {
    s[k] = x[slot.state + k];
  }
  const auto add = [&](int first, const effects::Motion& plus, const effects::Motion& minus, double width) {
    const double slope = (slot.law->force(plus, s.data(), p) - slot.law->force(minus, s.data(), p)) / width;
    if (states > 0) {
      slot.law->state_rate(plus, s.data(), p, up.data());
      slot.law->state_rate(minus, s.data(), p, down.data());
    }
    for (const LinearForm::Entry& column : slot.line.entries) {
      for (const LinearForm::Entry& row : slot.line.entries) {
        slopes_(row.index, first + column.index) += row.value * slope * column.value;
      }
      for (int k = 0; k < states; ++k) {
        A(slot.state + k, first + column.index) += (up[k] - down[k]) / width * column.value;
      }
    }
  };
  const effects::Motion half = half_change(slot, change);
  const double dq = std::max(1e-10 * (1.0 + std::abs(at.position)), std::abs(half.position));
  const double dv = std::max(1e-6 * (1.0 + std::abs(at.velocity)), std::abs(half.velocity));
  const Reach reach = reach_beside_jumps(slot, at, dq);
  add(0, {at.position + reach.up, at.velocity, at.load}, {at.position - reach.down, at.velocity, at.load},
      reach.up + reach.down);
  add(nz_, {at.position, at.velocity + dv, at.load}, {at.position, at.velocity - dv, at.load}, 2.0 * dv);
  for (int k = 0; k < states; ++k) {
    const double ds = 1e-7 * (1.0 + std::abs(s[k]));
    const double middle = s[k];
    s[k] = middle + ds;
    const double f_up = slot.law->force(at, s.data(), p);
    slot.law->state_rate(at, s.data(), p, up.data());
    s[k] = middle - ds;
    const double f_down = slot.law->force(at, s.data(), p);
    slot.law->state_rate(at, s.data(), p, down.data());
    s[k] = middle;
    for (const LinearForm::Entry& row : slot.line.entries) {
      slopes_(row.index, slot.state + k) += row.value * ((f_up - f_down) / (2.0 * ds));
    }
    for (int r = 0; r < states; ++r) {
      A(slot.state + r, slot.state + k) += (up[r] - down[r]) / (2.0 * ds);
    }
  }
}

// A rod turns with the position: what it pulls at turns with it, and so does the speed that it feels,
//   d(J' f)/dz = ... + f dJ/dz + J' df/dv (dJ/dz w).
void PlantTangent::rod_tangent(const ForceSlot& slot, const double* x, Eigen::Ref<Eigen::MatrixXd> A) {
  const double* p = values(slot.effect);
  const effects::Motion at = plant_.motion(slot, x);
  const double* state = slot.state >= 0 ? x + slot.state : nullptr;
  const Eigen::MatrixXd curvature = plant_.rods().curvature(slot.rod, bodies_.tree(), x);
  const Eigen::VectorXd turn = curvature.transpose() * Eigen::Map<const Eigen::VectorXd>(x + nz_, nz_);
  const double dv = 1e-6 * (1.0 + std::abs(at.velocity));
  effects::Motion plus = at;
  effects::Motion minus = at;
  plus.velocity += dv;
  minus.velocity -= dv;
  const double damping = (slot.law->force(plus, state, p) - slot.law->force(minus, state, p)) / (2.0 * dv);
  slopes_.leftCols(nz_) += slot.law->force(at, state, p) * curvature;
  slopes_.leftCols(nz_) += damping * slot.line.reduced * turn.transpose();
  if (state != nullptr) {
    const int count = slot.law->state_count();
    FewStates up = FewStates::Zero(count);
    FewStates down = up;
    slot.law->state_rate(plus, state, p, up.data());
    slot.law->state_rate(minus, state, p, down.data());
    A.block(slot.state, 0, count, nz_) += (up - down) / (2.0 * dv) * turn.transpose();
  }
}

// Hidden states of the actuators act through the delivered torque.
void PlantTangent::actuator_tangent(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A) {
  const auto has_states = [](const std::vector<ActuatorSlot>& chain) {
    return std::any_of(chain.begin(), chain.end(), [](const ActuatorSlot& slot) { return slot.state >= 0; });
  };
  if (std::none_of(plant_.actuators().begin(), plant_.actuators().end(), has_states)) {
    return;
  }
  Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(x, nx_);
  Eigen::VectorXd up = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd down = Eigen::VectorXd::Zero(nx_);
  for (int m = 0; m < plant_.motors(); ++m) {
    const double commanded = asked_torque(plant_.model(), m, command[m]);
    for (const ActuatorSlot& slot : plant_.actuators()[static_cast<std::size_t>(m)]) {
      for (int k = 0; slot.state >= 0 && k < slot.law->state_count(); ++k) {
        const int column = slot.state + k;
        const double step = 1e-6 * (1.0 + std::abs(x[column]));
        up.setZero();
        down.setZero();
        moved[column] = x[column] + step;
        const double plus = plant_.actuator_chain(m, moved.data(), commanded, up.data());
        moved[column] = x[column] - step;
        const double minus = plant_.actuator_chain(m, moved.data(), commanded, down.data());
        moved[column] = x[column];
        A.col(column) += (up - down) / (2.0 * step);
        A.col(column).segment(nz_, nz_) +=
            bodies_.accelerated(plant_.motor_lines()[static_cast<std::size_t>(m)].reduced) *
            ((plus - minus) / (2.0 * step));
      }
    }
  }
}

void PlantTangent::stiff_jacobian(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A) {
  plant_.deliver_torques(x, command, nullptr);
  bodies_.factor_at(x);
  A.setZero();
  A.block(0, nz_, nz_, nz_).setIdentity();
  effect_tangent(x, nullptr, A);
  actuator_tangent(x, command, A);
}

// A force that turns with the velocity's sign within the sample is averaged over it. To move the rest that a
// law measures from is to move the place the other way: as wide as the sample, so that a sharp knee counts
// with its mean slope, as in force_tangent. A step that would move a jump across the place is taken the other
// way.
void PlantTangent::force_parameter_tangent(const ForceSlot& slot, const SampleMotion& sample, const double* x,
                                           ParameterId id, const effects::Values& moved, double step,
                                           Eigen::Ref<Eigen::VectorXd> column) {
  const effects::Declaration& declaration = slot.law->declaration();
  const bool rest = effects::is_rest(declaration.parameters[static_cast<std::size_t>(id.parameter)]);
  const double* here = values(slot.effect);
  const bool jumps = !rest && slot.law->jumps(here) > 0;
  effects::Values moved_back = moved;
  moved_back[static_cast<std::size_t>(id.parameter)] -= 2.0 * step;
  const int states = slot.state >= 0 ? slot.law->state_count() : 0;
  const effects::Motion mean = plant_.motion(slot, x);
  const double fast = states == 1 ? mean_of_fast_state(slot, mean, sample, x[slot.state], here) : 0.0;
  const double* s = states == 1 ? &fast : slot.state >= 0 ? x + slot.state : nullptr;
  const effects::Motion half = half_change(slot, sample.change);
  const int parts = std::abs(half.velocity) > std::abs(mean.velocity) ? kPartsOfTurn : 1;
  const double reach =
      rest ? std::max(1e-6 * (1.0 + std::abs(mean.position)), std::abs(half.position) / parts) : 0.0;
  Eigen::VectorXd up(states);
  Eigen::VectorXd now(states);
  double force = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double share = (2.0 * i + 1.0) / parts - 1.0;
    effects::Motion at{mean.position + share * half.position + reach, mean.velocity + share * half.velocity,
                       mean.load};
    const bool back = jumps && sides_of_jumps(slot, at, moved.data()) != sides_of_jumps(slot, at, here);
    const double* there = rest ? here : (back ? moved_back : moved).data();
    const double width = (rest ? 2.0 * reach : back ? -step : step) * parts;
    const double before = slot.active ? slot.law->force(at, s, here) : 0.0;
    if (states > 0) {
      slot.law->state_rate(at, s, here, now.data());
    }
    at.position -= 2.0 * reach;
    force += (slot.law->force(at, s, there) - before) / width;
    if (states > 0) {
      slot.law->state_rate(at, s, there, up.data());
      column.segment(slot.state, states) += (up - now) / width;
    }
  }
  column.segment(nz_, nz_) = bodies_.accelerated(slot.line.reduced) * force;
}

// A hidden state that is faster than the sample has its mean far from the middle: it is where its rate is the
// sample's change, to first order (exact for a first-order lag).
void PlantTangent::actuator_parameter_tangent(int motor, const ActuatorSlot& slot, const SampleMotion& sample,
                                              const double* x, const Eigen::MatrixXd& A,
                                              effects::Values moved, double step,
                                              Eigen::Ref<Eigen::VectorXd> column) {
  const double gain = torque_gain(plant_.model().motors[static_cast<std::size_t>(motor)]);
  const double here = asked_torque(plant_.model(), motor, sample.command[motor]);
  Eigen::VectorXd up = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd now = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd mean = Eigen::Map<const Eigen::VectorXd>(x, nx_);
  if (slot.state >= 0) {
    plant_.actuator_chain(motor, x, here, now.data());
    const int count = slot.law->state_count();
    const Eigen::VectorXd behind =
        Eigen::Map<const Eigen::VectorXd>(sample.change + slot.state, count) / sample.period -
        now.segment(slot.state, count);
    if (count == 1) {
      mean[slot.state] += behind[0] / A(slot.state, slot.state);
    } else {  // states that act on each other: a slope's own rate does not depend on where it is
      mean.segment(slot.state, count) +=
          A.block(slot.state, slot.state, count, count).fullPivLu().solve(behind);
    }
  }
  const auto of = [&](const ActuatorSlot& one) { return values(one.effect); };
  const double delay_change = slot.law->delay(moved.data()) - slot.law->delay(values(slot.effect));
  const bool shares = any_acts(plant_.actuators().back(), of);
  if (shares && delay_change == 0.0) {  // what one motor takes, all others lack
    column = slope_of_rate([&](double* xdot) { plant_.rate(mean.data(), sample.command, xdot); },
                           [&] { std::swap(plant_.stored(slot.effect), moved); }, nx_, step);
    return;
  }
  const double before = plant_.actuator_chain(motor, mean.data(), here, now.data());
  const double delayed = here + gain * sample.command_slope[motor] * delay_change;
  std::swap(plant_.stored(slot.effect), moved);
  const double after = plant_.actuator_chain(motor, mean.data(), delayed, up.data());
  std::swap(plant_.stored(slot.effect), moved);
  column = (up - now) / step;
  // Laws that feel what the motor delivers take their share of it: behind a voltage limit all. Those with
  // states (a winding) follow it.
  double acts = after - before;
  for (const ForceSlot& law : plant_.forces()) {
    if (law.active && law.at_motor && law.motor == motor && !law.law->feels_gear_load()) {
      const double* s = law.state >= 0 ? x + law.state : nullptr;
      effects::Motion at = plant_.motion(law, x);
      at.load = before;
      acts -= law.law->force(at, s, values(law.effect));
      if (s != nullptr) {
        law.law->state_rate(at, s, values(law.effect), now.data() + law.state);
      }
      at.load = after;
      acts += law.law->force(at, s, values(law.effect));
      if (s != nullptr) {
        law.law->state_rate(at, s, values(law.effect), up.data() + law.state);
        column.segment(law.state, law.law->state_count()) =
            (up - now).segment(law.state, law.law->state_count()) / step;
      }
    }
  }
  column.segment(nz_, nz_) +=
      bodies_.accelerated(plant_.motor_lines()[static_cast<std::size_t>(motor)].reduced) * (acts / step);
  if (delay_change != 0.0) {
    // The command moves where it jumps, not in the middle of the sample.
    const double hold = sample.hold > 0.0 ? sample.hold : sample.period;
    const double jump = std::fmod(plant_.delay(motor), hold);
    column += (0.5 * hold - jump) * (A * column).eval();
  }
}

void PlantTangent::parameter_tangent(const SampleMotion& sample, const double* x, const Eigen::MatrixXd& A,
                                     ParameterId id, double step, bool refresh,
                                     Eigen::Ref<Eigen::VectorXd> column) {
  column.setZero();
  effects::Values moved = plant_.stored(id.effect);
  moved[static_cast<std::size_t>(id.parameter)] += step;
  for (const ForceSlot& slot : plant_.forces()) {
    if (slot.effect == id.effect && (slot.law->state_count() == 0 || slot.state >= 0)) {
      force_parameter_tangent(slot, sample, x, id, moved, step, column);
      return;
    }
  }
  bool is_found = false;
  for (int m = 0; m < plant_.motors(); ++m) {
    for (const ActuatorSlot& slot : plant_.actuators()[static_cast<std::size_t>(m)]) {
      if (slot.effect == id.effect && !is_found) {
        actuator_parameter_tangent(m, slot, sample, x, A, moved, step, column);
        is_found = true;
      } else if (slot.effect == id.effect) {  // a limb's law stands at several motors
        Eigen::VectorXd of_motor(nx_);
        actuator_parameter_tangent(m, slot, sample, x, A, moved, step, of_motor);
        column += of_motor;
      }
    }
  }
  if (is_found) {
    return;
  }
  for (const ActuatorSlot& slot : plant_.actuators().back()) {
    if (slot.effect == id.effect) {
      column = slope_of_rate([&](double* xdot) { plant_.rate(x, sample.command, xdot); },
                             [&] { std::swap(plant_.stored(id.effect), moved); }, nx_, step);
      return;
    }
  }
  if (bodies_.depend_on(id.effect)) {
    if (bodies_.sits_at_base(id.effect)) {
      base_tangent(sample, id, step, column);
    } else {
      structure_tangent(sample.middle, id, step, refresh, column);
    }
    return;
  }
  plant_.losses().add_parameter_slopes(x, sample.change, id, step, column);
  const std::string& at = plant_.model().effects[static_cast<std::size_t>(id.effect)].at;
  for (const FootSlot& slot : plant_.feet().slots()) {
    if (plant_.model().feet[static_cast<std::size_t>(slot.foot)].answers_to(at)) {
      ground_parameter_tangent(slot, x, id, step, moved, column);
    }
  }
  if (plant_.links() != nullptr && plant_.links()->answers_to(id.effect)) {
    link_parameter_tangent(x, id, step, moved, column);
  }
}

// Where rate() has left the bodies: what the motors' speeds do to the share that a supply leaves them.
// A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void PlantTangent::supply_tangent(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A) {
  const std::vector<ActuatorSlot>& shared = plant_.actuators().back();
  const auto of = [&](const ActuatorSlot& slot) { return values(slot.effect); };
  if (!any_acts(shared, of)) {
    return;
  }
  const Supplies supplies(shared, plant_.motor_lines(), of, x + nz_);
  Eigen::VectorXd full(plant_.motors());
  for (int m = 0; m < plant_.motors(); ++m) {
    full[m] = plant_.actuator_chain(m, x, asked_torque(plant_.model(), m, command[m]), nullptr);
  }
  A.block(nz_, nz_, nz_, nz_) += bodies_.factor().solve(supplies.force_of(full)) * supplies.slope(full);
}

void PlantTangent::tangent(const SampleMotion& sample, const std::vector<ParameterId>& parameters,
                           const Eigen::VectorXd& steps, bool refresh, Eigen::MatrixXd& A,
                           Eigen::MatrixXd& B) {
  const double* x = sample.middle;
  const bool is_due = refresh || rigid_A_.cols() != 2 * nz_;
  rigid_A_.resize(nz_, 2 * nz_);
  Eigen::VectorXd xdot(nx_);
  if (is_due && bodies_.has_loops()) {
    plant_.rate(x, sample.command, xdot.data());
    bodies_.loop_slope(x, plant_.forces_less_bias() + bodies_.h(), Eigen::VectorXd(plant_.acceleration()),
                       rigid_A_);
  }
  plant_.rate(x, sample.command, xdot.data());  // leaves M, h, torques and acceleration at x
  tree_slopes_.set(bodies_.tree(), S_tree_ * plant_.acceleration());
  if (is_due && !bodies_.has_loops()) {
    rigid_tangent();
  }
  A.setZero(nx_, nx_);
  A.block(0, nz_, nz_, nz_).setIdentity();
  A.block(nz_, 0, nz_, 2 * nz_) = rigid_A_;
  effect_tangent(x, sample.change, A);
  actuator_tangent(x, sample.command, A);
  supply_tangent(x, sample.command, A);
  // Mean over the sample of a cubic with these ends and rates, where the rates differ by A * change. Behind a
  // jump a stiff law may bring the velocity to its end within a hundredth of the sample, as no cubic does:
  // its mean velocity is then not the change of position over the time.
  constexpr double kAstray = 0.1;  // of the change of velocity
  const Eigen::Map<const Eigen::VectorXd> change(sample.change, nx_);
  const Eigen::Map<const Eigen::VectorXd> middle(x, nx_);
  const Eigen::VectorXd velocity = change.head(nz_) / sample.period;
  Eigen::VectorXd mean = middle - sample.period / 12.0 * (A * change);
  if (sample.jumped &&
      (mean.segment(nz_, nz_) - velocity).norm() > kAstray * change.segment(nz_, nz_).norm()) {
    mean = middle;
    mean.segment(nz_, nz_) = velocity;
  }
  B.resize(nx_, static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    parameter_tangent(sample, mean.data(), A, parameters[k], steps[column], refresh, B.col(column));
  }
}

}  // namespace plumbline::model
