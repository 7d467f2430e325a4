// How a Machine goes through time.
#include <algorithm>
#include <cmath>

#include "tests/battery/worlds/machine.h"

namespace plumbline::battery::worlds {

// A stop counts where its damper alone is faster than a step.
void Machine::add_light() {
  Matrix links = Matrix::Zero(n_, n_);
  Vector bias = Vector::Zero(n_);
  rig_.equations(rig_, start_, Vector::Zero(n_), links, bias);
  for (const int row : rig_.light) {
    Light light;
    light.row = row;
    while (own_row(light.column) != row) {
      ++light.column;
    }
    for (std::size_t i = 0; i < acting_.size(); ++i) {
      if (acting_[i].row[row] == 0.0) {
        continue;
      }
      light.acting.push_back(i);
      if (acting_[i].effect.effect == "hard_stop" &&
          acting_[i].effect["damping"] * rig_.step > links(row, row)) {
        light.stops.push_back(i);
      }
    }
    light_.push_back(light);
  }
}

bool Machine::is_behind(const Light& one, const Vector& full) const {
  return std::any_of(one.stops.begin(), one.stops.end(), [&](std::size_t i) {
    const Hidden& stop = acting_[i].effect;
    return stop["side"] * (full[one.row] - stop["position"]) > 0.0;
  });
}

// All forces fall with speed, by the stop's damping at least: that brackets the balance, which Newton's
// method then finds.
void Machine::creep(Creeping who, const State& x, const Vector& full, Vector& full_rate) const {
  constexpr double kClose = 1e-11;  // rad/s, beside what the speed is itself
  for (std::size_t l = 0; l < light_.size(); ++l) {
    const Light& one = light_[l];
    if ((who >> l & 1U) == 0 || !is_behind(one, full)) {
      continue;
    }
    const auto pull = [&](double speed) {
      full_rate[one.row] = speed;
      double sum = 0.0;
      for (const std::size_t i : one.acting) {
        sum += acting_[i].row[one.row] * force_of(acting_[i], x, full, full_rate, 0.0);
      }
      return sum;
    };
    double speed = full_rate[one.row];
    double left = pull(speed);
    const double reach = left / acting_[one.stops.front()].effect["damping"];
    double low = speed + std::min(reach, 0.0);
    double high = speed + std::max(reach, 0.0);
    for (int round = 0; round < 60 && left != 0.0; ++round) {
      (left > 0.0 ? low : high) = speed;
      const double nudge = 1e-7 * (1e-3 + std::abs(speed));
      const double next = speed - left * nudge / (pull(speed + nudge) - left);
      const double before = speed;
      speed = next > low && next < high ? next : 0.5 * (low + high);
      left = pull(speed);
      if (std::abs(speed - before) <= kClose * (1.0 + std::abs(speed))) {
        break;
      }
    }
    full_rate[one.row] = speed;
  }
}

Machine::Creeping Machine::settle(State& x) const {
  constexpr double kSettled = 0.01;  // rad/s: what is left of a fall into the stop goes on for 2e-8 rad
  Creeping who = 0;
  if (light_.empty()) {
    return who;
  }
  const Vector full = positions_of(x);
  const Vector full_rate = rates_of(x);
  Vector creeping = full_rate;
  creep(~Creeping{0}, x, full, creeping);
  for (std::size_t l = 0; l < light_.size(); ++l) {
    const Light& one = light_[l];
    if (is_behind(one, full) && std::abs(creeping[one.row] - full_rate[one.row]) < kSettled) {
      who |= 1U << l;
      x[positions() + one.column] = creeping[one.row];
    }
  }
  return who;
}

void Machine::note(const State& x, Eigen::Index k, Motion& motion) const {
  motion.positions.col(k) = positions_of(x);
  motion.rates.col(k) = rates_of(x);
  Eigen::Index row = 0;
  for (const int state : bristle_state_) {
    if (state >= 0) {
      motion.bristles(row++, k) = x[state];
    }
  }
}

Motion Machine::room_for(Eigen::Index count) const {
  Motion motion;
  motion.positions.resize(offset_.size(), count);
  motion.rates.resize(offset_.size(), count);
  motion.commands.resize(static_cast<Eigen::Index>(rig_.motors.size()), count);
  motion.bristles.resize(
      std::count_if(bristle_state_.begin(), bristle_state_.end(), [](int state) { return state >= 0; }),
      count);
  return motion;
}

Motion Machine::run(State x, Eigen::Index first, Eigen::Index count, double period,
                    const Commander& command) const {
  Motion motion = room_for(count);
  Vector now = Vector::Zero(motion.commands.rows());
  for (Eigen::Index k = 0; k < count; ++k) {
    note(x, k, motion);
    command(first + k, readings_of(rig_, motion.positions.col(k)), now);
    motion.commands.col(k) = now;
    advance(x, motion.commands, k, period);
  }
  return motion;
}

State Machine::stepped(const Vector& commands, Creeping who, const State& x, double h) const {
  State k1(states_), k2(states_), k3(states_), k4(states_);
  rates(commands, who, x, k1);
  rates(commands, who, x + 0.5 * h * k1, k2);
  rates(commands, who, x + 0.5 * h * k2, k3);
  rates(commands, who, x + h * k3, k4);
  return x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// Sides of the stops and the grounds on which a force's rate jumps.
std::vector<bool> Machine::sides(const State& x) const {
  std::vector<bool> all;
  if (light_.empty()) {
    return all;
  }
  const Vector full = positions_of(x);
  for (const Light& one : light_) {
    all.push_back(is_behind(one, full));
  }
  for (const Ground& ground : rig_.grounds) {
    all.push_back(depth_of(rig_, ground, full) > 0.0);
  }
  return all;
}

void Machine::step(const Vector& commands, double h, State& x) const {
  constexpr int kParts = 10;  // of 1 us: the stop's damper alone has 0.5 to 2 us
  const Creeping who = settle(x);
  const std::vector<bool> here = sides(x);
  bool falls = false;  // into its stop
  for (std::size_t l = 0; l < light_.size(); ++l) {
    falls = falls || (here[l] && (who >> l & 1U) == 0);
  }
  if (!falls) {
    const State later = stepped(commands, who, x, h);
    if (sides(later) == here) {
      x = later;
      return;
    }
  }
  for (int part = 0; part < kParts; ++part) {
    const Creeping creeping = settle(x);
    x = stepped(commands, creeping, x, h / kParts);
  }
}

// Command j acts from the instant t on at which t - delay - drift t = j period: the first one behind
// `begins`, counted from there.
static double next_command(double delay, double drift, double begins, double period) {
  const double past = std::floor((begins - delay - drift * begins) / period);
  return ((past + 1.0) * period + delay) / (1.0 - drift) - begins;
}

void Machine::advance(State& x, const Eigen::MatrixXd& commands, Eigen::Index k, double period) const {
  // Where a delayed command changes within the sample.
  std::vector<double> ends{period};
  const double begins = static_cast<double>(k) * period;
  for (std::size_t m = 0; m < delay_.size(); ++m) {
    const double change =
        drift_[m] == 0.0 ? std::fmod(delay_[m], period) : next_command(delay_[m], drift_[m], begins, period);
    if (change > 1e-12 && change < period) {
      ends.push_back(change);
    }
  }
  std::sort(ends.begin(), ends.end());
  double from = 0.0;
  for (const double to : ends) {
    if (to - from < 1e-12) {
      continue;
    }
    Vector held = commands.col(k);
    for (Eigen::Index m = 0; m < held.size(); ++m) {
      const auto i = static_cast<std::size_t>(m);
      const double middle = 0.5 * (from + to);
      const double back = (middle - delay_[i] - drift_[i] * (begins + middle)) / period;
      const Eigen::Index then = k + static_cast<Eigen::Index>(std::floor(back));
      held[m] = commands(m, std::max<Eigen::Index>(then, 0));
    }
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / rig_.step - 1e-9)));
    for (int s = 0; s < steps; ++s) {
      step(held, (to - from) / steps, x);
    }
    from = to;
  }
}

}  // namespace plumbline::battery::worlds
