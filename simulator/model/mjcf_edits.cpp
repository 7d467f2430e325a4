// MJCF files with values exchanged in place, and new ones of other skeletons.
#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>

#include "simulator/model/mjcf_document.h"
#include "simulator/model/skeleton_export.h"
#include "simulator/model/xml_text.h"
#include "simulator/trace/error.h"

namespace plumbline::model {
namespace {

/// xx yy zz xy xz yz
std::string full_inertia(const Eigen::Matrix3d& I) {
  return file_vector(I.diagonal()) + " " + file_vector({I(0, 1), I(0, 2), I(1, 2)});
}

std::string inertial_element(const Body& body) {
  return "<inertial pos=\"" + file_vector(body.com) + "\" mass=\"" + file_number(body.mass) +
         "\" fullinertia=\"" + full_inertia(body.inertia) + "\"/>";
}

/// Bodies and joints in the file's order, which is that of read_mjcf: each body element gives as many bodies
/// of the skeleton as it has joints, at least one, of which the last is its own.
class MjcfEditor {
 public:
  /// What the file includes is written into it.
  explicit MjcfEditor(const SkeletonEdit& edit)
      : edit_(edit), xml_(edit.before.file, MjcfDocument(edit.before.file).text()) {}

  std::string edited() {
    for (const XmlNode* world : xml_.root().all("worldbody")) {
      for (const XmlNode* body : world->all("body")) {
        put_body(*body);
      }
    }
    if (edit_.gravity) {
      put_gravity();
    }
    refuse_geoms_over_inertials();
    return xml_.edited();
  }

 private:
  void put_body(const XmlNode& node) {
    const std::vector<const XmlNode*> joints = node.all("joint");
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (edit_.joints[next_ + j]) {
        put_joint(*joints[j], next_ + j);
      }
    }
    next_ += std::max<std::size_t>(1, joints.size());
    if (edit_.bodies[next_ - 1]) {
      put_inertial(node, edit_.after.bodies[next_ - 1]);
    }
    for (const XmlNode* child : node.all("body")) {
      put_body(*child);
    }
  }

  /// Only what has changed: the rest may stand in a class.
  void put_joint(const XmlNode& node, std::size_t index) {
    const Joint& was = edit_.before.joints[index];
    const JointValues& is = edit_.after.joints[index];
    const auto put = [&](const char* name, double before, double after) {
      if (before != after) {
        xml_.set_attribute(node, name, file_number(after));
      }
    };
    put("damping", was.damping, is.damping);
    put("frictionloss", was.friction, is.friction);
    put("armature", was.armature, is.armature);
  }

  void put_inertial(const XmlNode& node, const Body& body) {
    inertials_ = true;
    const XmlNode* inertial = node.child("inertial");
    if (inertial == nullptr) {
      xml_.insert(node, {inertial_element(body)}, XmlText::Where::first);
      return;
    }
    for (const char* turn : {"quat", "axisangle", "euler", "xyaxes", "zaxis", "diaginertia"}) {
      xml_.remove_attribute(*inertial, turn);
    }
    xml_.set_attribute(*inertial, "pos", file_vector(body.com));
    xml_.set_attribute(*inertial, "mass", file_number(body.mass));
    xml_.set_attribute(*inertial, "fullinertia", full_inertia(body.inertia));
  }

  void put_gravity() {
    const std::string value = file_vector(edit_.after.gravity);
    if (const XmlNode* option = xml_.root().child("option")) {
      xml_.set_attribute(*option, "gravity", value);
    } else {
      xml_.insert(xml_.root(), {"<option gravity=\"" + value + "\"/>"}, XmlText::Where::first);
    }
  }

  void refuse_geoms_over_inertials() const {
    for (const XmlNode* compiler : xml_.root().all("compiler")) {
      if (inertials_ && xml_.value(*compiler, "inertiafromgeom") == "true") {
        throw InputError({edit_.before.file, 0, "compiler"},
                         "inertiafromgeom=\"true\", which overrides every <inertial>", "auto");
      }
    }
  }

  const SkeletonEdit& edit_;
  XmlText xml_;
  std::size_t next_ = 0;
  bool inertials_ = false;
};

class MjcfWriter {
 public:
  MjcfWriter(const Skeleton& skeleton, const SkeletonValues& values) : skeleton_(skeleton), values_(values) {}

