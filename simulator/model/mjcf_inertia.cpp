#include "simulator/model/mjcf_inertia.h"

#include <filesystem>
#include <optional>
#include <vector>

#include "simulator/mesh/mesh_file.h"
#include "simulator/mesh/mesh_mass.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr double kNothing = 1e-12;

}  // namespace

MjcfInertia::MjcfInertia(const MjcfDocument& document) : MjcfValues(document) {
  for (const XMLElement* compiler : source_.sections("compiler")) {
    for (const char* folder : {"assetdir", "meshdir"}) {
      if (compiler->Attribute(folder) != nullptr) {
        mesh_folder_ = compiler->Attribute(folder);
      }
    }
    if (const char* from = compiler->Attribute("inertiafromgeom")) {
      from_geoms_ = from;
    }
  }
}

void MjcfInertia::read(const XMLElement& element, const std::string& childclass, Body& body) const {
  const XMLElement* inertial = element.FirstChildElement("inertial");
  const bool use_inertial = inertial != nullptr && from_geoms_ != "true";
  if (use_inertial) {
    read_inertial(*inertial, body);
  } else if (from_geoms_ != "false") {
    add_geoms(element, childclass, body);
  }
}

void MjcfInertia::read_inertial(const XMLElement& inertial, Body& body) const {
  const Eigen::Isometry3d X = pose(inertial, "");
  body.mass = number(inertial, "mass", "", 0.0);
  body.com = X.translation();
  Matrix3d I = Matrix3d::Zero();
  if (const char* full = inertial.Attribute("fullinertia")) {
    const std::vector<double> v = numbers(inertial, full, "fullinertia");
    if (v.size() != 6) {
      refuse(inertial, "fullinertia=\"" + std::string(full) + "\"", "six numbers: xx yy zz xy xz yz");
    }
    I << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  } else if (const char* diagonal = inertial.Attribute("diaginertia")) {
    I = vector(inertial, diagonal, "diaginertia").asDiagonal();
  }
  body.inertia = X.linear() * I * X.linear().transpose();
  if (body.mass < 0.0) {
    refuse(inertial, "a mass of " + number_text(body.mass) + " kg", "zero or more");
  }
  if (body.mass > 0.0) {
    const Vector3d principal = principal_moments(body.inertia);
    if (!(principal[0] >= 0.0) || principal[2] > (principal[0] + principal[1]) * (1.0 + 1e-6) + kNothing) {
      refuse(inertial,
             "principal moments " + number_text(principal[0], 6) + ", " + number_text(principal[1], 6) +
                 ", " + number_text(principal[2], 6) + " kg m^2",
             "moments above zero, none larger than the sum of the other two");
    }
  }
}

void MjcfInertia::add_geoms(const XMLElement& element, const std::string& childclass, Body& body) const {
  std::vector<RigidPart> parts;
  for (const XMLElement* geom = element.FirstChildElement("geom"); geom != nullptr;
       geom = geom->NextSiblingElement("geom")) {
    const char* type = defaults_.attribute(*geom, "type", childclass);
    const std::string kind = type == nullptr ? "sphere" : type;
    const char* mass = defaults_.attribute(*geom, "mass", childclass);
    if ((mass != nullptr && number(*geom, "mass", childclass, 0.0) == 0.0) ||
        number(*geom, "density", childclass, 1000.0) == 0.0) {
      continue;
    }
    if (kind == "hfield" || kind == "plane") {
      continue;
    }
    parts.push_back(kind == "mesh" ? read_mesh_geom(*geom, childclass) : read_geom(*geom, kind, childclass));
  }
  const RigidPart whole = together(parts);
  body.mass = whole.mass;
  body.com = whole.com;
  body.inertia = whole.inertia;
}

RigidPart MjcfInertia::read_geom(const XMLElement& geom, const std::string& kind,
                                 const std::string& childclass) const {
  auto [X, size] = shape_of(geom, childclass);
  if (defaults_.attribute(geom, "fromto", childclass) != nullptr && (kind == "box" || kind == "ellipsoid")) {
    size = {size[0], size[0], size[1]};
  }
  const std::optional<RigidPart> unit = solid(kind, size);
  if (!unit) {
    refuse(geom, "a geom of type " + kind + " with " + std::to_string(size.size()) + " sizes",
           "sphere, capsule, cylinder, box or ellipsoid with sizes above zero");
  }
  const double density = number(geom, "density", childclass, 1000.0);
  const double mass = number(geom, "mass", childclass, density * unit->mass);
  return placed(*unit, mass, X);
}

const XMLElement* MjcfInertia::mesh_asset(const std::string& name) const {
  for (const XMLElement* assets : source_.sections("asset")) {
    for (const XMLElement* one = assets->FirstChildElement("mesh"); one != nullptr;
         one = one->NextSiblingElement("mesh")) {
      const char* given = one->Attribute("name");
      const char* file = one->Attribute("file");
      const std::string stem = file == nullptr ? "" : std::filesystem::path(file).stem().string();
      if ((given != nullptr ? std::string(given) : stem) == name) {
        return one;
      }
    }
  }
  return nullptr;
}

/// What the mesh encloses. MuJoCo 2.2 by itself takes the sum of the volumes over all triangles, which is
/// more than that for a shape that is not convex (its `exactmeshinertia` takes what is enclosed).
RigidPart MjcfInertia::read_mesh_geom(const XMLElement& geom, const std::string& childclass) const {
  const char* name = defaults_.attribute(geom, "mesh", childclass);
  const XMLElement* asset = mesh_asset(name == nullptr ? "" : name);
  const char* file = asset == nullptr ? nullptr : asset->Attribute("file");
  if (file == nullptr) {
    refuse(geom, std::string("mesh \"") + (name == nullptr ? "" : name) + "\"",
           "the name of a <mesh> of <asset> with a file");
  }
  const char* scale = defaults_.attribute(*asset, "scale", "");
  const std::filesystem::path path =
      std::filesystem::path(source_.file()).parent_path() / mesh_folder_ / file;
  const mesh::MeshFile read =
      mesh::read_mesh(path.string(), scale == nullptr ? Vector3d::Ones() : vector(*asset, scale, "scale"));
  const std::string remedy = "<inertial> in the body, or mass=\"0\" for a shape without mass";
  if (!read.problem.empty()) {
    refuse(geom, "a mesh that has to give the inertia and cannot (" + read.problem + ")", remedy);
  }
  const mesh::SolidProperties of = mesh::solid_properties(read.mesh);
  if (!mesh::is_closed(read.mesh) || !(of.volume > 0.0)) {
    refuse(geom, "mesh \"" + std::string(name) + "\", which has to give the inertia and is not closed",
           remedy);
  }
  const RigidPart unit{of.volume, of.center, of.inertia};
  const double density = number(geom, "density", childclass, 1000.0);
  return placed(unit, number(geom, "mass", childclass, density * unit.mass), shape_of(geom, childclass).X);
}

}  // namespace plumbline::model
