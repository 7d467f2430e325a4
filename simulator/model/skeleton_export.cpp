#include "simulator/model/skeleton_export.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "simulator/model/kinds.h"
#include "simulator/model/mjcf_file.h"
#include "simulator/model/rigid_part.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/skeleton_xml.h"
#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/table.h"

namespace plumbline::model {
namespace {

constexpr int kFileDigits = 12;
constexpr double kSame = 1e-12;     // of the largest: no other value
constexpr double kReadBack = 1e-9;  // of the largest: digits of the file and their way through its frames

bool differ(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double share) {
  return (a - b).cwiseAbs().maxCoeff() > share * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}

bool differ(double a, double b, double share) {
  return std::abs(a - b) > share * std::max(std::abs(a), std::abs(b));
}

bool differ(const Body& a, const Body& b, double share) {
  return differ(a.mass, b.mass, share) || differ(a.com, b.com, share) || differ(a.inertia, b.inertia, share);
}

std::string moments(const Eigen::Matrix3d& I) {
  return number_text(I(0, 0), 4) + " " + number_text(I(1, 1), 4) + " " + number_text(I(2, 2), 4);
}

std::string short_vector(const Eigen::Vector3d& v) {
  return number_text(v.x(), 4) + " " + number_text(v.y(), 4) + " " + number_text(v.z(), 4);
}

enum class Format { urdf, sdf, mjcf };

std::string name_of(Format format) {
  return format == Format::urdf ? "URDF" : format == Format::sdf ? "SDFormat" : "MJCF";
}

Format format_of(const std::string& skeleton) {
  return is_mjcf(skeleton) ? Format::mjcf : SkeletonXml(skeleton).is_urdf() ? Format::urdf : Format::sdf;
}

Format wished_format(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".urdf") {
    return Format::urdf;
  }
  if (extension == ".sdf") {
    return Format::sdf;
  }
  if (extension == ".xml") {
    return Format::mjcf;
  }
  throw InputError({path, 0, ""}, "a file name that ends in \"" + extension + "\"",
                   "one that ends in .urdf, .sdf or .xml (MJCF)");
}

/// Compares joint by joint and body by body, and says what is new.
void find_changes(SkeletonEdit& edit, bool armature, bool says_gravity, SkeletonExport& made) {
  const auto add = [&](const std::string& of, const char* what, const std::string& before,
                       const std::string& after, const std::string& unit) {
    made.changed.push_back({of, what, before, after, unit});
  };
  for (std::size_t b = 0; b < edit.before.bodies.size(); ++b) {
    const Body& was = edit.before.bodies[b];
    const Body& is = edit.after.bodies[b];
    edit.bodies.push_back(differ(was, is, kSame));
    if (differ(was.mass, is.mass, kSame)) {
      add(is.name, "mass", number_text(was.mass, 6), number_text(is.mass, 6), "kg");
    }
    if (differ(was.com, is.com, kSame)) {
      add(is.name, "centre of mass", short_vector(was.com), short_vector(is.com), "m");
    }
    if (differ(was.inertia, is.inertia, kSame)) {
      add(is.name, "moments of inertia", moments(was.inertia), moments(is.inertia), "kg m^2");
    }
  }
  for (std::size_t j = 0; j < edit.before.joints.size(); ++j) {
    const Joint& was = edit.before.joints[j];
    const JointValues& is = edit.after.joints[j];
    const bool angular = was.type == JointType::revolute;
    const std::size_t count = made.changed.size();
    const auto compare = [&](const char* what, double before, double after, const std::string& unit) {
      if (differ(before, after, kSame)) {
        add(was.name, what, number_text(before, 6), number_text(after, 6), unit);
      }
    };
    compare("damping", was.damping, is.damping, force_unit(angular) + " s/" + position_unit(angular));
    compare("friction", was.friction, is.friction, force_unit(angular));
    if (armature) {
      compare("armature", was.armature, is.armature, inertia_unit(angular));
    } else if (is.armature != 0.0) {
      made.left_out.push_back("Joint " + was.name + ": its armature of " + number_text(is.armature, 6) + " " +
                              inertia_unit(angular) + " (rotors and pulleys through their ratios).");
    }
    edit.joints.push_back(made.changed.size() > count);
  }
  if (!differ(edit.before.gravity, edit.after.gravity, kSame)) {
    return;
  }
  edit.gravity = says_gravity;
  if (!says_gravity) {
    made.left_out.push_back("Gravity of " + short_vector(edit.after.gravity) +
                            " m/s^2: the file has no world.");
  } else {
    add("world", "gravity", short_vector(edit.before.gravity), short_vector(edit.after.gravity), "m/s^2");
  }
}

/// A point mass on a link without mass is no rigid body for any reader of these formats.
void refuse_impossible(const Model& model, const SkeletonEdit& edit) {
  for (std::size_t b = 0; b < edit.bodies.size(); ++b) {
    const Body& body = edit.after.bodies[b];
    const Eigen::Vector3d principal = principal_moments(body.inertia);
    if (edit.bodies[b] && !(principal[0] > 0.0)) {
      throw InputError({model.file, 0, body.name},
                       "a principal moment of " + number_text(principal[0], 6) + " kg m^2",
                       "moments above zero, which readers of the format ask for");
    }
  }
}

/// A simulator that reads the file must find what the model says.
void check_read_back(const std::string& file, const Skeleton& before, const SkeletonValues& values,
                     bool armature) {
  const Skeleton read = read_skeleton(file);
  for (const Body& wanted : values.bodies) {
    const auto found = std::find_if(read.bodies.begin(), read.bodies.end(),
                                    [&](const Body& one) { return one.name == wanted.name; });
    if (wanted.mass > 0.0 && (found == read.bodies.end() || differ(*found, wanted, kReadBack))) {
      throw std::logic_error("the written skeleton has other values at body " + wanted.name);
    }
  }
  for (std::size_t j = 0; j < values.joints.size(); ++j) {
    const JointValues& wanted = values.joints[j];
    const Joint* found = find_joint(read, before.joints[j].name);
    if (before.joints[j].type != JointType::fixed &&
        (found == nullptr || differ(found->damping, wanted.damping, kReadBack) ||
         differ(found->friction, wanted.friction, kReadBack) ||
         (armature && differ(found->armature, wanted.armature, kReadBack)))) {
      throw std::logic_error("the written skeleton has other values at joint " + before.joints[j].name);
    }
  }
}

}  // namespace

