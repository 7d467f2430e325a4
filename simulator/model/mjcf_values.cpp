#include "simulator/model/mjcf_values.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

MjcfValues::MjcfValues(const MjcfDocument& document) : source_(document), defaults_(document) {
  for (const XMLElement* compiler : source_.sections("compiler")) {
    if (const char* angle = compiler->Attribute("angle")) {
      angle_ = std::string(angle) == "radian" ? 1.0 : kDegree;
    }
    if (const char* order = compiler->Attribute("eulerseq")) {
      euler_ = order;
    }
    const char* coordinate = compiler->Attribute("coordinate");
    if (coordinate != nullptr && std::string(coordinate) != "local") {
      refuse(*compiler, "global coordinates", "local ones");
    }
  }
}

void MjcfValues::refuse(const XMLElement& element, const std::string& found,
                        const std::string& expected) const {
  throw InputError(source_.place(element), found, expected);
}

std::vector<double> MjcfValues::numbers(const XMLElement& element, const char* text,
                                        const std::string& name) const {
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

Vector3d MjcfValues::vector(const XMLElement& element, const char* text, const std::string& name) const {
  const std::vector<double> values = numbers(element, text, name);
  if (values.size() != 3) {
    refuse(element, name + "=\"" + std::string(text) + "\"", "three numbers");
  }
  return {values[0], values[1], values[2]};
}

double MjcfValues::number(const XMLElement& element, const char* name, const std::string& childclass,
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

Eigen::Isometry3d MjcfValues::pose(const XMLElement& element, const std::string& childclass) const {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (const char* at = defaults_.attribute(element, "pos", childclass)) {
    X.translation() = vector(element, at, "pos");
  }
  X.linear() = orientation(element, childclass);
  return X;
}

Matrix3d MjcfValues::orientation(const XMLElement& element, const std::string& childclass) const {
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

Matrix3d MjcfValues::euler(const std::vector<double>& angles) const {
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

MjcfValues::Shape MjcfValues::shape_of(const XMLElement& geom, const std::string& childclass) const {
  Shape shape{pose(geom, childclass), {}};
  if (const char* given = defaults_.attribute(geom, "size", childclass)) {
    shape.size = numbers(geom, given, "size");
  }
  if (const char* ends = defaults_.attribute(geom, "fromto", childclass)) {
    const std::vector<double> p = numbers(geom, ends, "fromto");
    if (p.size() != 6) {
      refuse(geom, "fromto=\"" + std::string(ends) + "\"", "six numbers");
    }
    const Vector3d a(p[0], p[1], p[2]);
    const Vector3d b(p[3], p[4], p[5]);
    shape.X.translation() = 0.5 * (a + b);
    shape.X.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), b - a).toRotationMatrix();
    shape.size.resize(1);
    shape.size.push_back(0.5 * (b - a).norm());
  }
  return shape;
}

double MjcfValues::not_negative(const XMLElement& element, const char* name,
                                const std::string& childclass) const {
  const double value = number(element, name, childclass, 0.0);
  if (value < 0.0) {
    refuse(element, std::string(name) + " " + number_text(value), "zero or more");
  }
  return value;
}

}  // namespace plumbline::model
