#include "controllers/atrias_running/running.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline::controllers::atrias {
namespace {

constexpr double kMirrorTime = 0.05;   // s, in which a leg goes over to mirroring the other
constexpr double kStraightest = 0.97;  // of the leg's full length, beyond which no foot is sent

void require(bool holds, const char* name, double found, const char* expected) {
  if (!holds) {
    throw std::invalid_argument(std::string(name) + ": found " + std::to_string(found) + ", expected " +
                                expected);
  }
}

Pair operator+(const Pair& a, const Pair& b) { return {a.first + b.first, a.second + b.second}; }
Pair operator-(const Pair& a, const Pair& b) { return {a.first - b.first, a.second - b.second}; }
Pair operator*(double factor, const Pair& a) { return {factor * a.first, factor * a.second}; }
double length_of(const Pair& a) { return std::hypot(a.first, a.second); }

StanceRegulator::Design design_of(const RunningNumbers& numbers) {
  StanceRegulator::Design design = numbers.design;
  design.infinite = numbers.horizon_infinite != 0.0;
  return design;
}

RunningNumbers checked(const RunningNumbers& n, double period) {
  require(period > 0.0, "period", period, "more than 0 s");
  require(n.gait.mass > 0.0, "mass", n.gait.mass, "more than 0 kg");
  require(n.gait.stiffness > 0.0, "stiffness", n.gait.stiffness, "more than 0 N/m");
  require(n.gait.landing > 0.0, "landing", n.gait.landing, "more than 0 m");
  require(n.gait.hop > 0.0, "hop", n.gait.hop, "more than 0 m");
  require(n.gait.inertia > 0.0, "inertia", n.gait.inertia, "more than 0 kg m^2");
  require(n.gait.reach > 0.0, "reach", n.gait.reach, "more than 0 m");
  require(n.link > 0.0, "link", n.link, "more than 0 m");
  require(n.drive.gear > 0.0, "gear", n.drive.gear, "more than 0");
  require(n.drive.torque_constant > 0.0, "torque_constant", n.drive.torque_constant, "more than 0 N m/A");
  require(n.ready > 0.0 && n.ready <= 1.0, "ready", n.ready, "a share above 0, up to 1");
  for (const double spring : n.springs) {
    require(spring > 0.0, "spring", spring, "more than 0 N m/rad");
  }
  for (const double leverage : n.leverage) {
    require(leverage > 0.0, "leverage", leverage, "more than 0");
  }
  return n;
}

}  // namespace

const char* to_string(RunningFault fault) noexcept {
  return fault == RunningFault::none ? "" : "the trunk has turned over: power off";
}

Running::Running(const RunningNumbers& numbers, double period)
    : numbers_(checked(numbers, period)),
      period_(period),
      motor_share_(period / (period + numbers.motor_filter)),
      link_share_(period / (period + numbers.link_filter)),
      aim_share_(period / (period + numbers.mirror_filter)),
      planner_(numbers.gait),
      regulator_(numbers.gait, design_of(numbers)),
      along_(period, numbers.gait.mass, numbers.filter),
      up_(period, numbers.gait.mass, numbers.filter),
      legs_{Leg{{}, {}, {}, {Drive(numbers.springs[0]), Drive(numbers.springs[1])}},
            Leg{{}, {}, {}, {Drive(numbers.springs[2]), Drive(numbers.springs[3])}}},
      adaptations_{SpeedAdaptation(static_cast<int>(numbers.learn_from)),
                   SpeedAdaptation(static_cast<int>(numbers.learn_from))},
      contact_(numbers.contact * numbers.gait.mass * numbers.gait.gravity) {
  // Contact is seen late: the plan is entered where its force is the one that detection waits for.
  const double half = 0.5 * planner_.hop().stance_time();
  while (entry_ < half && planner_.hop().force(entry_) < numbers_.contact * weight()) {
    entry_ += period_;
  }
  reset();
}

