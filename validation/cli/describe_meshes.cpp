#include "validation/cli/describe_meshes.h"

#include <fmt/core.h>

#include "simulator/model/visual.h"
#include "simulator/render/mesh_file.h"
#include "simulator/render/mesh_mass.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using render::Mesh;

void append(const Mesh& part, const Eigen::Isometry3d& X, Mesh& whole) {
  const int first = static_cast<int>(whole.points.size());
  for (const Eigen::Vector3d& point : part.points) {
    whole.points.emplace_back(X * point);
  }
  for (const auto& [a, b, c] : part.triangles) {
    whole.triangles.push_back({first + a, first + b, first + c});
  }
}

void compare(const Mesh& mesh, const model::Body& body, MeshOfBody& result) {
  result.closed = render::is_closed(mesh);
  if (!result.closed) {
    return;
  }
  const render::SolidProperties solid = render::solid_properties(mesh);
  result.volume = solid.volume;
  if (body.mass > 0.0 && solid.volume > 0.0) {
    result.density = body.mass / solid.volume;
    result.center_distance = (solid.center - body.com).norm();
    result.inertia_difference = (result.density * solid.inertia - body.inertia).norm() / body.inertia.norm();
  }
}

}  // namespace

std::vector<MeshOfBody> meshes_of(const model::Model& model) {
  const model::Visuals visuals = model::read_visuals(model.skeleton.file);
  std::vector<MeshOfBody> results;
  for (const model::Body& body : model.skeleton.bodies) {
    const auto found = visuals.of_link.find(body.name);
    if (found == visuals.of_link.end()) {
      continue;
    }
    MeshOfBody result;
    result.body = body.name;
    Mesh whole;
    for (const model::Visual& visual : found->second) {
      if (const auto* shape = std::get_if<model::MeshShape>(&visual.shape)) {
        const render::MeshFile file = render::read_mesh(*shape);
        append(file.mesh, visual.X_BV, whole);
        if (!file.problem.empty()) {
          result.problems.push_back(file.problem);
        }
      }
    }
    if (!whole.triangles.empty() || !result.problems.empty()) {
      compare(whole, body, result);
      results.push_back(result);
    }
  }
  return results;
}

nlohmann::json to_json(const std::vector<MeshOfBody>& meshes) {
  nlohmann::json list = nlohmann::json::array();
  for (const MeshOfBody& mesh : meshes) {
    nlohmann::json row{{"body", mesh.body}, {"problems", mesh.problems}, {"closed", mesh.closed}};
    row["volume"] = mesh.closed ? nlohmann::json(mesh.volume) : nlohmann::json();
    const bool heavy = mesh.density > 0.0;
    row["density"] = heavy ? nlohmann::json(mesh.density) : nlohmann::json();
    row["center_distance"] = heavy ? nlohmann::json(mesh.center_distance) : nlohmann::json();
    row["inertia_difference"] = heavy ? nlohmann::json(mesh.inertia_difference) : nlohmann::json();
    list.push_back(row);
  }
  return list;
}

void print(const std::vector<MeshOfBody>& meshes) {
  if (meshes.empty()) {
    return;
  }
  fmt::print("\nMeshes, as solids of the one density that gives the model's mass:\n\n");
  std::vector<std::vector<std::string>> rows;
  for (const MeshOfBody& mesh : meshes) {
    const bool heavy = mesh.density > 0.0;
    rows.push_back({mesh.body, mesh.closed ? fmt::format("{:.4g} dm^3", 1e3 * mesh.volume) : "not closed",
                    heavy ? fmt::format("{:.0f} kg/m^3", mesh.density) : "-",
                    heavy ? fmt::format("{:.1f} mm", 1e3 * mesh.center_distance) : "-",
                    heavy ? fmt::format("{:.0f} %", 1e2 * mesh.inertia_difference) : "-"});
  }
  print_table({"body", "volume", "density", "centre of mass off by", "inertia off by"}, rows);
  for (const MeshOfBody& mesh : meshes) {
    for (const std::string& problem : mesh.problems) {
      fmt::print("  {}\n", problem);
    }
  }
}

}  // namespace plumbline::cli
