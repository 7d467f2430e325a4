// The links' meshes beside the model's masses, in words and as JSON.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::cli {

/// A body that has a mesh (its own and all others of the body taken together).
struct MeshOfBody {
  std::string body;
  std::vector<std::string> problems;  ///< meshes that cannot be read, one line each
  bool closed = false;                ///< what follows means something
  double volume = 0.0;                ///< m^3
  double density = 0.0;               ///< that gives the model's mass, kg/m^3
  double center_distance = 0.0;       ///< between the mesh's and the model's centre of mass, m
  double inertia_difference = 0.0;    ///< |I_mesh - I_model| / |I_model|, Frobenius, about either's centre
};

/// Solids of one density that has the model's mass. A body without mass has no density.
std::vector<MeshOfBody> meshes_of(const model::Model& model);

nlohmann::json to_json(const std::vector<MeshOfBody>& meshes);
void print(const std::vector<MeshOfBody>& meshes);

}  // namespace plumbline::cli
