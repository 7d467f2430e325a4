// A robot on a bench as a foreign world sees it: links with hand-derived Lagrangian equations, motors on
// gears, sensors, maybe a ground under a foot.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "tests/battery/worlds/hidden.h"

namespace plumbline::battery::worlds {

constexpr int kMost = 13;  ///< coordinates of links and motors together
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
  int also = -1;                 ///< a second coordinate that turns it; -1: none
  double also_ratio = 0.0;       ///< motor's position per that one
  /// The motor's position (or rate) at those of the links' coordinates, nothing stretched.
  double at(const Vector& links) const {
    return ratio * links[drives] + (also >= 0 ? also_ratio * links[also] : 0.0);
  }
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
  double late = 0.0;                                 ///< shows what was so many seconds earlier
  double waves = 0.0, amplitude = 0.0, phase = 0.0;  ///< of an eccentric disc: amplitude cos(waves x - phase)
  double bit_error = 0.0, bit_step = 1.0;            ///< outside.h
  double held_share = 0.0;                           ///< chance that a reading is held for two samples
  double lost_share = 0.0, limit_speed = 1.0;        ///< of the way between two samples faster than that
};

struct Rig;
struct Ground;

/// A foot that is not a sum of coordinates: where it is and what moves it.
struct FootMotion {
  double height = 0.0, height_rate = 0.0;
  double x_rate = 0.0;
  Vector along, up;  ///< dx/dp and d(height)/dp of the links' coordinates
};
using FootOf = FootMotion (*)(const Rig& rig, const Ground& ground, const Vector& full,
                              const Vector& full_rate);

/// Ground under a point foot; laws in ground.cpp.
struct Ground {
  std::string name;        ///< of the foot
  Vector row;              ///< foot's height over the links' coordinates
  double constant = 0.0;   ///< and at zero; with `foot`: height of the foot in its link, m
  FootOf foot = nullptr;   ///< in place of the row
  int leg = 0;             ///< with `foot`: whose
  double stiffness = 0.0;  ///< of the normal force, N/m^exponent
  double damping = 0.0, root_damping = 0.0, rounding = 0.0, exponent = 1.5, height = 0.0;
  double bristle_stiffness = 0.0, bristle_damping = 0.0;  ///< 1/m, s/m
  double friction = 0.0, viscous = 0.0;                   ///< coefficient of sliding (0: none), s/m
  double relaxation = 0.01;                               ///< of the bristles in the air, s
};

/// The links' equations, by hand from Lagrange's: M(p) p'' + bias(p, p') = forces.
using Equations = void (*)(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias);

constexpr double kStep = 2e-5;  ///< s

struct Rig {
  int coordinates = 0;  ///< of the links
  double step = kStep;  ///< of the integration, at most, s
  Equations equations = nullptr;
  std::vector<Link> bodies;
  double gravity = 9.80665, tilt = 0.0;  ///< tilt: of gravity about the world's y, rad
  double length = 0.0;                   ///< thigh (bench, MABEL)
  double pivot = 0.0;                    ///< height of the springs' bars over the hip (MABEL), m
  double incline = 0.0;                  ///< of the way (cart), rad
  std::vector<double> pulleys;  ///< inertias of the last coordinates, which turn by themselves (MABEL)
  /// Coordinates so light that a stop stops them within microseconds. Behind it they then have no inertia,
  /// and creep at the speed at which the forces on them are in balance.
  std::vector<int> light;
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

/// The numbers of a body in the plane of motion, x to the right and z up.
Link link_of(const model::Model& model, const std::string& name);
/// A motor with its inertias; its ratio is the first of the file.
Motor motor_of(const model::Model& model, const std::string& name, int drives);

/// Puts an effect into the rig: into its numbers where it is one of them, else into its list. Throws
/// std::invalid_argument for a place that the rig has not.
void hide(const Hidden& effect, Rig& rig);

}  // namespace plumbline::battery::worlds
