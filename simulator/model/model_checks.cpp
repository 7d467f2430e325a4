// Checks that need the whole model.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "simulator/model/kinds.h"
#include "simulator/model/model_sections.h"

namespace plumbline::model {
namespace {

/// The node of a named entry of a section, for its line.
YamlNode entry_of(const YamlNode& root, const std::string& section, const std::string& name) {
  return root.at(section).at(name);
}

bool is_that_joint(const Coordinate& coordinate) {
  return coordinate.terms.size() == 1 && coordinate.terms.front().of == coordinate.name &&
         coordinate.terms.front().factor == 1.0;
}

/// Joints, motors and pulleys side by side, each with its column in the ratios' linear system.
class Columns {
 public:
  explicit Columns(const Model& model) : names_(joint_names(model.skeleton)) {
    joints_ = names_.size();
    for (const Motor& motor : model.motors) {
      names_.push_back(motor.name);
    }
    const std::vector<std::string> pulleys = pulley_names(model);
    names_.insert(names_.end(), pulleys.begin(), pulleys.end());
  }
  Eigen::Index count() const { return static_cast<Eigen::Index>(names_.size()); }
  const std::string& name(Eigen::Index i) const { return names_[static_cast<std::size_t>(i)]; }
  Eigen::Index joint(const std::string& name) const { return index(name, 0, joints_); }
  /// Of a motor or pulley.
  Eigen::Index motor(const std::string& name) const { return index(name, joints_, names_.size()); }

 private:
  Eigen::Index index(const std::string& name, std::size_t first, std::size_t last) const {
    for (std::size_t i = first; i < last; ++i) {
      if (names_[i] == name) {
        return static_cast<Eigen::Index>(i);
      }
    }
    return -1;
  }
  std::vector<std::string> names_;
  std::size_t joints_ = 0;
};

/// position(motor) - sum ratio_i position(coordinate_i) = 0, scaled to a largest entry of one.
Eigen::RowVectorXd row_of(const Ratio& ratio, const Model& model, const Columns& columns) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(columns.count());
  const Eigen::Index motor = columns.motor(ratio.motor);
  row[motor >= 0 ? motor : columns.joint(ratio.motor)] = 1.0;
  for (const Term& to : ratio.to) {
    if (model.find_pulley(to.of) != nullptr) {
      row[columns.motor(to.of)] -= to.factor;
      continue;
    }
    for (const Term& term : model.find_coordinate(to.of)->terms) {
      const bool pulley = model.find_pulley(term.of) != nullptr;
      row[pulley ? columns.motor(term.of) : columns.joint(term.of)] -= to.factor * term.factor;
    }
  }
  const double largest = row.cwiseAbs().maxCoeff();
  return largest > 0.0 ? Eigen::RowVectorXd(row / largest) : row;
}

/// Reduced row echelon form with partial pivoting, one ratio at a time.
class Elimination {
 public:
  /// False when the row says nothing that the rows before did not say.
  bool add(Eigen::RowVectorXd row) {
    for (const Row& known : rows_) {
      row -= row[known.pivot] * known.values;
    }
    Eigen::Index pivot = 0;
    if (row.size() == 0 || !(row.cwiseAbs().maxCoeff(&pivot) > kTiny)) {
      return false;
    }
    row /= row[pivot];
    for (Row& known : rows_) {
      known.values -= known.values[pivot] * row;
    }
    rows_.push_back({row, pivot});
    return true;
  }

  /// A column that the equations hold at zero, or -1.
  Eigen::Index held_still() const {
    for (const Row& row : rows_) {
      if (row.values.cwiseAbs().sum() < 1.0 + kTiny) {
        return row.pivot;
      }
    }
    return -1;
  }

 private:
  static constexpr double kTiny = 1e-9;
  struct Row {
    Eigen::RowVectorXd values;
    Eigen::Index pivot;
  };
  std::vector<Row> rows_;
};

void check_every_motor_drives(const YamlNode& root, const Model& model) {
  for (const Motor& motor : model.motors) {
    const auto drives = [&](const Ratio& ratio) { return ratio.motor == motor.name; };
    if (std::none_of(model.ratios.begin(), model.ratios.end(), drives)) {
      entry_of(root, "motors", motor.name)
          .refuse("a motor that drives nothing", "a ratio that names this motor");
    }
  }
}

}  // namespace

void check_names(const YamlNode& root, const Model& model) {
  std::vector<std::string> joints;
  for (const Joint& joint : model.skeleton.joints) {
    joints.push_back(joint.name);
  }
  const auto names_joint = [&](const std::string& name) {
    return std::find(joints.begin(), joints.end(), name) != joints.end();
  };
  for (const Coordinate& coordinate : model.coordinates) {
    if (names_joint(coordinate.name) && !is_that_joint(coordinate)) {
      entry_of(root, "coordinates", coordinate.name)
          .refuse("the name of a joint",
                  "another name, or exactly this joint: {of: {" + coordinate.name + ": 1}}");
    }
  }
  for (const Ratio& ratio : model.ratios) {
    if (model.find_rod(ratio.name) != nullptr) {
      entry_of(root, "loops", ratio.name).refuse("the name of a ratio", "a name that only this rod has");
    }
  }
  for (const Motor& motor : model.motors) {
    if (names_joint(motor.name) || model.find_coordinate(motor.name) != nullptr) {
      entry_of(root, "motors", motor.name)
          .refuse("the name of a joint or coordinate", "a name that only this motor has");
    }
  }
  for (const Pulley& pulley : model.pulleys) {
    if (names_joint(pulley.name) || model.find_coordinate(pulley.name) != nullptr ||
        model.find_motor(pulley.name) != nullptr) {
      entry_of(root, "pulleys", pulley.name)
          .refuse("the name of a joint, coordinate or motor", "a name that only this pulley has");
    }
  }
}

void check_ratios(const YamlNode& root, const Model& model) {
  const Columns columns(model);
  Elimination system;
  for (const Ratio& ratio : model.ratios) {
    const YamlNode node = entry_of(root, "ratios", ratio.name);
    if (!system.add(row_of(ratio, model, columns))) {
      node.refuse("a ratio that follows from those before it (redundant)", "independent ratios");
    }
    const Eigen::Index still = system.held_still();
    if (still >= 0) {
      node.refuse(
          "ratios that contradict each other: " + quote(columns.name(still)) + " could only stand still",
          "ratios that leave every joint and motor free to move");
    }
  }
  check_every_motor_drives(root, model);
}

}  // namespace plumbline::model
