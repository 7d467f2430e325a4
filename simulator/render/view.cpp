#include "simulator/render/view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "simulator/model/model.h"
#include "simulator/trace/error.h"

namespace plumbline::render {
namespace {

constexpr double kSideHeight = 0.10;  // rise of the line of sight over its length
constexpr double kBoomHeight = 0.42;
constexpr double kAside = 1.08;  // room beside, and above and below, as a factor
constexpr double kAbove = 1.20;
constexpr double kForWords = 0.09;  // share of half the height by which things stand lower: words are above
constexpr double kSmooth = 0.25;    // s to either side, over which a followed robot's place is averaged
constexpr int kLooks = 60;          // moments of a motion that are framed
constexpr double kAngle = 0.35;
constexpr int kRounds = 4;  // of centring: each brings the middle several times nearer

/// Axes of the eye at a direction from the target.
struct EyeFrame {
  Eigen::Vector3d right, up, back;
};
EyeFrame frame_at(const Eigen::Vector3d& toward_eye) {
  const Eigen::Vector3d back = toward_eye.normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(back).normalized();
  return {right, back.cross(right), back};
}

/// How far from the target the eye must be for a point (relative to the target) to be in the picture.
double needed_distance(const Eigen::Vector3d& p, const EyeFrame& eye, double width_to_height) {
  const double across = std::tan(0.5 * kAngle);
  const double aside = std::abs(p.dot(eye.right)) / (across * width_to_height);
  const double above = std::abs(p.dot(eye.up)) / across;
  return std::max(kAside * aside, kAbove * above) + p.dot(eye.back);
}

/// How far the target is from the middle of what an eye at this distance sees of the points.
Eigen::Vector3d off_center(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& target,
                           const EyeFrame& eye, double distance) {
  Eigen::AlignedBox2d seen;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point - target;
    seen.extend(Eigen::Vector2d(p.dot(eye.right), p.dot(eye.up)) / (distance - p.dot(eye.back)));
  }
  return distance * (seen.center().x() * eye.right + seen.center().y() * eye.up);
}

Eigen::Vector3d level(const Eigen::Vector3d& v) { return {v.x(), v.y(), 0.0}; }

int heaviest_moving(const model::Skeleton& skeleton) {
  int best = 0;
  double most = -1.0;
  std::vector<bool> moves(skeleton.bodies.size());
  for (std::size_t b = 0; b < skeleton.bodies.size(); ++b) {
    const model::Joint& joint = skeleton.joints[b];
    moves[b] = joint.type != model::JointType::fixed ||
               (joint.parent >= 0 && moves[static_cast<std::size_t>(joint.parent)]);
    if (moves[b] && skeleton.bodies[b].mass > most) {
      most = skeleton.bodies[b].mass;
      best = static_cast<int>(b);
    }
  }
  return best;
}

bool turns_about_vertical(const model::Joint& joint) {
  return joint.type == model::JointType::revolute && joint.parent < 0 &&
         std::abs((joint.X_PJ.linear() * joint.axis.normalized()).z()) > 0.9;
}

/// The horizontal direction about which most joints turn, toward -y or, across it, +x.
Eigen::Vector3d side_of(const model::Skeleton& skeleton, const Snapshot& shot) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const model::Joint& joint : skeleton.joints) {
    if (joint.type == model::JointType::revolute) {
      const Eigen::Vector3d axis = level(shot.poses[static_cast<std::size_t>(joint.child)].linear() *
                                         (joint.X_CJ.linear() * joint.axis.normalized()));
      sum += axis * axis.transpose();
    }
  }
  if (sum.trace() < 0.1) {
    return -Eigen::Vector3d::UnitY();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
  const Eigen::Vector3d side = level(solver.eigenvectors().col(2)).normalized();
  const double sense = std::abs(side.y()) > 0.1 ? -side.y() : side.x();
  return sense < 0.0 ? Eigen::Vector3d(-side) : side;
}

}  // namespace

Camera camera_named(const std::string& name) {
  if (name == "side") return Camera::side;
  if (name == "follow") return Camera::follow;
  if (name == "boom") return Camera::boom;
  throw InputError({"", 0, "--camera"}, "\"" + name + "\"", "side, follow or boom");
}

