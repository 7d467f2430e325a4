#include "simulator/model/mjcf_file.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

#include "simulator/model/mjcf_defaults.h"
#include "simulator/model/mjcf_shapes.h"
#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr double kDegree = 0.017453292519943295;
constexpr double kNothing = 1e-12;

class MjcfReader {
 public:
  explicit MjcfReader(const std::string& path) : file_(path) {
    const std::string text = read_text(path);
    if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      throw InputError({file_, document_.ErrorLineNum(), ""},
                       std::string("text that is no XML (") + document_.ErrorName() + ")",
                       "a whole MJCF file");
    }
    const XMLElement* root = document_.RootElement();
    if (root == nullptr || std::string(root->Name()) != "mujoco") {
      throw InputError({file_, 1, ""}, "no root element <mujoco>", "an MJCF file");
    }
    root_ = root;
  }

  Skeleton read() {
    read_settings();
    defaults_ = MjcfDefaults(*root_);
    skeleton_.file = file_;
    skeleton_.gravity = Vector3d(0.0, 0.0, -9.81);
    if (const XMLElement* option = root_->FirstChildElement("option")) {
      if (option->Attribute("gravity") != nullptr) {
        skeleton_.gravity = vector(*option, option->Attribute("gravity"), "gravity");
      }
    }
    const XMLElement* world = root_->FirstChildElement("worldbody");
    if (world == nullptr) {
      refuse(*root_, "no <worldbody>", "one that holds the bodies");
    }
    for (const XMLElement* body = world->FirstChildElement("body"); body != nullptr;
         body = body->NextSiblingElement("body")) {
      read_body(*body, -1, "");
    }
    if (skeleton_.bodies.empty()) {
      refuse(*world, "no <body>", "at least one");
    }
    refuse_massless();
    name_what_is_left_out();
    return std::move(skeleton_);
  }

 private:
  [[noreturn]] void refuse(const XMLElement& element, const std::string& found,
                           const std::string& expected) const {
    const char* name = element.Attribute("name");
    throw InputError({file_, element.GetLineNum(), name != nullptr ? name : element.Name()}, found, expected);
  }

  void refuse_includes(const XMLElement& element) const {
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (std::string(child->Name()) == "include") {
        refuse(*child, "an included file", "everything in one file (MuJoCo's compile writes one)");
      }
      refuse_includes(*child);
    }
  }

  void read_settings() {
    refuse_includes(*root_);
    for (const XMLElement* compiler = root_->FirstChildElement("compiler"); compiler != nullptr;
         compiler = compiler->NextSiblingElement("compiler")) {
      if (const char* angle = compiler->Attribute("angle")) {
        angle_ = std::string(angle) == "radian" ? 1.0 : kDegree;
      }
      if (const char* order = compiler->Attribute("eulerseq")) {
        euler_ = order;
      }
      if (const char* from = compiler->Attribute("inertiafromgeom")) {
        from_geoms_ = from;
      }
      if (const char* coordinate = compiler->Attribute("coordinate")) {
        if (std::string(coordinate) != "local") {
          refuse(*compiler, "global coordinates", "local ones");
        }
      }
    }
  }

  std::vector<double> numbers(const XMLElement& element, const char* text, const std::string& name) const {
    std::vector<double> values;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      const std::optional<double> value = parse_number(word);
      if (!value) {
        refuse(element, name + "=\"" + text + "\"", "numbers");
      }
      values.push_back(*value);
    }
    return values;
  }

  Vector3d vector(const XMLElement& element, const char* text, const std::string& name) const {
    const std::vector<double> values = numbers(element, text, name);
    if (values.size() != 3) {
      refuse(element, name + "=\"" + std::string(text) + "\"", "three numbers");
    }
    return {values[0], values[1], values[2]};
  }

  double number(const XMLElement& element, const char* name, const std::string& childclass,
                double otherwise) const {
    const char* text = defaults_.attribute(element, name, childclass);
    if (text == nullptr) {
      return otherwise;
    }
    const std::vector<double> values = numbers(element, text, name);
    if (values.empty()) {
      refuse(element, std::string(name) + "=\"\"", "a number");
    }
    return values.front();
  }

  /// Of a body, geom or inertial.
  Eigen::Isometry3d pose(const XMLElement& element, const std::string& childclass) const {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    if (const char* at = defaults_.attribute(element, "pos", childclass)) {
      X.translation() = vector(element, at, "pos");
    }
    X.linear() = orientation(element, childclass);
    return X;
  }

  Matrix3d orientation(const XMLElement& element, const std::string& childclass) const {
    const auto given = [&](const char* name) { return defaults_.attribute(element, name, childclass); };
    const auto take = [&](const char* name, std::size_t count) {
      const std::vector<double> values = numbers(element, given(name), name);
      if (values.size() != count) {
        refuse(element, std::string(name) + "=\"" + given(name) + "\"", std::to_string(count) + " numbers");
      }
      return values;
    };
    if (given("quat") != nullptr) {
      const std::vector<double> q = take("quat", 4);
      const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
      if (!(quaternion.norm() > 0.0)) {
        refuse(element, "a quaternion of zeros", "a rotation");
      }
      return quaternion.normalized().toRotationMatrix();
    }
    if (given("axisangle") != nullptr) {
      const std::vector<double> a = take("axisangle", 4);
      return Eigen::AngleAxisd(angle_ * a[3], Vector3d(a[0], a[1], a[2]).normalized()).toRotationMatrix();
    }
    if (given("euler") != nullptr) {
      return euler(take("euler", 3));
    }
    if (given("xyaxes") != nullptr) {
      const std::vector<double> a = take("xyaxes", 6);
      Matrix3d R;
      R.col(0) = Vector3d(a[0], a[1], a[2]).normalized();
      const Vector3d y(a[3], a[4], a[5]);
      R.col(1) = (y - y.dot(R.col(0)) * R.col(0)).normalized();
      R.col(2) = R.col(0).cross(R.col(1));
      return R;
    }
    if (given("zaxis") != nullptr) {
      const std::vector<double> a = take("zaxis", 3);
      return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d(a[0], a[1], a[2]))
          .toRotationMatrix();
    }
    return Matrix3d::Identity();
  }

  /// Lower-case letters turn about the moving axes, upper-case ones about the fixed.
  Matrix3d euler(const std::vector<double>& angles) const {
    Matrix3d R = Matrix3d::Identity();
    for (std::size_t i = 0; i < 3 && i < euler_.size(); ++i) {
      const char c = euler_[i];
      const bool moving = c >= 'x';
      const int axis = moving ? c - 'x' : c - 'X';
      const Matrix3d turn =
          Eigen::AngleAxisd(angle_ * angles[i], Vector3d::Unit(std::clamp(axis, 0, 2))).toRotationMatrix();
      R = moving ? Matrix3d(R * turn) : Matrix3d(turn * R);
    }
    return R;
  }

  std::string fresh_name(const XMLElement& element, const std::string& fallback) {
    const char* given = element.Attribute("name");
    std::string name = given != nullptr ? given : fallback;
    if (given != nullptr && names_.count(name) != 0) {
      refuse(element, "this name twice", "each name once");
    }
    for (int i = 2; !names_.insert(name).second; ++i) {
      name = fallback + "_" + std::to_string(i);
    }
    return name;
  }

  void read_body(const XMLElement& element, int parent, std::string childclass) {
    if (const char* own = element.Attribute("childclass")) {
      childclass = own;
      if (!defaults_.has_class(childclass)) {
        refuse(element, "childclass \"" + childclass + "\"", "the name of a default class");
      }
    }
    Body body;
    body.name = fresh_name(element, "body_" + std::to_string(skeleton_.bodies.size() + 1));
    read_inertia(element, childclass, body);
    const Eigen::Isometry3d X_PB = pose(element, childclass);
    if (const XMLElement* free = element.FirstChildElement("freejoint")) {
      refuse(*free, "a free joint", "joints of type hinge and slide (floating bases are not supported yet)");
    }
    std::vector<const XMLElement*> joints;
    for (const XMLElement* joint = element.FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      joints.push_back(joint);
    }
    if (joints.empty()) {
      Joint joint;
      joint.name = "fix_" + body.name;
      joint.parent = parent;
      joint.X_PJ = X_PB;
      append(body, std::move(joint));
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      Joint joint = read_joint(*joints[j], childclass, body.name);
      const Vector3d at = position_of(*joints[j], childclass);
      const Eigen::Isometry3d X_BJ(Eigen::Translation3d(at.x(), at.y(), at.z()));
      joint.parent = j == 0 ? parent : static_cast<int>(skeleton_.bodies.size()) - 1;
      joint.X_PJ = (j == 0 ? X_PB : Eigen::Isometry3d::Identity()) * X_BJ;
      joint.X_CJ = X_BJ;
      if (j + 1 < joints.size()) {
        Body between;
        between.name = body.name + "_of_" + joint.name;
        append(between, std::move(joint));
      } else {
        append(body, std::move(joint));
      }
    }
    const int self = static_cast<int>(skeleton_.bodies.size()) - 1;
    for (const XMLElement* child = element.FirstChildElement("body"); child != nullptr;
         child = child->NextSiblingElement("body")) {
      read_body(*child, self, childclass);
    }
  }

  void append(const Body& body, Joint joint) {
    joint.child = static_cast<int>(skeleton_.bodies.size());
    skeleton_.bodies.push_back(body);
    skeleton_.joints.push_back(std::move(joint));
  }

  Vector3d position_of(const XMLElement& joint, const std::string& childclass) const {
    const char* at = defaults_.attribute(joint, "pos", childclass);
    return at == nullptr ? Vector3d::Zero() : vector(joint, at, "pos");
  }

  Joint read_joint(const XMLElement& element, const std::string& childclass, const std::string& body) {
    const char* type = defaults_.attribute(element, "type", childclass);
    const std::string kind = type == nullptr ? "hinge" : type;
    if (kind != "hinge" && kind != "slide") {
      refuse(element, "a joint of type " + kind, "hinge or slide");
    }
    Joint joint;
    joint.name = fresh_name(element, body + "_joint");
    joint.type = kind == "hinge" ? JointType::revolute : JointType::prismatic;
    const char* axis = defaults_.attribute(element, "axis", childclass);
    joint.axis = axis == nullptr ? Vector3d::UnitZ() : vector(element, axis, "axis");
    if (!(joint.axis.norm() > 0.0)) {
      refuse(element, "an axis of zeros", "the direction of the joint");
    }
    joint.axis.normalize();
    joint.damping = not_negative(element, "damping", childclass);
    joint.friction = not_negative(element, "frictionloss", childclass);
    joint.armature = not_negative(element, "armature", childclass);
    if (number(element, "stiffness", childclass, 0.0) != 0.0) {
      skeleton_.left_out.push_back("The spring of joint " + joint.name +
                                   " (stiffness, springref): state it as the effect `spring`.");
    }
    if (number(element, "ref", childclass, 0.0) != 0.0) {
      refuse(element, "ref, another zero of the joint",
             "0: the zero of the file's pose; sensors have an `offset`");
    }
    limits_ += defaults_.attribute(element, "range", childclass) != nullptr ? 1 : 0;
    return joint;
  }

  double not_negative(const XMLElement& element, const char* name, const std::string& childclass) const {
    const double value = number(element, name, childclass, 0.0);
    if (value < 0.0) {
      refuse(element, std::string(name) + " " + number_text(value), "zero or more");
    }
    return value;
  }

  void read_inertia(const XMLElement& element, const std::string& childclass, Body& body) {
    const XMLElement* inertial = element.FirstChildElement("inertial");
    const bool use_inertial = inertial != nullptr && from_geoms_ != "true";
    if (use_inertial) {
      read_inertial(*inertial, body);
    } else if (from_geoms_ != "false") {
      add_geoms(element, childclass, body);
    }
  }

  void read_inertial(const XMLElement& inertial, Body& body) const {
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
      const Vector3d principal =
          Eigen::SelfAdjointEigenSolver<Matrix3d>(body.inertia, Eigen::EigenvaluesOnly).eigenvalues();
      if (!(principal[0] >= 0.0) || principal[2] > (principal[0] + principal[1]) * (1.0 + 1e-6) + kNothing) {
        refuse(inertial,
               "principal moments " + number_text(principal[0], 6) + ", " + number_text(principal[1], 6) +
                   ", " + number_text(principal[2], 6) + " kg m^2",
               "moments above zero, none larger than the sum of the other two");
      }
    }
  }

  void add_geoms(const XMLElement& element, const std::string& childclass, Body& body) {
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
      if (kind == "mesh" || kind == "hfield" || kind == "plane") {
        if (kind == "mesh") {
          refuse(
              *geom, "a mesh that has to give the inertia of body " + body.name,
              "<inertial> in the body (MuJoCo's compile writes it), or mass=\"0\" for a shape without mass");
        }
        continue;
      }
      parts.push_back(read_geom(*geom, kind, childclass));
    }
    const RigidPart whole = together(parts);
    body.mass = whole.mass;
    body.com = whole.com;
    body.inertia = whole.inertia;
  }

  RigidPart read_geom(const XMLElement& geom, const std::string& kind, const std::string& childclass) const {
    Eigen::Isometry3d X = pose(geom, childclass);
    std::vector<double> size;
    if (const char* given = defaults_.attribute(geom, "size", childclass)) {
      size = numbers(geom, given, "size");
    }
    if (const char* ends = defaults_.attribute(geom, "fromto", childclass)) {
      const std::vector<double> p = numbers(geom, ends, "fromto");
      if (p.size() != 6) {
        refuse(geom, "fromto=\"" + std::string(ends) + "\"", "six numbers");
      }
      const Vector3d a(p[0], p[1], p[2]);
      const Vector3d b(p[3], p[4], p[5]);
      X.translation() = 0.5 * (a + b);
      X.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), b - a).toRotationMatrix();
      size.resize(1);
      size.push_back(0.5 * (b - a).norm());
      if (kind == "box" || kind == "ellipsoid") {
        size = {size[0], size[0], size[1]};
      }
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

  /// A joint that moves must move mass.
  void refuse_massless() const {
    std::vector<double> carried(skeleton_.bodies.size());
    for (std::size_t i = skeleton_.bodies.size(); i-- > 0;) {
      carried[i] += skeleton_.bodies[i].mass;
      const Joint& joint = skeleton_.joints[i];
      if (joint.parent >= 0) {
        carried[static_cast<std::size_t>(joint.parent)] += carried[i];
      }
      if (joint.type != JointType::fixed && !(carried[i] > 0.0)) {
        throw InputError({file_, 0, skeleton_.bodies[i].name}, "no mass of a body that moves",
                         "<inertial>, or geoms with a density");
      }
    }
  }

  void name_what_is_left_out() {
    struct Part {
      const char *name, *advice;
    };
    const std::array<Part, 6> parts{{{"actuator", "state them as `motors` of the model file"},
                                     {"tendon", ""},
                                     {"equality", ""},
                                     {"contact", ""},
                                     {"sensor", "state them as `sensors` of the model file"},
                                     {"keyframe", ""}}};
    for (const Part& part : parts) {
      const XMLElement* section = root_->FirstChildElement(part.name);
      if (section != nullptr && section->FirstChildElement() != nullptr) {
        int count = 0;
        for (const XMLElement* one = section->FirstChildElement(); one != nullptr;
             one = one->NextSiblingElement()) {
          ++count;
        }
        skeleton_.left_out.push_back("<" + std::string(part.name) + "> with " + std::to_string(count) +
                                     (count == 1 ? " element" : " elements") +
                                     (*part.advice != '\0' ? std::string(": ") + part.advice : "") + ".");
      }
    }
    if (limits_ > 0) {
      skeleton_.left_out.push_back("The ranges of " + std::to_string(limits_) +
                                   " joints: state a stop as the effect `hard_stop`.");
    }
  }

  std::string file_;
  tinyxml2::XMLDocument document_;
  const XMLElement* root_ = nullptr;
  MjcfDefaults defaults_;
  double angle_ = kDegree;  // rad for each unit of the file's angles
  std::string euler_ = "xyz";
  std::string from_geoms_ = "auto";
  std::set<std::string> names_;
  int limits_ = 0;
  Skeleton skeleton_;
};

}  // namespace

Skeleton read_mjcf(const std::string& path) { return MjcfReader(path).read(); }

bool is_mjcf(const std::string& path) {
  tinyxml2::XMLDocument document;
  const std::string text = read_text(path);
  return document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS &&
         document.RootElement() != nullptr && std::string(document.RootElement()->Name()) == "mujoco";
}

}  // namespace plumbline::model