void Running::reset() noexcept {
  state_ = State{};
  const int wait = static_cast<int>(numbers_.learn_from);
  adaptations_ = {SpeedAdaptation(wait), SpeedAdaptation(wait)};
  contact_ = ContactDetection(numbers_.contact * weight());
  running_ = StanceMeans{};
  aims_ = {};
  for (Leg& leg : legs_) {
    leg.drives[0].begin();
    leg.drives[1].begin();
  }
  lean_rate_.begin();
  climbing_ = 1.0;
  foretold_ = plan_speed_ = 0.0;
  begun_ = landed_ = false;
}

void Running::read(const Reading& reading) noexcept {
  trunk_ = reading.trunk;
  lean_ = -trunk_;
  lean_rate_.update(lean_, period_, link_share_);
  const double c = std::cos(trunk_), s = std::sin(trunk_);
  mass_ = {numbers_.com_ahead * c - numbers_.com_up * s, numbers_.com_ahead * s + numbers_.com_up * c};
  for (std::size_t k = 0; k < 2; ++k) {
    const LegReading& one = reading.legs[k];
    Leg& leg = legs_[k];
    leg.drives[0].read(numbers_.drive, one.thigh_motor, one.thigh, period_, motor_share_, link_share_);
    leg.drives[1].read(numbers_.drive, one.shin_motor, one.shin, period_, motor_share_, link_share_);
    leg.angles = {one.thigh + trunk_, one.shin + trunk_};
    leg.torque = {leg.drives[0].torque(), leg.drives[1].torque()};
    leg.foot = foot_of(numbers_.link, leg.angles);
    state_.shown[k] = force_from(numbers_.link, leg.angles, leg.torque);
  }
}

Pair Running::mass_from_foot(std::size_t leg) const noexcept { return mass_ - legs_[leg].foot; }

/// What a leg's force does at the centre of mass. In flight only the leg that is about to land carries, once
/// its force is no longer that of swinging it.
Pair Running::carried(std::size_t leg) const noexcept {
  const Pair shown = state_.shown[leg];
  const bool loads = state_.stance ? leg == state_.leg
                                   : leg == state_.leg && up_.rate() < 0.0 &&
                                         shown.second > numbers_.filter.full_load * weight();
  return loads ? numbers_.leverage[leg] * Pair{shown.first, std::max(0.0, shown.second)} : Pair{};
}

void Running::estimate() noexcept {
  const Pair force = carried(state_.leg);
  along_.predict(force.first);
  up_.predict(force.second - weight());
  if (state_.stance) {
    const Pair distance = mass_from_foot(state_.leg);
    along_.correct(distance.first, force.second / weight());
    up_.correct(distance.second, force.second / weight());
  }
}

void Running::touch_down() noexcept {
  const Pair distance = mass_from_foot(state_.leg);
  along_.place(distance.first);
  if (!landed_ || numbers_.height_each_step != 0.0) {
    up_.place(distance.second);
  }
  landed_ = true;
  const Pair mirror{-legs_[state_.leg].foot.first, legs_[state_.leg].foot.second + numbers_.clearance};
  mirror_gap_ = mass_ + paths_[other()].at(state_.since) - mirror;
  state_.stance = true;
  state_.since = entry_;
  state_.placed = distance.first;
  state_.steps += 1.0;
  running_ = StanceMeans{};
  peak_ = 0.0;
}

double Running::next_wanted(double asked) noexcept {
  const double before = state_.wanted;
  const double now = state_.steps - numbers_.speed_after;
  if (numbers_.speed_step == 0.0 || now < 0.0) {
    state_.wanted = asked;
  } else if (std::fmod(now, std::max(1.0, numbers_.speed_every)) == 0.0) {
    constexpr double kRounding = 1e-9;  // m/s
    const double next = state_.wanted + climbing_ * numbers_.speed_step;
    const bool end = next > numbers_.speed_most + kRounding || next < asked - kRounding;
    if (end && numbers_.speed_back != 0.0) {
      climbing_ = -climbing_;
    }
    if (!end || numbers_.speed_back != 0.0) {
      state_.wanted += climbing_ * numbers_.speed_step;
    }
  }
  state_.since_change = state_.wanted == before ? state_.since_change + 1.0 : 1.0;
  return state_.wanted;
}

