// A first look at a skeleton's XML, for what libsdformat would report without a line, silently drop or
// invent.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "simulator/model/rigid_part.h"
#include "simulator/trace/error.h"

namespace plumbline::model {

/// A link or joint as it stands in the file.
struct XmlPart {
  std::string name;
  int line = 0;
};

/// Joints of several degrees of freedom that libsdformat does not know in a URDF.
enum class UrdfJoint { single, floating, planar };

/// Whether the shapes of a URDF's links are kept for libsdformat.
enum class UrdfShapes { left_out, kept };

/// Reads an .sdf or .urdf and checks its parts: one model and nothing nested, known joint types, each name
/// once, numbers of every inertial (mass > 0; in SDFormat principal moments > 0, none larger than the sum of
/// the other two, which URDF does not ask for: unusual()). A URDF whose joints hang on a link "world" that it
/// does not state, as Drake reads it, gets that link. Throws InputError with file, line, link or joint.
class SkeletonXml {
 public:
  explicit SkeletonXml(const std::string& path);

  const std::string& file() const { return file_; }
  bool is_urdf() const { return urdf_; }
  /// True when the world states its own gravity.
  bool states_gravity() const { return states_gravity_; }
  bool has_inertial(const std::string& link) const { return links_with_inertial_.count(link) != 0; }
  /// What a URDF states of a link whose inertia about its centre no single body has, in the link's axes;
  /// nullptr: it is a body's. Public files have such links as frames and sensors, and on what moves, too.
  const RigidPart* unusual(const std::string& link) const;
  int line_of_link(const std::string& name) const;
  int line_of_joint(const std::string& name) const;
  /// What a URDF says of a joint; a planar one's normal is in `normal`, in the joint's frame.
  UrdfJoint urdf_joint(const std::string& name) const;
  Eigen::Vector3d planar_normal(const std::string& name) const;
  /// URDF's <mimic> of a joint: its position is multiplier * position of `joint` + offset; nullptr: none.
  struct Mimic {
    std::string joint;
    double multiplier = 1.0, offset = 0.0;
  };
  const Mimic* mimic(const std::string& name) const;
  /// The part that a message of libsdformat speaks of; an empty name when it names none.
  XmlPart part_in(const std::string& message) const;

  /// Has an SDFormat file links with an inertial of no mass, which libsdformat refuses? Then it is read from
  /// text() instead of the file.
  bool has_massless() const { return massless_; }
  std::string text() const;

  /// A URDF such that libsdformat keeps every link: fixed joints are kept, floating and planar joints become
  /// fixed ones (which urdf_joint() tells from real ones), massless and unusual() links get a placeholder
  /// inertial (which has_inertial() and unusual() tell from a real one), extensions are left out, and shapes
  /// where the physics is read.
  std::string urdf_for_sdformat(UrdfShapes shapes);

  /// The file's own name of a joint that libsdformat has read: one that is called as a link goes by another
  /// there.
  std::string joint_name(const std::string& read) const;

  [[noreturn]] void refuse(const XmlPart& part, const std::string& found, const std::string& expected) const;

 private:
  const tinyxml2::XMLElement& find_model();
  void state_world();
  bool has_link(const std::string& name) const;
  void check_links(const tinyxml2::XMLElement& model);
  void check_joints(const tinyxml2::XMLElement& model);
  void check_joint(const tinyxml2::XMLElement& joint, const XmlPart& part) const;
  void check_urdf_joint(const tinyxml2::XMLElement& joint, const XmlPart& part) const;
  bool is_massless(const tinyxml2::XMLElement& inertial, const XmlPart& link) const;
  void check_inertial(const tinyxml2::XMLElement& inertial, const XmlPart& link);
  RigidPart urdf_part(const tinyxml2::XMLElement& inertial, const Eigen::Matrix3d& inertia, double mass,
                      const XmlPart& link) const;
  Eigen::Vector3d triple(const tinyxml2::XMLElement& element, const char* name, const XmlPart& link) const;
  double number(const tinyxml2::XMLElement& parent, const char* name, const XmlPart& part) const;
  XmlPart named(const tinyxml2::XMLElement& element, const std::vector<XmlPart>& taken) const;
  void keep_fixed_joints(tinyxml2::XMLElement& robot);
  void note_urdf_joint(const tinyxml2::XMLElement& joint, const XmlPart& part);

  std::string file_;
  tinyxml2::XMLDocument document_;
  bool urdf_ = false;
  bool states_gravity_ = false;
  bool massless_ = false;
  std::vector<XmlPart> links_, joints_;
  std::set<std::string> links_with_inertial_;
  std::map<std::string, RigidPart> unusual_;
  std::set<std::string> floating_;
  std::map<std::string, std::string> renamed_;     ///< joints called as a link: the file's names
  std::map<std::string, Eigen::Vector3d> planar_;  ///< with their normals
  std::map<std::string, Mimic> mimics_;
};

}  // namespace plumbline::model
