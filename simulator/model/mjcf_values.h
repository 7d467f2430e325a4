// Numbers, poses and directions of MJCF elements, with their default classes and the file's units.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "simulator/model/mjcf_defaults.h"
#include "simulator/model/mjcf_document.h"

namespace plumbline::model {

/// Looks values up in an element, else in its default class; `childclass` is that of the bodies around. What
/// is no number, or not as many as it should be, throws InputError (file, line, element).
class MjcfValues {
 protected:
  using Matrix3d = Eigen::Matrix3d;
  using Vector3d = Eigen::Vector3d;
  using XMLElement = tinyxml2::XMLElement;
  static constexpr double kDegree = 0.017453292519943295;

  /// Of a document that lives as long; with what its <compiler> says of angles. Refuses global coordinates.
  explicit MjcfValues(const MjcfDocument& document);

  [[noreturn]] void refuse(const XMLElement& element, const std::string& found,
                           const std::string& expected) const;
  std::vector<double> numbers(const XMLElement& element, const char* text, const std::string& name) const;
  Vector3d vector(const XMLElement& element, const char* text, const std::string& name) const;
  double number(const XMLElement& element, const char* name, const std::string& childclass,
                double otherwise) const;
  /// Of a body, geom or inertial.
  Eigen::Isometry3d pose(const XMLElement& element, const std::string& childclass) const;
  Matrix3d orientation(const XMLElement& element, const std::string& childclass) const;
  /// Lower-case letters turn about the moving axes, upper-case ones about the fixed.
  Matrix3d euler(const std::vector<double>& angles) const;
  /// A geom's pose and sizes; of one between two points (`fromto`) the z axis lies along them, and the second
  /// size is half their distance.
  struct Shape {
    Eigen::Isometry3d X;
    std::vector<double> size;
  };
  Shape shape_of(const XMLElement& geom, const std::string& childclass) const;
  double not_negative(const XMLElement& element, const char* name, const std::string& childclass) const;

  const MjcfDocument& source_;
  MjcfDefaults defaults_;
  double angle_ = kDegree;  // rad for each unit of the file's angles
  std::string euler_ = "xyz";
};

}  // namespace plumbline::model
