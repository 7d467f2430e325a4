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
  bool read = false;                  ///< there is a mesh
  bool closed = false;                ///< what follows means something
  double volume = 0.0;                ///< m^3
  double density = 0.0;               ///< given, or that which gives the model's mass, kg/m^3
  double mass = 0.0;                  ///< of the mesh, kg
  double model_mass = 0.0;            ///< kg
  double center_distance = 0.0;       ///< between the mesh's and the model's centre of mass, m
  double inertia_difference = 0.0;    ///< |I_mesh - I_model| / |I_model|, Frobenius, about either's centre
};

/// Solids of the given density; without one (0), of the density that gives the model's mass: then a body
/// without mass has none, and a density that no matter has is a problem.
std::vector<MeshOfBody> meshes_of(const model::Model& model, double density);

nlohmann::json to_json(const std::vector<MeshOfBody>& meshes);
void print(const std::vector<MeshOfBody>& meshes, double density);

}  // namespace plumbline::cli
