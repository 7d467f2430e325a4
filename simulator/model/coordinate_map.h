// Which coordinates of a model are independent, and how all others follow them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/plant_slots.h"

namespace plumbline::model {

/// Full coordinates (joints that move, motors, pulleys: in this order) by the independent ones that rigid
/// ratios and locks leave, q = S z + q0. A ratio is rigid where no effect at it has values that are not null.
class CoordinateMap {
 public:
  /// `values` are those of the model's effects. The model has to outlive the map. Throws InputError when
  /// constraints contradict each other or leave nothing to move.
  CoordinateMap(const Model& model, const std::vector<effects::Values>& values,
                const std::vector<Lock>& locks);

  int tree() const { return n_tree_; }     ///< joints that move: the first of the full coordinates
  int full() const { return n_; }          ///< all
  int independent() const { return nz_; }  ///< z
  const Eigen::MatrixXd& S() const { return S_; }
  const Eigen::MatrixXd& S_tree() const { return S_tree_; }  ///< its rows of the joints that move
  /// What is not zero in a row of S_tree().
  const std::vector<LinearForm::Entry>& row(int joint) const {
    return rows_[static_cast<std::size_t>(joint)];
  }
  const Eigen::VectorXd& q0() const { return q0_; }
  /// Rows that are zero when no released ratio is stretched.
  const Eigen::MatrixXd& stretch_map() const { return stretch_map_; }

  /// Of a joint, coordinate, motor or pulley over the full coordinates. Throws InputError.
  Eigen::VectorXd full_direction(const std::string& name) const;
  /// Of what stretches where the ratio is released.
  Eigen::VectorXd stretch_direction(const Ratio& ratio) const;
  LinearForm line_of(const Eigen::VectorXd& full) const;
  /// Does an effect let this ratio, or this rod of a loop, stretch?
  bool is_released(const std::string& name) const;
  /// Of a joint, motor or pulley.
  std::string name_of(int full) const;
  /// Of one of the independent ones.
  std::string name_of_independent(int z) const { return name_of(independent_[static_cast<std::size_t>(z)]); }

 private:
  void reduce(const std::vector<Lock>& locks);
  void find_stretch_map();
  int motors() const { return static_cast<int>(model_.motors.size()); }

  const Model& model_;
  std::vector<std::string> released_;
  std::vector<int> independent_;  // full coordinates that z are
  int n_tree_ = 0, n_ = 0, nz_ = 0;
  Eigen::MatrixXd S_, S_tree_, stretch_map_;
  std::vector<std::vector<LinearForm::Entry>> rows_;
  Eigen::VectorXd q0_;
};

}  // namespace plumbline::model
