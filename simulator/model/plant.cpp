// The parts of a Plant behind one door.
#include "simulator/model/plant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulator/model/asked_torque.h"
#include "simulator/model/energy_account.h"
#include "simulator/model/hidden_states.h"
#include "simulator/model/plant_dynamics.h"
#include "simulator/model/plant_readings.h"
#include "simulator/model/plant_tangent.h"

namespace plumbline::model {

using Vector = Eigen::Map<const Eigen::VectorXd>;

Plant::Plant(const Model& model, const std::vector<Lock>& locks, contact::Terrain terrain)
    : dynamics_(std::make_unique<PlantDynamics>(model, locks, std::move(terrain))),
      tangent_(std::make_unique<PlantTangent>(*dynamics_)),
      readings_(std::make_unique<PlantReadings>(*dynamics_, *tangent_)) {}

Plant::~Plant() = default;
Plant::Plant(Plant&&) noexcept = default;
Plant& Plant::operator=(Plant&&) noexcept = default;

const Model& Plant::model() const { return dynamics_->model(); }
const contact::Terrain& Plant::terrain() const { return dynamics_->feet().terrain(); }
int Plant::positions() const { return dynamics_->positions(); }
int Plant::states() const { return dynamics_->states(); }
int Plant::motors() const { return dynamics_->motors(); }
int Plant::sensors() const { return static_cast<int>(model().sensors.size()); }
std::vector<std::string> Plant::state_names() const { return dynamics_->state_names(); }
std::vector<int> Plant::carried_states() const { return model::carried_states(*dynamics_); }
std::vector<int> Plant::carried_state_effects() const { return model::carried_state_effects(*dynamics_); }

void Plant::rate(const double* x, const double* command, double* xdot) { dynamics_->rate(x, command, xdot); }
Eigen::VectorXd Plant::fall(const double* x) { return dynamics_->fall(x); }
Eigen::VectorXd Plant::equilibrium(const Eigen::VectorXd& z, const double* command) {
  return dynamics_->equilibrium(z, command);
}

bool Plant::has_loops() const { return dynamics_->bodies().has_loops(); }
LoopClosure* Plant::holding() { return dynamics_->bodies().held(); }
LoopClosure* Plant::closure() { return dynamics_->bodies().closure(); }
std::unique_ptr<LoopClosure> Plant::own_closure() const { return dynamics_->bodies().own_closure(); }
Eigen::VectorXd Plant::home() const { return dynamics_->bodies().home(); }
double Plant::close_loops(double* x) { return dynamics_->bodies().close_loops(x); }
Eigen::Vector2d Plant::loop_errors(const double* x) { return dynamics_->bodies().loop_errors(x); }
Eigen::MatrixXd Plant::closing_slope(const double* x) { return dynamics_->bodies().closing_slope(x); }

void Plant::outputs(const double* x, double* y, const double* command) { readings_->outputs(x, y, command); }
const Eigen::MatrixXd& Plant::output_map() const { return readings_->output_map(); }
const Eigen::VectorXd& Plant::output_offset() const { return readings_->output_offset(); }
int Plant::tree_body_of_sensor(int sensor) const { return readings_->tree_body_of_sensor(sensor); }
bool Plant::lets_stretch(const std::string& name) const { return dynamics_->map().is_released(name); }
const Eigen::MatrixXd& Plant::stretch_map() const { return dynamics_->map().stretch_map(); }
const TreeDynamics& Plant::tree() const { return dynamics_->bodies().tree(); }
const Eigen::MatrixXd& Plant::joint_map() const { return dynamics_->map().S_tree(); }

std::vector<Touch> Plant::touches(const double* x) { return dynamics_->touches(x); }
bool Plant::meets_ground() const { return !dynamics_->feet().empty(); }
int Plant::link_points() const { return dynamics_->link_points(); }
bool Plant::meets_anything() const { return dynamics_->meets_anything(); }
std::vector<LinkTouch> Plant::link_touches(const double* x) { return dynamics_->link_touches(x); }
FootDepth Plant::foot_depth(int foot, const double* x) { return dynamics_->foot_depth(foot, x); }
Eigen::RowVectorXd Plant::depth_slope(int foot, const double* x) { return dynamics_->depth_slope(foot, x); }
Eigen::RowVectorXd Plant::depth_slope(int foot, const double* x, const std::vector<ParameterId>& parameters) {
  return tangent_->depth_slope(foot, x, parameters);
}

std::vector<Eigen::Vector3d> Plant::contact_forces(const double* x) {
  std::vector<Eigen::Vector3d> forces(model().contacts.size(), Eigen::Vector3d::Zero());
  for (const LinkTouch& at : link_touches(x)) {
    forces[static_cast<std::size_t>(at.contact)] += at.first == 0 ? at.force : Eigen::Vector3d(-at.force);
  }
  return forces;
}

double Plant::switch_lateness(const std::string& contact_switch, bool closes) const {
  return dynamics_->switch_lateness(contact_switch, closes);
}
Eigen::RowVectorXd Plant::switch_lateness_slope(const std::string& contact_switch, bool closes,
                                                const std::vector<ParameterId>& parameters) const {
  return dynamics_->switch_lateness_slope(contact_switch, closes, parameters);
}
int Plant::switch_count() const { return dynamics_->switch_count(); }
void Plant::switches(const double* x, double* g) { dynamics_->switches(x, g); }
std::vector<Plant::Jump> Plant::jumps() const { return dynamics_->jumps(); }

double Plant::delay(int motor) const { return dynamics_->delay(motor); }
double Plant::torque_gain(int motor) const {
  return model::torque_gain(model().motors[static_cast<std::size_t>(motor)]);
}

std::vector<double> Plant::delays() const {
  std::vector<double> all(static_cast<std::size_t>(motors()));
  for (int m = 0; m < motors(); ++m) {
    all[static_cast<std::size_t>(m)] = delay(m);
  }
  return all;
}

void Plant::settle(const double* command, double* x) const { model::settle(*dynamics_, command, x); }
void Plant::carry_states(const double* from, const double* to, const double* command, double h,
                         double* x) const {
  model::carry_states(*dynamics_, from, to, command, h, x);
}

bool Plant::loses_counts() const { return !dynamics_->losses().empty(); }
void Plant::carry_losses(int sensor, const Eigen::VectorXd& rates, double h, double* x) const {
  dynamics_->losses().carry(sensor, rates, h, x);
}

Energetics Plant::energetics(const double* x, const double* command) {
  return model::energetics(*dynamics_, x, command);
}
Energetics Plant::powers(const double* x) const { return model::powers(*dynamics_, x); }

double Plant::value(ParameterId id) const {
  return dynamics_->values(id.effect)[static_cast<std::size_t>(id.parameter)];
}
void Plant::set_value(ParameterId id, double value) {
  if (dynamics_->set_value(id, value)) {
    tangent_->forget_variants();
  }
}

void Plant::tangent(const SampleMotion& sample, const std::vector<ParameterId>& parameters,
                    const Eigen::VectorXd& steps, bool refresh, Eigen::MatrixXd& A, Eigen::MatrixXd& B) {
  tangent_->tangent(sample, parameters, steps, refresh, A, B);
}
// A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void Plant::stiff_jacobian(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A) {
  tangent_->stiff_jacobian(x, command, A);
}
Stiffest Plant::stiffest(const double* x, const double* command) { return tangent_->stiffest(x, command); }
void Plant::output_tangent(const double* x, const std::vector<ParameterId>& parameters,
                           const Eigen::VectorXd& steps, Eigen::MatrixXd& D) {
  readings_->output_tangent(x, parameters, steps, D);
}
void Plant::output_jacobian(const double* x, Eigen::MatrixXd& C, const double* command) {
  readings_->output_jacobian(x, C, command);
}
Eigen::MatrixXd Plant::acceleration_map(const double* x) { return readings_->acceleration_map(x); }

