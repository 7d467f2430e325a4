// Stick figures of several moments in one picture.
#include <algorithm>
#include <cmath>

#include "simulator/render/film.h"
#include "simulator/render/key.h"
#include "simulator/trace/number_text.h"

namespace plumbline::render {
namespace {

constexpr double kRod = 0.013;      // m
constexpr double kBall = 0.035;     // m
constexpr double kApart = 0.42;     // m between figures that stand side by side
constexpr double kEnough = 0.2;     // m on the way between two figures that need no help
constexpr double kLightest = 0.62;  // how far the first figure fades into white

struct Strip {
  Figure figure;
  Snapshot shot;
};

/// What the sticks of a body are coloured like: its first part.
Color color_of(const Figure& figure, int body) {
  const auto found = std::find_if(figure.parts.begin(), figure.parts.end(),
                                  [&](const Part& part) { return part.body == body; });
  return found == figure.parts.end() ? palette(static_cast<std::size_t>(body)) : found->color;
}

/// The bodies that carry the heaviest one (a boom, a tower) and the heaviest itself, which comes first.
std::vector<int> base_and_carriers(const model::Skeleton& skeleton) {
  int base = 0;
  for (std::size_t b = 0; b < skeleton.bodies.size(); ++b) {
    if (skeleton.bodies[b].mass > skeleton.bodies[static_cast<std::size_t>(base)].mass) {
      base = static_cast<int>(b);
    }
  }
  std::vector<int> chain;
  for (int body = base; body >= 0; body = skeleton.joints[static_cast<std::size_t>(body)].parent) {
    chain.push_back(body);
  }
  return chain;
}

/// Joints or a foot behind it.
bool carries(const model::Model& model, int body) {
  const auto& joints = model.skeleton.joints;
  return std::any_of(joints.begin(), joints.end(), [&](const model::Joint& j) { return j.parent == body; }) ||
         std::any_of(model.feet.begin(), model.feet.end(),
                     [&](const model::Foot& f) { return f.body == body; });
}

/// Does it end where nothing but levers hang that end in the air?
bool is_to_a_lever(const model::Model& model, const Stick& stick) {
  bool levers = false;
  for (const model::Joint& joint : model.skeleton.joints) {
    if (joint.parent == stick.body && joint.X_PJ.translation() == stick.to) {
      if (carries(model, joint.child)) {
        return false;
      }
      levers = true;
    }
  }
  return levers;
}

/// Several sticks to levers as the one in their middle.
void join_levers(const model::Model& model, int body, std::vector<Stick>& sticks) {
  Stick middle{body, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  double count = 0.0;
  const auto joined = [&](const Stick& stick) {
    const bool joins = stick.body == body && is_to_a_lever(model, stick);
    if (joins) {
      middle.from = stick.from;
      middle.to += stick.to;
      count += 1.0;
    }
    return joins;
  };
  sticks.erase(std::remove_if(sticks.begin(), sticks.end(), joined), sticks.end());
  if (count > 0.0) {
    middle.to /= count;
    sticks.push_back(middle);
  }
}

/// The heaviest body and what leads from it to further joints or to feet: no carriers, no levers that end in
/// the air. All but the carriers where nothing would be left.
std::vector<Stick> limbs(const model::Model& model, const std::vector<int>& chain) {
  std::vector<Stick> all;
  std::vector<Stick> leading;
  for (const Stick& stick : sticks_of(model)) {
    if (std::find(chain.begin() + 1, chain.end(), stick.body) == chain.end()) {
      all.push_back(stick);
      if (stick.body == chain.front() || carries(model, stick.body)) {
        leading.push_back(stick);
      }
    }
  }
  if (leading.size() <= 1) {
    return all;
  }
  join_levers(model, chain.front(), leading);
  return leading;
}

double heading(const Eigen::Isometry3d& X) {
  const Eigen::Vector3d left = X.linear().col(1);
  return std::atan2(-left.x(), left.y());
}

/// Figure k of the strip: the first keeps its place, the others are turned to its heading and, when they are
/// to stand side by side, set apart from it.
Eigen::Isometry3d placed(const Eigen::Isometry3d& first, const Eigen::Isometry3d& base, double apart, int k) {
  if (apart <= 0.0) {
    return Eigen::Isometry3d::Identity();
  }
  const Eigen::AngleAxisd turn(heading(first) - heading(base), Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd way(heading(first), Eigen::Vector3d::UnitZ());
  Eigen::Vector3d from = base.translation();
  Eigen::Vector3d to = first.translation();
  from.z() = to.z() = 0.0;
  to += apart * k * (way * Eigen::Vector3d::UnitX());
  return Eigen::Translation3d(to) * turn * Eigen::Translation3d(-from);
}

void add(const Snapshot& shot, const Eigen::Isometry3d& X, Snapshot& all) {
  for (const Eigen::Isometry3d& pose : shot.poses) {
    all.poses.push_back(X * pose);
  }
  for (const Push& push : shot.pushes) {
    all.pushes.push_back({X * push.point, X.linear() * push.force});
  }
}

Color faded(const Color& color, double light) { return (1.0 - light) * color + light * Color::Ones(); }

void add(const std::vector<Stick>& sticks, const Figure& colors, int first_body, double light,
         Figure& figure) {
  for (Stick stick : sticks) {
    const Color color = color_of(colors, stick.body);
    stick.body += first_body;
    add_rod(stick, kRod, faded(color, light), figure.parts);
  }
}

/// Where the heaviest body has no stick, its centre of mass is shown.
void add_ball(const model::Skeleton& skeleton, int body, const Figure& colors, int first_body, double light,
              Figure& figure) {
  Part part;
  part.body = first_body + body;
  part.X_BP.translation() = skeleton.bodies[static_cast<std::size_t>(body)].com;
  part.solid = model::SphereShape{kBall};
  part.color = faded(color_of(colors, body), light);
  figure.parts.push_back(part);
}

}  // namespace

Image strip(const Figure& figure, const model::Plant& plant, const Snapshots& motion, int count,
            const FilmOptions& options) {
  const std::vector<int> chain = base_and_carriers(plant.model().skeleton);
  const std::vector<Stick> sticks = limbs(plant.model(), chain);
  std::vector<Snapshot> shots;
  shots.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    shots.push_back(motion.at(options.from + (options.to - options.from) * k / std::max(1, count - 1)));
  }
  const auto base = static_cast<std::size_t>(chain.front());
  const Eigen::Isometry3d& first = shots.front().poses[base];
  const double way = (shots.back().poses[base].translation() - first.translation()).head<2>().norm();
  const bool apart = plant.terrain().platforms().empty() && way < kEnough * (count - 1);
  const bool ball = std::none_of(sticks.begin(), sticks.end(),
                                 [&](const Stick& stick) { return stick.body == chain.front(); });
  Strip all;
  for (int k = 0; k < count; ++k) {
    const Snapshot& shot = shots[static_cast<std::size_t>(k)];
    const int first_body = static_cast<int>(all.shot.poses.size());
    const double light = kLightest * (1.0 - (k + 1.0) / count);
    add(sticks, figure, first_body, light, all.figure);
    if (ball) {
      add_ball(plant.model().skeleton, chain.front(), figure, first_body, light, all.figure);
    }
    add(shot, placed(first, shot.poses[base], apart ? kApart : 0.0, k), all.shot);
  }
  Scales scales;
  const double arrow = arrow_length(figure, shots);
  scales.newtons_per_metre = 2.0 * arrow_scale(shots, arrow);  // many arrows: short ones
  scales.arrow = arrow / kLongestArrow;
  Captions words;
  words.title = options.title;
  const double step = (options.to - options.from) / std::max(1, count - 1);
  words.lines.push_back("t = " + number_text(options.from, 4) + " to " + number_text(options.to, 4) +
                        " s, one figure every " + number_text(1e3 * step, 3) + " ms" +
                        (apart ? ", set " + number_text(kApart, 2) + " m apart" : ""));
  words.key = key_of(scales, {false, !all.shot.pushes.empty(), false, nullptr});
  const Eigen::Vector3d side(std::sin(heading(first)), -std::cos(heading(first)), 0.10);
  const double shape = static_cast<double>(options.width) / options.height;
  Stage stage = stage_of(plant, all.figure, {all.shot});
  Painter painter(all.figure, stage, scales, options.width, options.height);
  return painter.paint(all.shot, nullptr, Director::around(world_corners(all.figure, all.shot), side, shape),
                       words);
}

}  // namespace plumbline::render
