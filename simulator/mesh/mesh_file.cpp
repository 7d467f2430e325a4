#include "simulator/mesh/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <exception>
#include <filesystem>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::mesh {
namespace {

constexpr std::size_t kMostTriangles = 2'000'000;
constexpr std::uintmax_t kMostBytes = 500'000'000;
constexpr double kLargest = 20.0;   // m: larger than any robot's link
constexpr double kSmallest = 1e-4;  // m

struct Trouble {
  std::string found, expected;
};

Eigen::Vector3d to_eigen(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

void append(const aiMesh& part, const aiMatrix4x4& X, const Eigen::Vector3d& scale, Mesh& mesh) {
  const int first = static_cast<int>(mesh.points.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    mesh.points.push_back(scale.cwiseProduct(to_eigen(X * part.mVertices[i])));
  }
  const bool mirrored = scale.prod() < 0.0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices == 3) {
      const auto index = [&](int k) { return first + static_cast<int>(face.mIndices[k]); };
      mesh.triangles.push_back({index(0), index(mirrored ? 2 : 1), index(mirrored ? 1 : 2)});
    }
  }
}

void append(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_parent,
            const Eigen::Vector3d& scale, Mesh& mesh) {
  const aiMatrix4x4 X = X_parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    append(*scene.mMeshes[node.mMeshes[i]], X, scale, mesh);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    append(scene, *node.mChildren[i], X, scale, mesh);
  }
}

double area(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](int i) { return mesh.points[static_cast<std::size_t>(i)]; };
    sum += 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).norm();
  }
  return sum;
}

void check(const Mesh& mesh) {
  if (mesh.triangles.size() > kMostTriangles) {
    throw Trouble{std::to_string(mesh.triangles.size()) + " triangles",
                  "at most " + std::to_string(kMostTriangles)};
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : mesh.points) {
    if (!point.allFinite()) {
      throw Trouble{"a coordinate that is no number", "finite coordinates"};
    }
    box.extend(point);
  }
  const double size = mesh.points.empty() ? 0.0 : box.diagonal().norm();
  if (mesh.triangles.empty() || !(area(mesh) > 1e-12 * size * size)) {
    throw Trouble{"no triangle with an area", "a surface of triangles"};
  }
  if (size > kLargest || size < kSmallest) {
    throw Trouble{"a size of " + number_text(size, 3) + " m across",
                  "metres (a <scale> of 0.001 makes them of millimetres)"};
  }
}

Mesh load(const std::string& path, const Eigen::Vector3d& scale) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) {
    throw Trouble{"no such file", "a mesh"};
  }
  if (std::filesystem::file_size(path, none) > kMostBytes) {
    throw Trouble{"more than 500 MB", "a smaller mesh"};
  }
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  // Without normals and texture coordinates points at one place are one point: a closed surface is seen so.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TEXCOORDS | aiComponent_COLORS |
                                  aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_MATERIALS);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(
      path, static_cast<unsigned>(aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_RemoveComponent |
                                  aiProcess_JoinIdenticalVertices));
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Trouble{std::string("nothing that can be read (") + importer.GetErrorString() + ")",
                  "a mesh as OBJ, STL, DAE or glTF"};
  }
  Mesh mesh;
  append(*scene, *scene->mRootNode, aiMatrix4x4(), scale, mesh);
  return mesh;
}

std::string one_line(std::string text) {
  for (char& c : text) {
    c = c == '\n' || c == '\r' ? ' ' : c;
  }
  return text;
}

}  // namespace

MeshFile read_mesh(const std::string& path, const Eigen::Vector3d& scale) {
  MeshFile result;
  Trouble trouble;
  try {
    result.mesh = load(path, scale);
    check(result.mesh);
    return result;
  } catch (const Trouble& found) {
    trouble = found;
  } catch (const std::exception& error) {
    trouble = {std::string("nothing that can be read (") + error.what() + ")", "a mesh"};
  }
  return {{}, one_line(InputError({path, 0, "mesh"}, trouble.found, trouble.expected).what())};
}

}  // namespace plumbline::mesh