Eigen::VectorXd Plant::joint_positions(const double* x) const {
  const CoordinateMap& map = dynamics_->map();
  return map.S_tree() * Vector(x, positions()) + map.q0().head(map.tree());
}
const Eigen::MatrixXd& Plant::mass_matrix() const { return dynamics_->bodies().M(); }

void Plant::raise_speeds(const double* x, double* speeds) {
  dynamics_->bodies().rigid_at(x);
  const Eigen::MatrixXd& M = mass_matrix();
  const Vector w(x + positions(), positions());
  double twice_energy = 0.0;
  for (int i = 0; i < positions(); ++i) {
    twice_energy += w[i] * M.col(i).dot(w);
  }
  for (int i = 0; i < positions(); ++i) {
    speeds[i] = std::max(speeds[i], std::sqrt(twice_energy / M(i, i)));
  }
}

double Plant::position_of(const std::string& name, const double* x) const {
  const CoordinateMap& map = dynamics_->map();
  const LinearForm line = map.line_of(map.full_direction(name));
  return line.offset + line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x, positions()));
}

double Plant::velocity_of(const std::string& name, const double* x) const {
  const CoordinateMap& map = dynamics_->map();
  const LinearForm line = map.line_of(map.full_direction(name));
  return line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x + positions(), positions()));
}

// 1 / (a' M^-1 a): what a force along the place has to accelerate.
double Plant::inertia_of(const std::string& name) {
  const CoordinateMap& map = dynamics_->map();
  const Eigen::VectorXd a = map.S().transpose() * map.full_direction(name);
  const double mobility = a.dot(dynamics_->bodies().accelerated(a));
  return mobility > 0.0 ? 1.0 / mobility : std::numeric_limits<double>::infinity();
}

Plant::Lever Plant::lever_of(const std::string& rod) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * positions());
  x.head(positions()) = home();
  dynamics_->bodies().rigid_at(x.data());
  ReleasedRods rods(model(), dynamics_->map());
  const int index = rods.add(rod, dynamics_->bodies().mechanism());
  const Eigen::VectorXd row = rods.line_at(index, dynamics_->bodies().tree(), x.data()).reduced;
  Eigen::Index most = 0;
  row.cwiseAbs().maxCoeff(&most);
  return {dynamics_->map().name_of_independent(static_cast<int>(most)), row[most]};
}

effects::Motion Plant::motion_at(effects::Place place, const std::string& at, const double* x) const {
  const CoordinateMap& map = dynamics_->map();
  if (place == effects::Place::ratio && model().find_rod(at) != nullptr) {
    return dynamics_->rod_motion(at, x);
  }
  const LinearForm line =
      map.line_of(place == effects::Place::ratio ? map.stretch_direction(*model().find_ratio(at))
                                                 : map.full_direction(at));
  return {line.offset + line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x, positions())),
          line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x + positions(), positions())), 0.0};
}

}  // namespace plumbline::model
