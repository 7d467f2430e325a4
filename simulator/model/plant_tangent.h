// Linearisation of a Plant: how its rate changes with state and parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/plant_dynamics.h"
#include "simulator/model/plant_slots.h"
#include "simulator/model/plant_values.h"
#include "simulator/model/rigid_bodies.h"
#include "simulator/model/tree_slopes.h"

namespace plumbline::model {

/// The bodies with one structural parameter moved.
struct BodyVariant {
  ParameterId id;
  double step = 0.0;
  BodyStructure structure;
  std::vector<int> heavier;  ///< bodies of the tree whose mass, centre of mass or inertia is another
  Eigen::MatrixXd dM;        ///< by differences, only where gravity is another
  Eigen::VectorXd dh;
};

/// Slopes of PlantDynamics::rate(): those of the rigid bodies in closed form (of closed loops by
/// differences), those of each effect by scalar differences of its law. Keeps what varies slowly against a
/// sample: the bodies' own slopes, and their variants by structural parameters.
class PlantTangent {
 public:
  /// The equations have to outlive it.
  explicit PlantTangent(PlantDynamics& plant);

  /// As those of Plant.
  void tangent(const SampleMotion& sample, const std::vector<ParameterId>& parameters,
               const Eigen::VectorXd& steps, bool refresh, Eigen::MatrixXd& A, Eigen::MatrixXd& B);
  void stiff_jacobian(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A);
  Stiffest stiffest(const double* x, const double* command);
  Eigen::RowVectorXd depth_slope(int foot, const double* x, const std::vector<ParameterId>& parameters);

  /// Made where it is asked for first, with this step.
  BodyVariant& variant_of(ParameterId id, double step);
  /// After other bodies have come into the place of those that the variants differ from.
  void forget_variants() { variants_.clear(); }

 private:
  struct Reach {
    double up = 0.0, down = 0.0;
  };

  const double* values(int effect) const { return plant_.values(effect); }
  effects::Motion half_change(const ForceSlot& slot, const double* change) const;
  Reach reach_beside_jumps(const ForceSlot& slot, const effects::Motion& at, double most) const;

  void rigid_tangent();
  void effect_tangent(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A);
  void force_tangent(const ForceSlot& slot, const double* x, const double* change,
                     Eigen::Ref<Eigen::MatrixXd> A);
  void rod_tangent(const ForceSlot& slot, const double* x, Eigen::Ref<Eigen::MatrixXd> A);
  void link_tangent(const LinkContacts& links, const double* x, const double* change,
                    Eigen::Ref<Eigen::MatrixXd> A);
  void actuator_tangent(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A);
  void supply_tangent(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A);

  void parameter_tangent(const SampleMotion& sample, const double* x, const Eigen::MatrixXd& A,
                         ParameterId id, double step, bool refresh, Eigen::Ref<Eigen::VectorXd> column);
  void force_parameter_tangent(const ForceSlot& slot, const SampleMotion& sample, const double* x,
                               ParameterId id, const effects::Values& moved, double step,
                               Eigen::Ref<Eigen::VectorXd> column);
  void actuator_parameter_tangent(int motor, const ActuatorSlot& slot, const SampleMotion& sample,
                                  const double* x, const Eigen::MatrixXd& A, effects::Values moved,
                                  double step, Eigen::Ref<Eigen::VectorXd> column);
  void ground_parameter_tangent(const FootSlot& slot, const double* x, ParameterId id, double step,
                                effects::Values moved, Eigen::Ref<Eigen::VectorXd> column);
  void link_parameter_tangent(const double* x, ParameterId id, double step, effects::Values moved,
                              Eigen::Ref<Eigen::VectorXd> column);
  void structure_tangent(const double* x, ParameterId id, double step, bool refresh,
                         Eigen::Ref<Eigen::VectorXd> column);
  void gravity_tangent(const double* x, BodyVariant& variant, bool refresh,
                       Eigen::Ref<Eigen::VectorXd> column);
  void base_tangent(const SampleMotion& sample, ParameterId id, double step,
                    Eigen::Ref<Eigen::VectorXd> column);

  PlantDynamics& plant_;
  RigidBodies& bodies_;
  const Eigen::MatrixXd& S_tree_;
  const int n_tree_, nz_, nx_;
  Eigen::MatrixXd rigid_A_;  // d(d2z/dt2)/d(z, dz/dt) of the bodies alone
  TreeSlopes tree_slopes_;
  Eigen::MatrixXd slopes_;  // d(generalised force)/dx
  std::vector<BodyVariant> variants_;
};

}  // namespace plumbline::model
