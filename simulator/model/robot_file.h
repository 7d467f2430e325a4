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

/// SDFormat or URDF through libsdformat. `model_name` may be empty when the file holds one model.
Skeleton read_skeleton(const std::string& path);

/// A change on top of a model: an effect added, or values set with their new uncertainty and source.
struct AddedEffect {
  std::string effect, at;
  effects::Values values;
};
struct NewValue {
  std::string at_key;  ///< "viscous@mLA:damping"
  double value = 0, uncertainty = 0;
  std::string unit, source;
};
/// Writes an overlay file `path` whose base is `base_file` (path kept relative to the overlay). The overlay is
/// read back before it is written: throws InputError, and writes nothing, when the base does not know a name or
/// a value is outside its bounds. The catalogue gives the parameters' names and units.
void write_overlay(const std::string& path, const std::string& base_file, const std::vector<AddedEffect>& added,
                   const std::vector<NewValue>& values, const std::string& note,
                   const effects::Catalogue& catalogue = effects::Catalogue::all());

}  // namespace plumbline::model
