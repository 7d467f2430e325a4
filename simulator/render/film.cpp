#include "simulator/render/film.h"

#include <algorithm>
#include <cmath>

#include "simulator/render/key.h"

namespace plumbline::render {
namespace {

constexpr int kLooks = 200;           // moments at which scales are taken
constexpr double kArrowShare = 0.35;  // of the height that is seen
constexpr double kMostOften = 0.95;   // share of the contact that is below them
constexpr double kSector = 0.9;       // rad, of the largest stretch
constexpr double kBar = 0.1;          // m, the same where a joint slides
constexpr double kLeastForce = 1.0;   // N

std::vector<Snapshot> looks(const Snapshots& motion, double from, double to) {
  std::vector<Snapshot> shots;
  for (int k = 0; k <= kLooks; ++k) {
    shots.push_back(motion.at(from + (to - from) * k / kLooks));
  }
  return shots;
}

bool has_forces(const std::vector<Snapshot>& shots) {
  return !shots.empty() && !shots.front().pushes.empty();
}

Scales scales_of(const Figure& figure, const Snapshots& motion, const std::vector<Snapshot>& shots,
                 double exaggeration) {
  Scales scales;
  const double arrow = arrow_length(figure, shots);
  scales.newtons_per_metre = arrow_scale(shots, arrow);
  scales.arrow = arrow / kLongestArrow;
  scales.spring = motion.has_springs() ? motion.largest_spring() : 0.0;
  scales.stretch = exaggeration > 0.0 ? exaggeration : stretch_scale(shots);
  return scales;
}

/// A planar model has its legs' joints in one plane, but they are drawn side by side. By body, in its frame:
/// the way along the joint's axis to the middle of what is drawn, where the joint lies outside of it.
std::vector<Eigen::Vector3d> drawn_beside(const Figure& figure, const model::Skeleton& skeleton) {
  std::vector<Eigen::Vector3d> ways(skeleton.bodies.size(), Eigen::Vector3d::Zero());
  for (const model::Joint& joint : skeleton.joints) {
    if (joint.type != model::JointType::revolute) {
      continue;
    }
    const Eigen::Vector3d axis = joint.X_CJ.linear() * joint.axis.normalized();
    Eigen::AlignedBox<double, 1> drawn;
    for (const Part& part : figure.parts) {
      for (const Eigen::Vector3d& corner :
           part.body == joint.child ? corners_of(part) : std::vector<Eigen::Vector3d>()) {
        drawn.extend(Eigen::Matrix<double, 1, 1>(axis.dot(corner - joint.X_CJ.translation())));
      }
    }
    if (!drawn.isEmpty() && drawn.min()[0] * drawn.max()[0] > 0.0) {
      ways[static_cast<std::size_t>(joint.child)] = drawn.center()[0] * axis;
    }
  }
  return ways;
}

}  // namespace

double arrow_length(const Figure& figure, const std::vector<Snapshot>& shots) {
  Eigen::AlignedBox3d box;
  for (const Snapshot& shot : shots) {
    for (const Eigen::Vector3d& corner : world_corners(figure, shot)) {
      box.extend(corner);
    }
  }
  return box.isEmpty() ? kLongestArrow : std::min(kLongestArrow, kArrowShare * box.diagonal().z());
}

double arrow_scale(const std::vector<Snapshot>& shots, double longest) {
  std::vector<double> sizes;
  for (const Snapshot& shot : shots) {
    for (const Push& push : shot.pushes) {
      if (push.force.norm() > kLeastForce) {
        sizes.push_back(push.force.norm());
      }
    }
  }
  if (sizes.empty()) {
    return 1000.0;
  }
  std::sort(sizes.begin(), sizes.end());
  const auto most = static_cast<std::size_t>(kMostOften * static_cast<double>(sizes.size() - 1));
  return round_down(sizes[most] / longest);
}

double stretch_scale(const std::vector<Snapshot>& shots) {
  double largest = 0.0;  // as a share of what is to be seen
  for (const Snapshot& shot : shots) {
    for (const Stretch& stretch : shot.stretches) {
      largest = std::max(largest, std::abs(stretch.amount) / (stretch.turns ? kSector : kBar));
    }
  }
  return largest > 1e-6 && largest < 1.0 ? round_down(1.0 / largest) : 1.0;
}

Stage stage_of(const model::Plant& plant, const Figure& figure, const std::vector<Snapshot>& shots) {
  Eigen::AlignedBox3d box;
  for (const Snapshot& shot : shots) {
    for (const Eigen::Vector3d& corner : world_corners(figure, shot)) {
      box.extend(corner);
    }
  }
  Stage stage;
  stage.height = plant.terrain().floor();
  stage.ground = !plant.model().feet.empty() || box.min().z() > -0.01;
  stage.center = box.center().head<2>();
  stage.reach = std::max(2.0, box.diagonal().head<2>().norm());
  for (const contact::Platform& platform : plant.terrain().platforms()) {
    stage.steps.push_back({platform.from, platform.to, platform.height});
  }
  return stage;
}

Film::Film(const Figure& figure, const model::Plant& plant, const Snapshots& model, const Snapshots* measured,
           const FilmOptions& options)
    : options_(options),
      model_(model),
      measured_(measured),
      director_(figure, plant.model().skeleton, model, options.camera,
                static_cast<double>(options.width) / options.height, options.at.value_or(options.from),
                options.at.value_or(options.to)),
      beside_(drawn_beside(figure, plant.model().skeleton)) {
  const std::vector<Snapshot> shots = looks(model, options.from, options.to);
  scales_ = scales_of(figure, model, shots, options.exaggeration);
  fixed_.title = options.title;
  fixed_.key = key_of(scales_, {measured != nullptr, has_forces(shots), model.has_stretches(),
                                model.has_springs() ? &model : nullptr});
  painter_ = std::make_unique<Painter>(figure, stage_of(plant, figure, shots), scales_, options.width,
                                       options.height);
}

Captions Film::captions(const Snapshot& shot) const {
  Captions words = fixed_;
  words.lines.push_back(time_line(shot, options_.phase_names));
  words.notes = options_.notes;
  return words;
}

// Marks stand where the links are drawn.
Snapshot Film::shot_at(double time) const {
  Snapshot shot = model_.at(time);
  const auto way = [&](int body) {
    const auto b = static_cast<std::size_t>(body);
    return Eigen::Vector3d(shot.poses[b].linear() * beside_[b]);
  };
  for (Push& push : shot.pushes) {
    push.point += way(push.body);
  }
  for (Stretch& stretch : shot.stretches) {
    stretch.X_WJ.pretranslate(way(stretch.body));
  }
  return shot;
}

Image Film::frame(double time) {
  const Snapshot shot = shot_at(time);
  if (measured_ == nullptr) {
    return painter_->paint(shot, nullptr, director_.view(time), captions(shot));
  }
  const Snapshot ghost = measured_->at(time);
  return painter_->paint(shot, &ghost, director_.view(time), captions(shot));
}

}  // namespace plumbline::render
