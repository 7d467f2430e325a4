#include "validation/studies/spring_mass/trail.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

namespace plumbline::spring_mass {
namespace {

/// A well-mixed number in [0, 1) from three integers (SplitMix64).
double mixed(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  std::uint64_t z = a * 0x9E3779B97F4A7C15ULL + b * 0xBF58476D1CE4E5B9ULL + c * 0x94D049BB133111EBULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  z ^= z >> 31U;
  return static_cast<double>(z >> 11U) * 0x1.0p-53;
}

double root_mean_square(const std::vector<TrailStep>& steps, double TrailStep::*value) {
  double sum = 0.0;
  for (const TrailStep& one : steps) {
    sum += one.*value * one.*value;
  }
  return steps.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(steps.size()));
}

double largest(const std::vector<TrailStep>& steps, double TrailStep::*value) {
  double most = 0.0;
  for (const TrailStep& one : steps) {
    most = std::max(most, std::abs(one.*value));
  }
  return most;
}

/// The way-points of a run, drawn as they are needed.
class Waypoints {
 public:
  Waypoints(const TrailSettings& settings, Trail& trail)
      : settings_(settings), trail_(trail), random_(settings.seed) {
    next({0.0, 0.0});
  }
  void pass(const Eigen::Vector2d& at) {
    if ((trail_.waypoints.back() - at).norm() < settings_.waypoint_radius) {
      next(at);
    }
  }
  double heading_from(const Eigen::Vector2d& at) const {
    const Eigen::Vector2d way = trail_.waypoints.back() - at;
    return std::atan2(way.y(), way.x());
  }

 private:
  void next(const Eigen::Vector2d& from) {
    std::uniform_real_distribution<double> place(-0.5 * settings_.arena, 0.5 * settings_.arena);
    Eigen::Vector2d drawn;
    do {
      drawn.x() = place(random_);
      drawn.y() = place(random_);
    } while ((drawn - from).norm() < settings_.least_way);
    trail_.waypoints.push_back(drawn);
  }
  const TrailSettings& settings_;
  Trail& trail_;
  std::mt19937_64 random_;
};

class Runner {
 public:
  Runner(const DeadbeatLaw& law, const Tiles& ground, const TrailSettings& settings, bool with_path)
      : law_(law),
        ground_(ground),
        settings_(settings),
        with_path_(with_path),
        plant_(law.behaviour().body()) {
    plant_.energy *= 1.0 + settings.disturbance.energy;
    plant_.stiffness *= 1.0 + settings.disturbance.stiffness;
    const Body& body = law.behaviour().body();
    if (settings.law == LawKind::classical) {
      gain_ = settings.gain > 0.0 ? settings.gain : matched_gain(body, law.target());
      const Step steady = step(body, law.target(), {steady_attack(body, law.target()), 0.0});
      last_stance_ = steady.stance;
      last_way_ = steady.takeoff.position.x() - steady.touchdown.position.x();
    }
    if (settings.law != LawKind::classical && settings.policy_step > 0.0) {
      table_.emplace(law, settings.policy_step);
    }
    apex_ = settings.first_apex;
  }

  Trail run() {
    Waypoints waypoints(settings_, trail_);
    for (int n = 0; n < settings_.steps && trail_.ending == Ending::apex; ++n) {
      one_step(waypoints);
    }
    return std::move(trail_);
  }

 private:
  /// What the law wants of this flight: leg angles over the time since the apex.
  Placement placement(double time) const {
    Placement placed;
    const double late = std::max(0.0, time - settings_.disturbance.delay);
    if (table_) {
      placed = table_->at(late, wanted_);
    } else if (time_law_) {
      placed = time_law_->at(late);
    } else {
      placed = fixed_;
    }
    placed.leg.attack += settings_.disturbance.attack;
    placed.leg.splay += settings_.disturbance.splay;
    return placed;
  }

