// What is measured at points of links, in a trial: three columns, or the four of a quaternion.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {

/// The first component of the point sensor that the model calls so; null for any other name.
const model::Sensor* point_sensor(const model::Model& model, const std::string& group);

/// An entry of `measured` for it: `columns` of its three components, of an orientation those of a quaternion
/// w x y z. Throws InputError.
void read_point(const model::YamlNode& node, const model::Sensor& first, const model::Model& model,
                std::vector<MeasuredUse>& uses);

/// Rotation vectors r of quaternions (w, x, y, z of any length above 0.5), 3 x rows, each the one of the two
/// ways that is nearer to the row before, so that |r| may pass pi. A shorter quaternion throws InputError
/// with `file` and `column`.
Eigen::Matrix3Xd rotation_vectors(const std::array<Eigen::VectorXd, 4>& quaternions, const std::string& file,
                                  const std::string& column);

}  // namespace plumbline::validation