std::vector<Eigen::Vector3d> world_corners(const Figure& figure, const Snapshot& shot) {
  std::vector<Eigen::Vector3d> points;
  for (const Part& part : figure.parts) {
    for (const Eigen::Vector3d& corner : corners_of(part)) {
      points.push_back(shot.poses[static_cast<std::size_t>(part.body)] * corner);
    }
  }
  return points;
}

View Director::around(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& toward_eye,
                      double width_to_height) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) {
    box.extend(point);
  }
  View view;
  view.angle = kAngle;
  view.target = box.center();
  const EyeFrame eye = frame_at(toward_eye);
  double distance = 0.1;
  for (int round = 0; round < kRounds; ++round) {
    distance = 0.1;
    for (const Eigen::Vector3d& point : points) {
      distance = std::max(distance, needed_distance(point - view.target, eye, width_to_height));
    }
    view.target += off_center(points, view.target, eye, distance);
  }
  view.target += kForWords * distance * std::tan(0.5 * kAngle) * eye.up;
  view.eye = view.target + distance * eye.back;
  return view;
}

Director::Director(const Figure& figure, const model::Skeleton& skeleton, const Snapshots& motion,
                   Camera camera, double width_to_height, double from, double to)
    : motion_(motion), camera_(camera), base_(heaviest_moving(skeleton)) {
  carried_ = std::any_of(skeleton.joints.begin(), skeleton.joints.end(), turns_about_vertical);
  const double middle = 0.5 * (from + to);
  side_ = motion.at(middle).poses[static_cast<std::size_t>(base_)].linear().transpose() *
          side_of(skeleton, motion.at(middle));
  std::vector<Eigen::Vector3d> all;
  double low = 1e9;
  double high = -1e9;
  for (int k = 0; k <= kLooks; ++k) {
    const double time = from + (to - from) * k / kLooks;
    const std::vector<Eigen::Vector3d> corners = world_corners(figure, motion.at(time));
    all.insert(all.end(), corners.begin(), corners.end());
    for (const Eigen::Vector3d& corner : corners) {
      low = std::min(low, corner.z());
      high = std::max(high, corner.z());
    }
  }
  if (camera_ != Camera::follow) {
    still_ = around(all, toward_eye(middle), width_to_height);
    return;
  }
  lift_ = 0.5 * (low + high);
  for (int k = 0; k <= kLooks; ++k) {
    const double time = from + (to - from) * k / kLooks;
    const EyeFrame eye = frame_at(toward_eye(time));
    for (const Eigen::Vector3d& corner : world_corners(figure, motion.at(time))) {
      distance_ = std::max(distance_, needed_distance(corner - robot_place(time), eye, width_to_height));
    }
  }
}

Eigen::Vector3d Director::robot_place(double time) const {
  constexpr int kParts = 10;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int k = -kParts; k <= kParts; ++k) {
    mean += motion_.at(time + kSmooth * k / kParts).poses[static_cast<std::size_t>(base_)].translation();
  }
  mean /= 2.0 * kParts + 1.0;
  return {mean.x(), mean.y(), lift_};
}

Eigen::Vector3d Director::toward_eye(double time) const {
  const Eigen::Matrix3d R = motion_.at(time).poses[static_cast<std::size_t>(base_)].linear();
  Eigen::Vector3d side = level(R * side_).normalized();
  double height = kSideHeight;
  if (camera_ == Camera::boom) {
    side = Eigen::AngleAxisd(0.75, Eigen::Vector3d::UnitZ()) * side;
    height = kBoomHeight;
  }
  return side + height * Eigen::Vector3d::UnitZ();
}

View Director::view(double time) const {
  if (camera_ != Camera::follow) {
    return still_;
  }
  View view;
  view.angle = kAngle;
  view.target = robot_place(time);
  view.target.z() += kForWords * distance_ * std::tan(0.5 * kAngle);
  view.eye = view.target + distance_ * toward_eye(time).normalized();
  return view;
}

}  // namespace plumbline::render
