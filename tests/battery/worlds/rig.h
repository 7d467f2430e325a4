// A robot on a bench as a foreign world sees it: links with hand-derived Lagrangian equations, motors on
// gears, sensors, maybe a ground under a foot.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "tests/battery/worlds/hidden.h"

namespace plumbline::battery::worlds {

constexpr int kMost = 6;  ///< coordinates of links and motors together
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMost, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost, kMost>;

/// A link's numbers in the plane, relative to its pivot (or to the rail it slides on). Angle 0: it hangs.
struct Link {
  std::string name;
  double mass = 0.0;     ///< kg
  double along = 0.0;    ///< of the centre of mass, downwards at angle 0, m
  double across = 0.0;   ///< of the centre of mass, along the link's x, m
  double central = 0.0;  ///< inertia about the centre of mass, kg m^2
  double about_pivot() const { return central + mass * (along * along + across * across); }
};

struct Motor {
  std::string name;
  int drives = 0;                ///< which of the links' coordinates
  double ratio = 1.0;            ///< motor's position per that coordinate
  double inertia = 0.0;          ///< of all that turns with it, at the motor
  double torque_per_unit = 1.0;  ///< of the command, over what the model states times its own
};

/// A row of factors over the links' coordinates.
struct Place {
  std::string name;
  Vector row;
};

struct Sensor {
  std::string name;
  std::string motor;  ///< empty: of `row`
  Vector row;
  double resolution = 0.0, noise = 0.0;
  double scale = 1.0, offset = 0.0;
};

/// Ground under a point foot (Hunt and Crossley 1975).
struct Ground {
  Vector row;             ///< foot's height over the links' coordinates
  double constant = 0.0;  ///< and at zero
  double stiffness = 0.0, damping = 0.0, exponent = 1.5, height = 0.0;
};

struct Rig;
/// The links' equations, by hand from Lagrange's: M(p) p'' + bias(p, p') = forces.
using Equations = void (*)(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias);

struct Rig {
  int coordinates = 0;  ///< of the links
  Equations equations = nullptr;
  std::vector<Link> bodies;
  double gravity = 9.80665, tilt = 0.0;  ///< tilt: of gravity about the world's y, rad
  double length = 0.0;                   ///< thigh (bench)
  double incline = 0.0;                  ///< of the way (cart), rad
  std::vector<Motor> motors;
  std::vector<Place> places;
  std::vector<Sensor> sensors;
  std::vector<Ground> grounds;
  std::vector<std::string> switches;  ///< names, one for each ground
  double switch_force =
      0.0;  ///< on the foot, N, from which its switch is closed; 0: while it is in the ground
  std::vector<Hidden> effects;  ///< the robot's own and what is hidden
  Link& body(const std::string& name);
  Motor* motor(const std::string& name);
  const Place* place(const std::string& name) const;
};

/// The rig that a model file describes: its numbers, not its equations. Throws std::invalid_argument for a
/// robot that no foreign world has.
Rig rig_of(const std::string& robot, const model::Model& model);
/// Is there such a rig?
bool has_rig(const std::string& robot);

/// Puts an effect into the rig: into its numbers where it is one of them, else into its list. Throws
/// std::invalid_argument for a place that the rig has not.
void hide(const Hidden& effect, Rig& rig);

}  // namespace plumbline::battery::worlds
