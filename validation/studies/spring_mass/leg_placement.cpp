#include "validation/studies/spring_mass/leg_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace plumbline::spring_mass {
namespace {

/// From one angle to the other the short way, so that a deflection of 179 degrees and one of -179 are
/// neighbours.
double nearest_turn(double angle, double to) { return to + std::remainder(angle - to, 2.0 * pi); }

}  // namespace

DeadbeatLaw::DeadbeatLaw(const Behaviour& behaviour, double target)
    : behaviour_(&behaviour), target_(target) {
  const Grid& grid = behaviour.grid();
  contours_.resize(static_cast<std::size_t>(grid.apexes));
  for (int k = 0; k < grid.apexes; ++k) {
    for (int j = 0; j + 1 < grid.splays; ++j) {
      for (int i = 0; i + 1 < grid.attacks; ++i) {
        add_cell(k, i, j);
      }
    }
  }
}

std::optional<DeadbeatLaw::Crossing> DeadbeatLaw::crossing(int k, int i, int j, int di, int dj) const {
  const double first = behaviour_->next_apex(i, j, k) - target_;
  const double second = behaviour_->next_apex(i + di, j + dj, k) - target_;
  if (!(first * second <= 0.0) || first == second) {
    return {};
  }
  const double share = first / (first - second);
  const auto between = [share](double a, double b) { return a + share * (b - a); };
  const double turn = behaviour_->deflection(i, j, k);
  return Crossing{between(behaviour_->attack(i), behaviour_->attack(i + di)),
                  between(behaviour_->splay(j), behaviour_->splay(j + dj)),
                  between(turn, nearest_turn(behaviour_->deflection(i + di, j + dj, k), turn))};
}

void DeadbeatLaw::add_cell(int k, int i, int j) {
  std::array<std::optional<Crossing>, 4> edges = {crossing(k, i, j, 1, 0), crossing(k, i, j + 1, 1, 0),
                                                  crossing(k, i, j, 0, 1), crossing(k, i + 1, j, 0, 1)};
  std::vector<Crossing> found;
  for (const auto& edge : edges) {
    if (edge) {
      found.push_back(*edge);
    }
  }
  // Two crossings are a piece of the contour; four are a saddle, joined by the order of their deflections.
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.deflection < b.deflection; });
  for (std::size_t n = 0; n + 1 < found.size(); n += 2) {
    contours_[static_cast<std::size_t>(k)].push_back({found[n], found[n + 1]});
  }
}

std::optional<Placement> DeadbeatLaw::at(int k, double deflection) const {
  // The scan has splays from 0 to pi, which put the foot to the left and turn to the right: negative
  // deflections.
  const double side = deflection > 0.0 ? -1.0 : 1.0;
  const double wanted = -std::abs(deflection);
  std::optional<Placement> best;
  double best_miss = 0.0;
  for (const Piece& piece : contours_[static_cast<std::size_t>(k)]) {
    const double from = piece.from.deflection, to = piece.to.deflection;  // from <= to
    const double miss = wanted < from ? from - wanted : wanted > to ? wanted - to : 0.0;
    if (best && miss > best_miss + 1e-9) {
      continue;
    }
    const double share = to > from ? std::clamp((wanted - from) / (to - from), 0.0, 1.0) : 0.0;
    const double attack = piece.from.attack + share * (piece.to.attack - piece.from.attack);
    if (!best || miss < best_miss - 1e-9 || attack > best->leg.attack) {
      const double splay = piece.from.splay + share * (piece.to.splay - piece.from.splay);
      best = Placement{{attack, side * splay}, side * (from + share * (to - from))};
      best_miss = miss;
    }
  }
  return best;
}

TimeLaw::TimeLaw(const DeadbeatLaw& law, double deflection) {
  const Behaviour& behaviour = law.behaviour();
  std::vector<std::pair<double, Placement>> entries;
  for (int k = 0; k < behaviour.grid().apexes; ++k) {
    const std::optional<Placement> placement = law.at(k, deflection);
    if (!placement) {
      continue;
    }
    const double fall = behaviour.apex(k) - behaviour.body().rest_length * std::sin(placement->leg.attack);
    if (fall >= 0.0) {
      entries.emplace_back(std::sqrt(2.0 * fall / behaviour.body().gravity), *placement);
    }
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [time, placement] : entries) {
    times_.push_back(time);
    placements_.push_back(placement);
  }
}