void Running::take_off(double asked) noexcept {
  const double speed = along_.rate(), g = numbers_.gait.gravity, rise = up_.rate();
  const std::size_t stood = state_.leg;
  if (state_.steps > 0.0) {
    state_.speed_missed = speed - state_.wanted;
    if (state_.since_change == 1.0) {
      state_.missed_first = std::abs(state_.speed_missed);
    }
    if (state_.steps > 1.0) {
      adaptations_[stood].learn(state_.wanted, speed + foretold_);
    }
    running_.samples = std::max(running_.samples, 1L);
    const double share = 1.0 / static_cast<double>(running_.samples);
    state_.means = running_;
    for (double* sum : {&state_.means.x, &state_.means.z, &state_.means.force, &state_.means.force_missed,
                        &state_.means.torque_missed, &state_.means.lean}) {
      *sum *= share;
    }
    state_.peak = peak_;
    state_.leg = other();
  }
  state_.flight_speed = speed;
  state_.apex = up_.position() + 0.5 * rise * rise / g;
  state_.stance = false;
  state_.since = 0.0;
  along_.fly(0.0);
  up_.fly(-weight());
  const double fall = std::max(0.0, rise * rise + 2.0 * g * (up_.position() - numbers_.gait.landing));
  flight_time_ =
      std::clamp((rise + std::sqrt(fall)) / g, 0.5 * numbers_.gait.hop / planner_.hop().landing_speed(),
                 4.0 * planner_.hop().landing_speed() / g);
  const double wanted = next_wanted(asked);
  foretold_ = numbers_.learn != 0.0 ? adaptations_[state_.leg].foretold(wanted) : 0.0;
  plan_speed_ = speed;
  state_.placement = planner_.placement(speed, wanted - foretold_);
  plan_feet(flight_time_);
}

void Running::plan_feet(double flight) noexcept {
  const std::size_t next = state_.leg, back = other();
  const double speed = plan_speed_;
  const auto from = [&](std::size_t leg) { return legs_[leg].foot - mass_; };
  const auto rate = [&](std::size_t leg) {
    if (!begun_) {
      return Pair{};
    }
    const double l = numbers_.link, trunk = -lean_rate_.value();
    const double a = legs_[leg].drives[0].link_rate() + trunk, b = legs_[leg].drives[1].link_rate() + trunk;
    return Pair{l * (std::cos(legs_[leg].angles.first) * a + std::cos(legs_[leg].angles.second) * b),
                l * (std::sin(legs_[leg].angles.first) * a + std::sin(legs_[leg].angles.second) * b)};
  };
  const double ahead = -state_.placement, down = -numbers_.gait.landing;
  paths_[next].plan(from(next), rate(next), {ahead, down}, -speed, flight, numbers_.ready);
  paths_[back].plan(from(back), rate(back), {-ahead, down + numbers_.clearance}, speed, flight,
                    numbers_.ready);
}

// Equations 5.8, then section 5.4.2.
void Running::stand(Currents& currents) noexcept {
  const double time = state_.since;
  const std::size_t k = state_.leg;
  state_.plan = planner_.at(time, state_.placement, plan_speed_);
  const Reference& plan = state_.plan;
  const Matrix<1, 4> gains = regulator_.gains(time);
  const double x = along_.position() - plan.x, x_rate = along_.rate() - plan.x_rate;
  const double z = up_.position() - plan.z, z_rate = up_.rate() - plan.z_rate;
  const Pair wanted{plan.force_x - gains(0, 0) * x - gains(0, 1) * x_rate - gains(0, 2) * lean_ -
                        gains(0, 3) * lean_rate_.value(),
                    plan.force_z - regulator_.gain_z() * z - regulator_.gain_z_rate() * z_rate};
  state_.force = within_contact(wanted, numbers_.friction_cone);
  const Pair torques =
      torques_for(numbers_.link, legs_[k].angles, (1.0 / numbers_.leverage[k]) * state_.force);
  currents[2 * k] = legs_[k].drives[0].current_for_torque(numbers_.drive, torques.first);
  currents[2 * k + 1] = legs_[k].drives[1].current_for_torque(numbers_.drive, torques.second);
  keep_means(torques);
}

