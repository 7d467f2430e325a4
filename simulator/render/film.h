// Frames of a motion, with scales, camera and words chosen to fit it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/render/figure.h"
#include "simulator/render/painter.h"
#include "simulator/render/snapshot.h"
#include "simulator/render/view.h"

namespace plumbline::render {

struct FilmOptions {
  std::string title;
  std::vector<std::string> notes;        ///< smaller lines under the time
  std::vector<std::string> phase_names;  ///< of phases 1, 2, ...
  Camera camera = Camera::side;
  int width = 1280, height = 720;
  double from = 0.0, to = 0.0;  ///< what is to be seen, s
  std::optional<double> at{};   ///< of this moment alone: then the camera need not hold the rest
  double exaggeration = 0.0;    ///< of cable stretch; 0: chosen so that the largest can be seen
};

constexpr double kLongestArrow = 0.5;  ///< m
/// How long the longest arrows should be, m: a third of the height of robot and motion, at most
/// kLongestArrow.
double arrow_length(const Figure& figure, const std::vector<Snapshot>& shots);
/// The force that one metre of arrow stands for, N: 1, 2 or 5 times a power of ten, such that the longest
/// arrows (but for the rare peaks of impacts) are about so long.
double arrow_scale(const std::vector<Snapshot>& shots, double longest);
/// 1, 2, 5, 10, ... times, such that the largest stretch is drawn as at most 50 degrees (or 0.1 m).
double stretch_scale(const std::vector<Snapshot>& shots);

/// The stage under a motion: the terrain of the plant when the model has feet or stands above z = 0, none
/// when it reaches below.
Stage stage_of(const model::Plant& plant, const Figure& figure, const std::vector<Snapshot>& shots);

class Film {
 public:
  /// `model` is drawn, `measured` (may be null) is its ghost. All must outlive this object.
  Film(const Figure& figure, const model::Plant& plant, const Snapshots& model, const Snapshots* measured,
       const FilmOptions& options);

  Image frame(double time);

 private:
  Captions captions(const Snapshot& shot) const;
  Snapshot shot_at(double time) const;

  FilmOptions options_;
  const Snapshots& model_;
  const Snapshots* measured_;
  Scales scales_;
  Captions fixed_;
  Director director_;
  std::vector<Eigen::Vector3d> beside_;  // by body: from where it turns to where it is drawn
  std::unique_ptr<Painter> painter_;
};

/// A still with `count` stick figures, the first at options.from and the last at options.to, from light to
/// dark. They stand where they were; when the robot hardly gets on between two of them, side by side.
Image strip(const Figure& figure, const model::Plant& plant, const Snapshots& motion, int count,
            const FilmOptions& options);

}  // namespace plumbline::render
