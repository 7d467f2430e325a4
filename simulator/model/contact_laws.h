// The laws that act at one contact: of a foot and the ground, or of two links.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "contact/contact_law.h"
#include "contact/ground_change.h"
#include "contact/ground_turning.h"
#include "simulator/model/model.h"

namespace plumbline::model {

/// Least steps of differences of the laws at a contact: by the depth, m; by the velocity, m/s: the root of a
/// speed has no slope at rest.
constexpr double kLeastDepthStep = 1e-13;
constexpr double kSpeedStep = 1e-4;

/// The depth's step where it is larger, as a share of the depth.
constexpr double kShareOfDepth = 1e-6;

/// Effects by their index in the model, states by that in x.
struct ContactLaws {
  struct Normal {
    const contact::NormalLaw* law;
    int effect;
  };
  struct Drag {
    const contact::TangentialLaw* law;
    int effect, state;
  };
  struct Change {
    const contact::GroundChangeLaw* law;
    int effect;
  };
  struct Turn {
    const contact::TurningLaw* law;
    int effect;
  };
  /// Change and law that it has been applied to: contacts of a group share both.
  using Applied = std::vector<std::pair<int, int>>;

  std::vector<Normal> normals;
  std::vector<Drag> drags;
  std::vector<Change> changes;
  std::vector<Turn> turns;  ///< also those at null values: they have no state
  double height = 0.0;      ///< of all changes, m: the contact is as much deeper

  /// Takes the effects at the places that `here` holds for; states are counted from next_state on.
  void take(const Model& model, const std::vector<effects::Values>& values,
            const std::function<bool(const std::string&)>& here, int& next_state);

  /// Sets the height, and applies the changes to what the laws' values were stated as.
  void change(const std::vector<effects::Values>& stated, std::vector<effects::Values>& changed,
              Applied& applied);

  /// [along the surface, in the two directions of the slip; out of it], N, on what is `depth` m in it and
  /// sinks with `rate`, m/s. Rates of states are written to xdot where it is given.
  Eigen::Vector3d force(double depth, double rate, const Eigen::Vector2d& slip, const double* x,
                        const std::vector<effects::Values>& values, double* xdot) const;
  /// On what turns with `turn`, rad/s, under the normal force, N m; both in axes whose third is the normal.
  Eigen::Vector3d moment(const Eigen::Vector3d& turn, double normal,
                         const std::vector<effects::Values>& values) const;
};

}  // namespace plumbline::model
