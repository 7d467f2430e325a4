#include "validation/cli/describe_meshes.h"

#include <fmt/core.h>

#include "simulator/mesh/mesh_file.h"
#include "simulator/mesh/mesh_mass.h"
#include "simulator/model/visual.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using mesh::Mesh;

void append(const Mesh& part, const Eigen::Isometry3d& X, Mesh& whole) {
  const int first = static_cast<int>(whole.points.size());
  for (const Eigen::Vector3d& point : part.points) {
    whole.points.emplace_back(X * point);
  }
  for (const auto& [a, b, c] : part.triangles) {
    whole.triangles.push_back({first + a, first + b, first + c});
  }
}

// Of matter and of hollow parts, kg/m^3. A mesh in millimetres that was taken for metres is off by 1e9.
constexpr double kLightest = 1.0;
constexpr double kHeaviest = 30000.0;

void compare(const Mesh& whole, const model::Body& body, double density, MeshOfBody& result) {
  result.read = !whole.triangles.empty();
  result.closed = mesh::is_closed(whole);
  if (!result.closed) {
    return;
  }
  const mesh::SolidProperties solid = mesh::solid_properties(whole);
  result.volume = solid.volume;
  result.model_mass = body.mass;
  if (body.mass > 0.0 && solid.volume > 0.0) {
    result.density = density > 0.0 ? density : body.mass / solid.volume;
    result.mass = result.density * solid.volume;
    result.center_distance = (solid.center - body.com).norm();
    result.inertia_difference = (result.density * solid.inertia - body.inertia).norm() / body.inertia.norm();
    if (result.density < kLightest || result.density > kHeaviest) {
      result.problems.push_back(
          fmt::format("{}: its mesh would need a density of {:.2g} kg/m^3 for {:.3g} kg: is it in another "
                      "unit than metres?",
                      body.name, result.density, body.mass));
    }
  }
}

}  // namespace

std::vector<MeshOfBody> meshes_of(const model::Model& model, double density) {
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
        const mesh::MeshFile file = mesh::read_mesh(shape->file, shape->scale);
        append(file.mesh, visual.X_BV, whole);
        if (!file.problem.empty()) {
          result.problems.push_back(file.problem);
        }
      }
    }
    if (!whole.triangles.empty() || !result.problems.empty()) {
      compare(whole, body, density, result);
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
    row["mass"] = heavy ? nlohmann::json(mesh.mass) : nlohmann::json();
    row["center_distance"] = heavy ? nlohmann::json(mesh.center_distance) : nlohmann::json();
    row["inertia_difference"] = heavy ? nlohmann::json(mesh.inertia_difference) : nlohmann::json();
    list.push_back(row);
  }
  return list;
}

void print(const std::vector<MeshOfBody>& meshes, double density) {
  if (meshes.empty()) {
    return;
  }
  const bool given = density > 0.0;
  given ? fmt::print("\nMeshes, as solids of {:g} kg/m^3:\n\n", density)
        : fmt::print("\nMeshes, as solids of the one density that gives the model's mass:\n\n");
  std::vector<std::vector<std::string>> rows;
  for (const MeshOfBody& mesh : meshes) {
    const bool heavy = mesh.density > 0.0;
    std::vector<std::string> row{mesh.body, mesh.closed ? fmt::format("{:.4g} dm^3", 1e3 * mesh.volume)
                                            : mesh.read ? "not closed"
                                                        : "-"};
    if (given) {
      row.push_back(heavy ? fmt::format("{:.4g} kg", mesh.mass) : "-");
      row.push_back(heavy ? fmt::format("{:.4g} kg", mesh.model_mass) : "-");
    } else {
      row.push_back(heavy ? fmt::format("{:.0f} kg/m^3", mesh.density) : "-");
    }
    row.push_back(heavy ? fmt::format("{:.1f} mm", 1e3 * mesh.center_distance) : "-");
    row.push_back(heavy ? fmt::format("{:.0f} %", 1e2 * mesh.inertia_difference) : "-");
    rows.push_back(row);
  }
  std::vector<std::string> head{"body", "volume"};
  head.insert(head.end(), {given ? "mass" : "density", "centre of mass off by", "inertia off by"});
  if (given) {
    head.insert(head.begin() + 3, "in the model");
  }
  print_table(head, rows);
  for (const MeshOfBody& mesh : meshes) {
    for (const std::string& problem : mesh.problems) {
      fmt::print("  {}\n", problem);
    }
  }
}

}  // namespace plumbline::cli