  void plan(double wanted, double speed) {
    wanted_ = wanted;
    if (table_) {
      return;
    }
    if (settings_.law != LawKind::classical) {
      time_law_.emplace(law_, wanted);
      return;
    }
    const double fast = apex_speed(plant_, law_.target());
    const double neutral = 0.5 * (settings_.neutral_from_flight ? speed * last_stance_ : last_way_);
    fixed_ = {classical_placement(plant_, {speed, 0.0}, neutral, gain_,
                                  {fast * std::cos(wanted), fast * std::sin(wanted)}),
              wanted};
  }

  /// From the foot to the ground below it, m, at a time of this flight.
  double clearance(double time, double speed) const {
    const Eigen::Vector3d foot = foot_at(time, speed);
    return foot.z() - ground_.height(foot.x(), foot.y());
  }

  Eigen::Vector3d foot_at(double time, double speed) const {
    const LegAngles leg = placement(time).leg;
    const double across = plant_.rest_length * std::cos(leg.attack);
    return in_world({speed * time + across * std::cos(leg.splay), across * std::sin(leg.splay), 0.0}) +
           Eigen::Vector3d(
               0.0, 0.0,
               apex_ - 0.5 * plant_.gravity * time * time - plant_.rest_length * std::sin(leg.attack));
  }

  /// From the apex frame (origin below the apex) to the world.
  Eigen::Vector3d in_world(const Eigen::Vector3d& p) const {
    return {place_.x() + std::cos(heading_) * p.x() - std::sin(heading_) * p.y(),
            place_.y() + std::sin(heading_) * p.x() + std::cos(heading_) * p.y(), p.z()};
  }

  /// When the foot first reaches the ground, s; none within two seconds.
  std::optional<double> landing(double speed) const {
    constexpr double look = 1e-3;
    double before = 0.0;
    for (double time = look; time < 2.0; time += look) {
      if (clearance(time, speed) <= 0.0) {
        double late = time;
        for (int n = 0; n < 45; ++n) {
          const double middle = 0.5 * (before + late);
          (clearance(middle, speed) > 0.0 ? before : late) = middle;
        }
        return late;
      }
      before = time;
    }
    return {};
  }

  void one_step(Waypoints& waypoints) {
    TrailStep made;
    made.x = place_.x();
    made.y = place_.y();
    made.apex = apex_;
    made.heading = heading_;
    const double aim = settings_.straight ? 0.0 : waypoints.heading_from(place_);
    made.wanted = std::remainder(aim - heading_, 2.0 * pi);
    if (settings_.law != LawKind::deadbeat) {
      made.wanted = std::clamp(made.wanted, -settings_.turn_limit, settings_.turn_limit);
    }
    // The energy is constant with respect to ground of height 0.
    const double speed =
        std::sqrt(std::max(0.0, 2.0 * plant_.energy / plant_.mass - 2.0 * plant_.gravity * apex_));
    plan(made.wanted, speed);
    const double foot_below = plant_.rest_length * std::sin(placement(0.0).leg.attack);
    made.stumbling_margin = apex_ - foot_below - ground_below_;
    std::optional<double> lands;
    if (clearance(0.0, speed) > 0.0) {
      lands = landing(speed);
    }
    if (!lands) {
      trail_.ending = clearance(0.0, speed) > 0.0 ? Ending::fell : Ending::stumbled;
      trail_.steps.push_back(made);
      return;
    }
    land(made, *lands, speed, waypoints);
  }

