// One moment of a motion: everything that a frame shows of it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "simulator/model/plant.h"
#include "simulator/render/motion.h"
#include "simulator/render/sticks.h"

namespace plumbline::render {

/// The ground's force on a foot.
struct Push {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N
  int body = -1;                                    ///< that has the foot
};

/// A cable's stretch, as the angle (or way) at the joint that it drives: from where the motor would hold the
/// link, were the cable rigid, to where it is.
struct Stretch {
  Eigen::Isometry3d X_WJ = Eigen::Isometry3d::Identity();  ///< at the joint; the axis is z, the link along x
  bool turns = true;
  double amount = 0.0;  ///< rad or m
  double link = 0.2;    ///< half the link's length, m
  int body = -1;        ///< the link
};

struct Snapshot {
  double time = 0.0;
  int phase = 0;                         ///< 0: none is known
  std::vector<Eigen::Isometry3d> poses;  ///< of the bodies
  std::vector<Push> pushes;              ///< by foot
  std::vector<Stretch> stretches;        ///< by released ratio
  std::vector<double> spring;            ///< by body: |deflection| of the spring that loads it, rad or m
};

/// A motion as snapshots.
class Snapshots {
 public:
  /// Both must outlive this object.
  Snapshots(const model::Plant& plant, const Motion& motion);

  /// Positions and forces between two samples lie on the line between them. Times beyond the ends give the
  /// ends.
  Snapshot at(double time) const;

  double begin() const { return motion_.time[0]; }
  double end() const { return motion_.time[motion_.time.size() - 1]; }
  /// Of all samples.
  double largest_spring() const;
  bool has_springs() const;
  bool springs_turn() const { return springs_turn_; }
  bool has_stretches() const { return !cables_.empty(); }

 private:
  struct Cable {
    std::string ratio;
    int joint;      // index in the skeleton
    double factor;  // of the stretch, at the joint
  };
  struct Spring {
    std::string at;
    int body;
    double rest, side;  // side 0: it acts on both sides of its rest
  };
  void find_cables();
  void find_springs();
  double deflection(const Spring& spring, const double* x) const;
  Eigen::VectorXd state_at(double time) const;
  void add_stretches(const double* x, Snapshot& shot) const;

  const model::Plant& plant_;
  const Motion& motion_;
  std::vector<Cable> cables_;
  std::vector<Spring> springs_;
  bool springs_turn_ = true;
  std::vector<Eigen::Vector3d> directions_;
};

}  // namespace plumbline::render
