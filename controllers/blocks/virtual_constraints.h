// Virtual constraints of a walking step: what each leg and the torso are to do as the hip moves over the
// stance foot.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace plumbline::controllers {

/// Value and derivatives by the phase variable theta.
struct CurvePoint {
  double value = 0.0, slope = 0.0, curvature = 0.0;
};

/// h(theta) = sum_k alpha_k 5!/(k!(5-k)!) s^k (1-s)^(5-k), s = (theta - begin)/(end - begin): a Bezier
/// polynomial of degree 5. Beyond its ends s is held at 0 or 1 (the curve stays), or, with `go_on`, the curve
/// goes on along its tangent. Source: Sreenath et al. (2011), equations 51 and 52; held: Park et al., ICRA
/// 2012, equation 9.
struct Curve {
  double begin = 0.0, end = 1.0;
  std::array<double, 6> alpha{};
};
CurvePoint evaluate(const Curve& curve, double theta, bool go_on) noexcept;

/// The four phases of a step (Sreenath et al. equation 26): the stance leg's motor is moved while its spring
/// is pressed in (mc), is held while the spring gives back (sc), pushes off (si), and is held again until
/// touchdown (sd).
enum class WalkPhase { motor_compress, spring_compress, spring_inject, spring_decompress };
constexpr int kWalkPhases = 4;

/// In the order of the paper's equation 23, stance leg first.
enum WalkOutput { kStanceShape = 0, kSwingAngle = 1, kSwingShape = 2, kTorso = 3 };
/// Motors: leg angle and leg shape of the stance leg, then of the swing leg.
enum WalkMotor { kStanceAngleMotor = 0, kStanceShapeMotor = 1, kSwingAngleMotor = 2, kSwingShapeMotor = 3 };

/// A gait. Angles in rad; theta is the absolute angle of the stance leg, growing as the hip moves forward.
struct WalkingGait {
  double theta_begin = 0.0, theta_end = 0.0;  ///< just after one touchdown and just before the next
  double theta_mc = 0.0, theta_si = 0.0;      ///< where mc and si end
  double theta_sc = 0.0;       ///< where sc ends on the gait itself: u*(theta) of sc and si meet there
  double spring_switch = 0.0;  ///< sc ends where the stance spring falls below this
  Curve torso, swing_angle, swing_shape;  ///< torso: until theta_si, then its last value
  Curve shape_mc, shape_si;               ///< stance motor; in sc the last of mc, in sd the last of si
  std::array<std::array<Curve, kWalkPhases>, 4> torque{};  ///< u*(theta) of each motor in each phase, N m
  bool go_on = false;                                      ///< of the constraints beyond their ends
};

/// One number of a gait under the name that files give it.
struct GaitNumber {
  std::string name;
  const char* unit;
  double* value;
};
/// All of them, in a fixed order: theta_begin ... spring_switch, then torso_0 ... torso_5 and so on, then
/// u_MOTOR_PHASE_0 ...
std::vector<GaitNumber> numbers_of(WalkingGait& gait);
/// The curves' ends from the gait's thetas. To be called when its numbers have been set.
void place_curves(WalkingGait& gait) noexcept;

/// What is wanted of the four outputs.
std::array<CurvePoint, 4> wanted(const WalkingGait& gait, WalkPhase phase, double theta) noexcept;

/// u*(theta), N m, held beyond the ends of a phase.
std::array<double, 4> feedforward(const WalkingGait& gait, WalkPhase phase, double theta) noexcept;

/// The phase that follows `phase` at theta and the stance spring's deflection and its rate, or the same one.
/// A spring that falls too late does not keep the leg from pushing off: sc ends `latest_sc` (rad) after
/// theta_mc at the latest (Sreenath et al. equation 50).
WalkPhase next_phase(const WalkingGait& gait, WalkPhase phase, double theta, double spring,
                     double spring_rate, double latest_sc) noexcept;

}  // namespace plumbline::controllers
