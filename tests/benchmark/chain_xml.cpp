#include "tests/benchmark/chain_xml.h"

#include <sstream>
#include <stdexcept>

#include "contact/contact_law.h"

namespace plumbline::benchmarks {
namespace {

struct Point {
  const Eigen::Vector3d& of;
};

std::ostream& operator<<(std::ostream& text, const Point& point) {
  return text << '\'' << point.of.x() << ' ' << point.of.y() << ' ' << point.of.z() << '\'';
}

bool on_ground(const model::EffectUse& use) {
  return dynamic_cast<const contact::NormalLaw*>(use.law.get()) != nullptr ||
         dynamic_cast<const contact::TangentialLaw*>(use.law.get()) != nullptr;
}

/// Name of the joint whose position the coordinate is.
std::string joint_of(const model::Model& model, const std::string& coordinate) {
  const model::Coordinate* found = model.find_coordinate(coordinate);
  if (found == nullptr || found->terms.size() != 1 || found->terms[0].factor != 1.0) {
    throw std::runtime_error(coordinate + ": expected a coordinate that is one joint's position");
  }
  return found->terms[0].of;
}

/// Attributes of a joint for the effects at it.
void write_effects(std::ostream& text, const model::Model& model, const std::string& joint) {
  for (const model::EffectUse& use : model.effects) {
    if (on_ground(use) || joint_of(model, use.at) != joint) {
      continue;
    }
    const effects::Values values = use.numbers();
    const std::string& name = use.law->declaration().name;
    if (name == "spring") {
      text << " stiffness='" << values[0] << "' springref='" << values[1] << '\'';
    } else if (name == "viscous") {
      text << " damping='" << values[0] << '\'';
    } else {
      throw std::runtime_error(use.label() + ": not in MuJoCo's joints");
    }
  }
}

void write_joint(std::ostream& text, const model::Model& model, const model::Joint& joint) {
  text << "<joint name='" << joint.name << "' type='"
       << (joint.type == model::JointType::prismatic ? "slide" : "hinge") << "' axis=" << Point{joint.axis}
       << " pos=" << Point{joint.X_CJ.translation()};
  write_effects(text, model, joint.name);
  text << "/>";
}

void write_inertia(std::ostream& text, const model::Body& body) {
  text << "<inertial pos=" << Point{body.com} << " mass='" << body.mass
       << "' diaginertia=" << Point{body.inertia.diagonal()} << "/>";
}

void check(const model::Model& model, std::size_t link) {
  const model::Joint& joint = model.skeleton.joints[link];
  const bool turned = !joint.X_PJ.linear().isIdentity(0.0) || !joint.X_CJ.linear().isIdentity(0.0);
  const model::Body& body = model.skeleton.bodies[link];
  const bool diagonal = body.inertia.isDiagonal();
  const bool bare = !(body.mass > 0.0) && joint.type != model::JointType::prismatic;
  if (joint.parent != static_cast<int>(link) - 1 || joint.child != static_cast<int>(link) || turned ||
      joint.type == model::JointType::fixed || !diagonal || bare) {
    throw std::runtime_error(joint.name + ": expected a chain with parallel frames");
  }
}

/// A link without mass is none to MuJoCo: its joint goes to the next link.
int write_links(std::ostream& text, const model::Model& model) {
  const model::Skeleton& skeleton = model.skeleton;
  std::ostringstream joints;
  joints.precision(text.precision());
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  int open = 0;
  for (std::size_t i = 0; i < skeleton.bodies.size(); ++i) {
    check(model, i);
    const model::Joint& joint = skeleton.joints[i];
    place += joint.X_PJ.translation() - joint.X_CJ.translation();
    write_joint(joints, model, joint);
    if (skeleton.bodies[i].mass > 0.0) {
      text << "<body name='" << skeleton.bodies[i].name << "' pos=" << Point{place} << '>' << joints.str();
      write_inertia(text, skeleton.bodies[i]);
      joints.str("");
      place.setZero();
      ++open;
    }
  }
  return open;
}

}  // namespace

std::string chain_xml(const model::Model& model) {
  if (model.feet.size() != 1 || model.feet[0].body + 1 != static_cast<int>(model.skeleton.bodies.size()) ||
      !model.motors.empty()) {
    throw std::runtime_error(model.file + ": expected one foot, on the last link, and no motor");
  }
  std::ostringstream text;
  text.precision(17);
  text << "<mujoco><compiler angle='radian' balanceinertia='false' boundmass='0' inertiafromgeom='false'/>"
       << "<option gravity=" << Point{model.skeleton.gravity}
       << "><flag contact='disable' constraint='disable' sensor='disable'/></option><worldbody>";
  const int open = write_links(text, model);
  text << "<site name='foot' pos=" << Point{model.feet[0].point} << "/>";
  for (int i = 0; i < open; ++i) text << "</body>";
  text << "</worldbody><actuator><general name='bristle' joint='" << model.skeleton.joints[0].name
       << "' dyntype='user' gainprm='0'/></actuator></mujoco>";
  return text.str();
}

}  // namespace plumbline::benchmarks
