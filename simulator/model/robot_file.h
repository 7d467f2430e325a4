// Reads model.yaml (and overlays on it) and its skeleton into a validated Model; writes overlays.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::model {

/// Reads a model file. Throws InputError (one line: file, line, key, found, expected) on unknown keys, wrong
/// units, impossible values (negative mass, zero ratio, singular mass matrix is found later), unknown places
/// or effects, cut-off YAML.
Model read_model(const std::string& path, const effects::Catalogue& catalogue);

/// SDFormat or URDF through libsdformat: one model of links and revolute, continuous, prismatic or fixed
/// joints; ball and universal ones of SDFormat, floating and planar ones of URDF become chains
/// (joint_chain.h). Every link stays a body, also behind a fixed joint. A single root link is fixed to the
/// world when no joint leads there, unless the model says `floating_base: true`. Masses that the file does
/// not state are not invented: a link without <inertial> has none, and must be fixed to the world or to a
/// link that has one. Joint limits, damping and friction of the file are not read: those are effects. Gravity
/// is the world's when it states one. Throws InputError with file, line and link or joint.
Skeleton read_skeleton(const std::string& path);

/// A change on top of a model: an effect added, or values set with their new uncertainty and source.
struct AddedEffect {
  std::string effect, at;
  effects::Values values;
  bool again = false;  ///< beside one of its kind that the base has there
  /// One standard deviation of each value, SI, where they were found; NaN: not found, assumed. Empty: none
  /// was.
  effects::Values deviations{};
};
struct NewValue {
  std::string at_key;  ///< "viscous@mLA:damping"
  double value = 0, uncertainty = 0;
  std::string unit, source;
};
/// Writes an overlay file `path` whose base is `base_file` (path kept relative to the overlay). The overlay
/// is read back before it is written: throws InputError, and writes nothing, when the base does not know a
/// name or a value is outside its bounds. The catalogue gives the parameters' names and units; `correlations`
/// how the deviations of what is written hang together.
void write_overlay(const std::string& path, const std::string& base_file,
                   const std::vector<AddedEffect>& added, const std::vector<NewValue>& values,
                   const std::string& note, const effects::Catalogue& catalogue,
                   const Correlations& correlations = {});

}  // namespace plumbline::model