Placement TimeLaw::at(double time) const {
  if (times_.empty()) {
    throw std::logic_error("time law: no placement leads to the target apex");
  }
  const auto behind = std::upper_bound(times_.begin(), times_.end(), time);
  if (behind == times_.begin()) {
    return placements_.front();
  }
  if (behind == times_.end()) {
    return placements_.back();
  }
  const auto n = static_cast<std::size_t>(behind - times_.begin());
  const double share = (time - times_[n - 1]) / (times_[n] - times_[n - 1]);
  const Placement &a = placements_[n - 1], &b = placements_[n];
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {{between(a.leg.attack, b.leg.attack), between(a.leg.splay, b.leg.splay)},
          between(a.deflection, b.deflection)};
}

PolicyTable::PolicyTable(const DeadbeatLaw& law, double step) : step_(step) {
  for (int n = 0; n * step < pi + step; ++n) {
    laws_.emplace_back(law, std::min(n * step, pi));
  }
}

bool PolicyTable::reaches(std::size_t entry, const Placement& placement) const {
  constexpr double rounding = 1e-6;
  return std::abs(std::abs(placement.deflection) - static_cast<double>(entry) * step_) < rounding;
}

Placement PolicyTable::at(double time, double wanted) const {
  const double size = std::min(std::abs(wanted), pi), side = wanted < 0.0 ? -1.0 : 1.0;
  auto entry = std::min(static_cast<std::size_t>(size / step_), laws_.size() - 2);
  Placement below = laws_[entry].at(time);
  const Placement above = laws_[entry + 1].at(time);
  Placement placed{{}, size};
  if (reaches(entry + 1, above)) {
    const double share = size / step_ - static_cast<double>(entry);
    placed.leg.attack = below.leg.attack + share * (above.leg.attack - below.leg.attack);
    placed.leg.splay = below.leg.splay + share * (above.leg.splay - below.leg.splay);
  } else {
    placed.deflection = std::min(size, std::abs(above.deflection));
    while (entry > 0 && !reaches(entry, below)) {
      below = laws_[--entry].at(time);
    }
    placed.leg = below.leg;
  }
  placed.leg.splay *= side;
  placed.deflection *= side;
  return placed;
}

LegAngles classical_placement(const Body& body, const Eigen::Vector2d& velocity, double neutral, double gain,
                              const Eigen::Vector2d& wanted) {
  const Eigen::Vector2d foot = neutral * velocity.normalized() + gain * (velocity - wanted);
  const double across = std::min(foot.norm() / body.rest_length, 1.0);
  const double heading = std::atan2(velocity.y(), velocity.x());
  return {std::acos(across), std::remainder(std::atan2(foot.y(), foot.x()) - heading, 2.0 * pi)};
}

double steady_attack(const Body& body, double apex) {
  // From steep to flat the next apex first falls below the present one and then rises through it.
  const auto rise = [&](double attack) {
    const Step made = step(body, apex, {attack, 0.0});
    return made.ending == Ending::apex ? made.apex - apex : -1.0;
  };
  const double steepest = apex < body.rest_length ? std::asin(apex / body.rest_length) : 0.5 * pi;
  double steep = steepest, flat = steepest;
  for (int n = 1; n < 200; ++n) {
    flat = steepest - (steepest - 0.25 * pi) * n / 199.0;
    if (rise(flat) > 0.0 && rise(steep) <= 0.0) {
      break;
    }
    steep = flat;
    if (n == 199) {
      throw std::runtime_error("spring-mass model: no steady gait at this apex");
    }
  }
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (steep + flat);
    (rise(middle) > 0.0 ? flat : steep) = middle;
  }
  return 0.5 * (steep + flat);
}

double matched_gain(const Body& body, double target) {
  // The foot that leads to the target, as a function of the apex's speed v. The neutral point does not move
  // with v: it comes from the stance before.
  const auto foot_for = [&](double apex) {
    double flat = steady_attack(body, apex) - 0.1, steep = flat + 0.2;
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (steep + flat);
      (step(body, apex, {middle, 0.0}).apex > target ? flat : steep) = middle;
    }
    return body.rest_length * std::cos(0.5 * (steep + flat));
  };
  const double h = 0.01;
  const double up = foot_for(target - h), down = foot_for(target + h);
  const double faster = apex_speed(body, target - h), slower = apex_speed(body, target + h);
  return (up - down) / (faster - slower);
}

}  // namespace plumbline::spring_mass
