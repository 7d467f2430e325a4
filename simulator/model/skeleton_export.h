// A skeleton file corrected by what a model says, in its own format or as MJCF.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/skeleton_values.h"

namespace plumbline::model {

/// A number of the file that is another one now.
struct ExportedValue {
  std::string of, what;  ///< "knee", "damping"
  std::string before, after, unit;
};

struct SkeletonExport {
  std::string source, format;  ///< the skeleton's file; "URDF", "SDFormat" or "MJCF": what was written
  std::vector<ExportedValue> changed;
  std::vector<std::string> left_out;  ///< what the format cannot say, a sentence each
};

/// Writes the model's skeleton to `path` (.urdf, .sdf or .xml) with the model's masses, centres of mass and
/// inertias in it, and damping, friction and (MJCF) armature of its joints (skeleton_values). Into a copy of
/// the skeleton file, in which nothing else changes, comments and order included; a URDF or SDFormat skeleton
/// is also written anew as MJCF. The file is read back, and its values compared with the model's to 1e-9 of
/// the largest, before it gets its name. Throws InputError when the wished format is neither of these, or the
/// numbers make no body that a reader of the format takes.
SkeletonExport export_skeleton(const Model& model, const std::string& path);

/// The three formats' own part: the text of the skeleton's file with the model's values; `before` is the
/// skeleton as the file states it.
struct SkeletonEdit {
  const Skeleton& before;
  const SkeletonValues& after;
  std::vector<bool> bodies, joints;  ///< which ones have other values
  bool gravity = false;
};
std::string edited_urdf(const SkeletonEdit& edit);
std::string edited_sdf(const SkeletonEdit& edit);
std::string edited_mjcf(const SkeletonEdit& edit);
/// A new MJCF file of the skeleton's bodies and joints, without shapes.
std::string new_mjcf(const Skeleton& before, const SkeletonValues& after);

/// Digits that keep 1e-12 of a value.
std::string file_number(double value);
std::string file_vector(const Eigen::Vector3d& v);

}  // namespace plumbline::model