void Running::keep_means(const Pair& torques) noexcept {
  const Leg& leg = legs_[state_.leg];
  const Reference& plan = state_.plan;
  running_.x += std::abs(along_.position() - plan.x);
  running_.z += std::abs(up_.position() - plan.z);
  running_.force += length_of(state_.force - Pair{plan.force_x, plan.force_z});
  running_.force_missed += length_of(carried(state_.leg) - state_.force);
  running_.torque_missed +=
      0.5 * (std::abs(leg.torque.first - torques.first) + std::abs(leg.torque.second - torques.second));
  running_.lean += std::abs(lean_);
  ++running_.samples;
  peak_ = std::max(peak_, state_.shown[state_.leg].second);
}

/// The springs are taken as rigid (section 5.5). `foot`: relative to the hip.
void Running::swing(std::size_t k, const Pair& foot, Currents& currents) noexcept {
  Aim& aim = aims_[k];
  const double longest = 2.0 * numbers_.link * kStraightest, way = length_of(foot);
  const Pair angles = angles_of(numbers_.link, way > longest ? (longest / way) * foot : foot);
  if (aim.known) {
    const Pair rates = aim.rates + aim_share_ * ((1.0 / period_) * (angles - aim.angles) - aim.rates);
    aim.accelerations =
        aim.accelerations + aim_share_ * ((1.0 / period_) * (rates - aim.rates) - aim.accelerations);
    aim.rates = rates;
  } else {
    aim.rates = {legs_[k].drives[0].link_rate() - lean_rate_.value(),
                 legs_[k].drives[1].link_rate() - lean_rate_.value()};
    aim.accelerations = Pair{};
  }
  aim.angles = angles;
  aim.known = true;
  const double trunk_rate = -lean_rate_.value();
  currents[2 * k] = legs_[k].drives[0].current_for_angle(
      numbers_.drive, angles.first - trunk_, aim.rates.first - trunk_rate, aim.accelerations.first);
  currents[2 * k + 1] = legs_[k].drives[1].current_for_angle(
      numbers_.drive, angles.second - trunk_, aim.rates.second - trunk_rate, aim.accelerations.second);
}

Currents Running::step(const Reading& reading) noexcept {
  Currents currents{};
  if (state_.fault != RunningFault::none) {
    return currents;
  }
  read(reading);
  if (std::abs(lean_) > numbers_.fall) {
    state_.fault = RunningFault::fallen;
    return currents;
  }
  if (!begun_) {  // released at rest, at the apex
    along_.restart(0.0, 0.0);
    up_.restart(numbers_.gait.landing + numbers_.gait.hop, -weight());
    state_.wanted = reading.wanted;
    take_off(reading.wanted);
    begun_ = true;
  } else {
    state_.since += period_;
    estimate();
    const bool before = state_.stance;
    // The force of a leg that has just left its mirror place must not be taken for a landing.
    const bool may = before || state_.since > numbers_.contact_from * flight_time_;
    // The rebound is behind the plan's lowest point: a foot that has met high ground while the mass hardly
    // falls must not be taken for one that has rebounded.
    const bool rebounds = before && state_.since > 0.5 * planner_.hop().stance_time() && up_.rate() > 0.0;
    const bool stands = may && contact_.update(state_.shown[state_.leg].second, rebounds ? 1.0 : -1.0);
    if (!before && stands) {
      touch_down();
    } else if (before && !stands) {
      take_off(reading.wanted);
    }
  }
  if (state_.stance) {
    stand(currents);
    aims_[state_.leg].known = false;
    const double blend = std::max(0.0, 1.0 - (state_.since - entry_) / kMirrorTime);
    const Pair& foot = legs_[state_.leg].foot;
    swing(other(), Pair{-foot.first, foot.second + numbers_.clearance} + blend * mirror_gap_, currents);
  } else {
    for (std::size_t k = 0; k < 2; ++k) {
      swing(k, mass_ + paths_[k].at(state_.since), currents);
    }
  }
  return currents;
}

}  // namespace plumbline::controllers::atrias
