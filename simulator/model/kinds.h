// Units and names of rotary and linear places.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

inline std::string position_unit(bool angular) { return angular ? "rad" : "m"; }
inline std::string force_unit(bool angular) { return angular ? "N m" : "N"; }
inline std::string inertia_unit(bool angular) { return angular ? "kg m^2" : "kg"; }
/// Of what a sensor of the model reads: rad, m, or N of a force plate.
std::string reading_unit(const Model& model, const std::string& sensor);
/// The column of its readings in traces and trials that Plumbline writes: q_knee, F_plate.
std::string reading_column(const Sensor& sensor);
/// Motor position per coordinate position.
std::string ratio_unit(bool motor_angular, bool coordinate_angular);

/// connect, hinge, weld, rod
std::string to_string(Loop::Type type);
/// "gyroscope", as the model file calls it.
std::string to_string(PointReading reading);
/// What a sensor measures: a place of the model, "vertical force on toe", "gyroscope on trunk".
std::string measured_by(const Model& model, const Sensor& sensor);

std::vector<std::string> joint_names(const Skeleton& skeleton);  ///< moving joints
/// Coordinates, then pulleys, which count as coordinates wherever one is named.
std::vector<std::string> coordinate_names(const Model& model);
std::vector<std::string> motor_names(const Model& model);
std::vector<std::string> pulley_names(const Model& model);
/// Coordinates, pulleys and motors.
std::vector<std::string> position_names(const Model& model);

/// The moving joint of this name or nullptr.
const Joint* find_joint(const Skeleton& skeleton, const std::string& name);

/// Whether the motor, coordinate, pulley or moving joint of this name turns (unknown names count as turning).
bool is_angular(const Model& model, const std::string& name);

/// Letters, digits, and _ . - in a name that a model file gives; throws InputError otherwise.
void check_name(const std::string& name, const YamlNode& node);

}  // namespace plumbline::model