  std::string text() {
    out_ << "<mujoco>\n  <compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n  <option gravity=\""
         << file_vector(values_.gravity) << "\"/>\n  <worldbody>\n";
    write_children(-1, Eigen::Isometry3d::Identity(), "    ");
    out_ << "  </worldbody>\n</mujoco>\n";
    return out_.str();
  }

 private:
  /// A joint and how its body's frame B stands to the one C of the body that is written.
  struct Held {
    std::size_t joint;
    Eigen::Isometry3d X_CB;
  };

  std::vector<std::size_t> children_of(int body) const {
    std::vector<std::size_t> list;
    for (std::size_t j = 0; j < skeleton_.joints.size(); ++j) {
      if (skeleton_.joints[j].parent == body) {
        list.push_back(j);
      }
    }
    return list;
  }

  /// At zero positions.
  static Eigen::Isometry3d pose_of(const Joint& joint) { return joint.X_PJ * joint.X_CJ.inverse(); }

  void write_children(int parent, const Eigen::Isometry3d& X_CP, const std::string& indent) {
    for (const std::size_t j : children_of(parent)) {
      write_body(j, X_CP, indent);
    }
  }

  /// MuJoCo wants mass on every body that moves: bodies without any that carry one body alone become further
  /// joints of that one.
  void write_body(std::size_t joint, const Eigen::Isometry3d& X_CP, const std::string& indent) {
    std::vector<Held> chain{{joint, Eigen::Isometry3d::Identity()}};
    Eigen::Isometry3d X = X_CP * pose_of(skeleton_.joints[joint]);
    while (true) {
      const int body = skeleton_.joints[chain.back().joint].child;
      const std::vector<std::size_t> next = children_of(body);
      const bool moves = skeleton_.joints[chain.back().joint].type != JointType::fixed;
      if (!moves || values_.bodies[static_cast<std::size_t>(body)].mass > 0.0 || next.size() != 1 ||
          skeleton_.joints[next.front()].type == JointType::fixed) {
        break;
      }
      const Eigen::Isometry3d step = pose_of(skeleton_.joints[next.front()]);
      X = X * step;
      for (Held& held : chain) {
        held.X_CB = step.inverse() * held.X_CB;
      }
      chain.push_back({next.front(), Eigen::Isometry3d::Identity()});
    }
    const int last = skeleton_.joints[chain.back().joint].child;
    const Body& body = values_.bodies[static_cast<std::size_t>(last)];
    const Eigen::Quaterniond q(X.linear());
    out_ << indent << "<body name=\"" << body.name << "\" pos=\"" << file_vector(X.translation())
         << "\" quat=\"" << file_number(q.w()) << " " << file_vector(q.vec()) << "\">\n";
    for (const Held& held : chain) {
      write_joint(held, indent + "  ");
    }
    if (body.mass > 0.0) {
      out_ << indent << "  " << inertial_element(body) << "\n";
    }
    write_children(last, Eigen::Isometry3d::Identity(), indent + "  ");
    out_ << indent << "</body>\n";
  }

  void write_joint(const Held& held, const std::string& indent) {
    const Joint& joint = skeleton_.joints[held.joint];
    if (joint.type == JointType::fixed) {
      return;
    }
    const Eigen::Isometry3d X_CJ = held.X_CB * joint.X_CJ;
    const JointValues& values = values_.joints[held.joint];
    out_ << indent << "<joint name=\"" << joint.name << "\" type=\""
         << (joint.type == JointType::revolute ? "hinge" : "slide") << "\" pos=\""
         << file_vector(X_CJ.translation()) << "\" axis=\""
         << file_vector(X_CJ.linear() * joint.axis.normalized()) << "\"";
    const auto add = [&](const char* name, double value) {
      if (value != 0.0) {
        out_ << " " << name << "=\"" << file_number(value) << "\"";
      }
    };
    add("damping", values.damping);
    add("frictionloss", values.friction);
    add("armature", values.armature);
    out_ << "/>\n";
  }

  const Skeleton& skeleton_;
  const SkeletonValues& values_;
  std::ostringstream out_;
};

}  // namespace

std::string edited_mjcf(const SkeletonEdit& edit) { return MjcfEditor(edit).edited(); }

std::string new_mjcf(const Skeleton& before, const SkeletonValues& after) {
  return MjcfWriter(before, after).text();
}

}  // namespace plumbline::model