  void land(TrailStep& made, double time, double speed, Waypoints& waypoints) {
    const Placement placed = placement(time);
    const Eigen::Vector3d foot = foot_at(time, speed);
    made.foot_x = foot.x();
    made.foot_y = foot.y();
    made.ground = foot.z();
    made.clipped = std::abs(std::remainder(placed.deflection - made.wanted, 2.0 * pi)) > 1e-6;
    const double across = plant_.rest_length * std::cos(placed.leg.attack);
    const Moment touchdown{{-across * std::cos(placed.leg.splay), -across * std::sin(placed.leg.splay),
                            plant_.rest_length * std::sin(placed.leg.attack)},
                           {speed, 0.0, -plant_.gravity * time}};
    const auto note = [&](const Eigen::Vector3d& at) {
      if (with_path_) {
        trail_.path.push_back(at);
      }
      if (!settings_.straight) {
        waypoints.pass(at.head<2>());
      }
    };
    constexpr double shown = 0.005;
    for (double t = 0.0; t < time; t += shown) {
      note(in_world({speed * t, 0.0, apex_ - 0.5 * plant_.gravity * t * t}));
    }
    const double sine = std::sin(heading_), cosine = std::cos(heading_);
    const auto turned = [&](const Eigen::Vector3d& v) {
      return Eigen::Vector3d(cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y(), v.z());
    };
    int count = 0;
    const Stance stood = stance(plant_, touchdown, [&](double, const Moment& now) {
      if (count++ % 10 == 0) {
        note(foot + turned(now.position));
      }
    });
    trail_.ending = stood.ending;
    last_stance_ = stood.duration;
    last_way_ = (stood.takeoff.position - touchdown.position).head<2>().norm();
    if (stood.ending == Ending::apex) {
      fly(made, stood, foot, turned, note);
      made.deflection_error = std::remainder(heading_ - made.heading - placed.deflection, 2.0 * pi);
    }
    trail_.steps.push_back(made);
  }

  template <class Turned, class Note>
  void fly(TrailStep& made, const Stance& stood, const Eigen::Vector3d& foot, const Turned& turned,
           const Note& note) {
    const Eigen::Vector3d from = foot + turned(stood.takeoff.position), with = turned(stood.takeoff.velocity);
    const double rise = with.z() / plant_.gravity;
    for (double t = 0.0; t < rise; t += 0.005) {
      note(from + with * t - Eigen::Vector3d(0.0, 0.0, 0.5 * plant_.gravity * t * t));
    }
    place_ = (from + with * rise).head<2>();
    apex_ = from.z() + 0.5 * with.z() * rise;
    heading_ = std::atan2(with.y(), with.x());
    ground_below_ = foot.z();
    made.apex_error = apex_ - foot.z() - law_.target();
  }

  const DeadbeatLaw& law_;
  const Tiles& ground_;
  const TrailSettings& settings_;
  bool with_path_;
  Body plant_;
  Trail trail_;
  Eigen::Vector2d place_ = Eigen::Vector2d::Zero();
  double apex_ = 1.0, heading_ = 0.0, ground_below_ = 0.0;
  double gain_ = 0.0, last_stance_ = 0.0, last_way_ = 0.0;
  std::optional<PolicyTable> table_;
  std::optional<TimeLaw> time_law_;
  double wanted_ = 0.0;  // deflection of this step
  Placement fixed_;
};

}  // namespace

std::string to_string(LawKind kind) {
  return kind == LawKind::deadbeat ? "deadbeat" : kind == LawKind::constrained ? "constrained" : "classical";
}

double Tiles::height(double x, double y) const {
  const auto column = static_cast<std::int64_t>(std::floor(x / side_));
  const auto row = static_cast<std::int64_t>(std::floor(y / side_));
  return half_range_ *
         (2.0 * mixed(static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row), seed_) - 1.0);
}

double Trail::worst_apex() const { return largest(steps, &TrailStep::apex_error); }
double Trail::rms_apex() const { return root_mean_square(steps, &TrailStep::apex_error); }
double Trail::worst_deflection() const { return largest(steps, &TrailStep::deflection_error); }
double Trail::rms_deflection() const { return root_mean_square(steps, &TrailStep::deflection_error); }

double Trail::last_apex_error() const {
  const std::size_t count = std::min<std::size_t>(steps.size(), 50);
  double sum = 0.0;
  for (std::size_t n = steps.size() - count; n < steps.size(); ++n) {
    sum += steps[n].apex_error;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

Trail run_trail(const DeadbeatLaw& law, const Tiles& ground, const TrailSettings& settings, bool with_path) {
  return Runner(law, ground, settings, with_path).run();
}

}  // namespace plumbline::spring_mass
