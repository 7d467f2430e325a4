// What the sensors of a Plant read, and how that changes with state and parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/plant_dynamics.h"
#include "simulator/model/plant_slots.h"
#include "simulator/model/plant_tangent.h"
#include "simulator/model/plant_values.h"
#include "simulator/model/tree_slopes.h"

namespace plumbline::model {

/// Readings without quantisation and noise: lines of z, force plates, and what is measured at points of
/// links, with the sensors' own effects.
class PlantReadings {
 public:
  /// Both have to outlive the readings.
  PlantReadings(PlantDynamics& plant, PlantTangent& tangent);

  /// As those of Plant.
  void outputs(const double* x, double* y, const double* command);
  const Eigen::MatrixXd& output_map() const { return output_map_; }
  const Eigen::VectorXd& output_offset() const { return output_offset_; }
  int tree_body_of_sensor(int sensor) const;
  void output_tangent(const double* x, const std::vector<ParameterId>& parameters,
                      const Eigen::VectorXd& steps, Eigen::MatrixXd& D);
  void output_jacobian(const double* x, Eigen::MatrixXd& C, const double* command);
  Eigen::MatrixXd acceleration_map(const double* x);

 private:
  struct PointSlot {
    int sensor = 0;  // index in the model
    int body = -1;   // in the mechanism's tree
  };

  const double* values(int effect) const { return plant_.values(effect); }
  int sensors() const { return static_cast<int>(model_.sensors.size()); }
  void place_point_sensor(int sensor);
  void plate_outputs(const double* x, double* y);
  void point_outputs(const double* x, const double* command, double* y);
  void point_jacobian(const double* x, const double* command, Eigen::MatrixXd& C);
  void feel_points(Eigen::VectorXd acceleration, Eigen::MatrixXd& C);
  Eigen::VectorXd accelerations_at(const double* x, const double* command);
  void read_points(const double* x, const Eigen::VectorXd& acceleration, Eigen::VectorXd& readings);
  void tilt_tangent(const double* x, const std::vector<ParameterId>& parameters, const Eigen::VectorXd& steps,
                    Eigen::MatrixXd& D);

  PlantDynamics& plant_;
  PlantTangent& tangent_;
  const Model& model_;
  RigidBodies& bodies_;
  const Eigen::MatrixXd& S_tree_;
  const int n_tree_, nz_;
  std::vector<std::vector<SensorSlot>> sensor_effects_;
  std::vector<PointSlot> points_;
  Eigen::MatrixXd output_map_;
  Eigen::VectorXd output_offset_;
  TreeSlopes tree_slopes_;  // work space
};

}  // namespace plumbline::model