std::string file_number(double value) { return number_text(value == 0.0 ? 0.0 : value, kFileDigits); }

std::string file_vector(const Eigen::Vector3d& v) {
  return file_number(v.x()) + " " + file_number(v.y()) + " " + file_number(v.z());
}

SkeletonExport export_skeleton(const Model& model, const std::string& path) {
  const std::string& source = model.skeleton.file;
  const Format from = format_of(source);
  const Format to = wished_format(path);
  if (from != to && to != Format::mjcf) {
    throw InputError({path, 0, ""}, name_of(to) + " wished of a skeleton in " + name_of(from) + ", " + source,
                     "the skeleton's own format, or .xml (MJCF)");
  }
  const Skeleton before = read_skeleton(source);
  const SkeletonValues after = skeleton_values(model);
  SkeletonEdit edit{before, after, {}, {}, false};
  SkeletonExport made;
  made.source = source;
  made.format = name_of(to);
  made.left_out = after.left_out;
  find_changes(edit, to == Format::mjcf, to == Format::mjcf || SkeletonXml(source).states_gravity(), made);
  refuse_impossible(model, edit);
  std::string text;
  if (from != to) {
    text = new_mjcf(before, after);
    made.left_out.push_back("Shapes, meshes and limits of " + source +
                            ": the MJCF has bodies and joints only.");
  } else {
    text = to == Format::urdf ? edited_urdf(edit) : to == Format::sdf ? edited_sdf(edit) : edited_mjcf(edit);
  }
  replace_file(path, [&](const std::string& temporary) {
    write_text_atomically(temporary, text);
    check_read_back(temporary, before, after, to == Format::mjcf);
  });
  return made;
}

}  // namespace plumbline::model
