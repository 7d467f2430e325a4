// Mass, centre and inertia of an MJCF body: as it states them, or of its geoms.
#pragma once

#include <string>

#include "simulator/model/mjcf_values.h"
#include "simulator/model/model.h"
#include "simulator/model/rigid_part.h"

namespace plumbline::model {

/// `inertial`, else (or always, by the compiler's inertiafromgeom) the geoms with their mass or density:
/// sphere, capsule, cylinder, box, ellipsoid, and meshes that are closed. Throws InputError (file, line,
/// element) for numbers that no rigid body has, and for meshes that are not there or open.
class MjcfInertia : private MjcfValues {
 public:
  explicit MjcfInertia(const MjcfDocument& document);

  void read(const XMLElement& body_element, const std::string& childclass, Body& body) const;

 private:
  void read_inertial(const XMLElement& inertial, Body& body) const;
  void add_geoms(const XMLElement& element, const std::string& childclass, Body& body) const;
  RigidPart read_geom(const XMLElement& geom, const std::string& kind, const std::string& childclass) const;
  RigidPart read_mesh_geom(const XMLElement& geom, const std::string& childclass) const;
  const XMLElement* mesh_asset(const std::string& name) const;

  std::string mesh_folder_;
  std::string from_geoms_ = "auto";
};

}  // namespace plumbline::model
