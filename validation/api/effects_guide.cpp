#include "validation/api/effects_guide.h"

#include <algorithm>

namespace plumbline::api {

// NOLINTNEXTLINE(readability-function-size): a table
const std::vector<EffectGuide>& effects_guide() {
  static const std::vector<EffectGuide> kGuide{
      {"viscous", "friction", "quadratic, a winding driven by voltage (back EMF)",
       "a free swing: amplitudes fall in proportion"},
      {"coulomb", "friction", "stribeck, load_friction",
       "a free swing: amplitudes fall by equal steps; slow ramps"},
      {"stribeck", "friction", "coulomb, lugre", "constant speeds from creeping to fast, both ways"},
      {"lugre", "friction", "stribeck, hysteresis", "small reversals at rest: the bristles spring back"},
      {"viscous_directional", "friction", "quadratic, torque_bias", "the same speeds forwards and backwards"},
      {"coulomb_directional", "friction", "torque_bias, gear_efficiency",
       "the same slow ramp forwards and backwards"},
      {"load_friction", "friction", "gear_friction, torque_constant_error",
       "the same speed with and without a weight, and a light motor that is spun up"},
      {"gear_friction", "friction", "load_friction, gear_efficiency",
       "the same speed with and without a weight"},
      {"gear_efficiency", "friction", "gear_friction, coulomb_directional",
       "lift a weight and let it down at the same speed"},
      {"quadratic", "friction", "viscous, viscous_directional",
       "constant speeds, one of them twice the other"},
      {"hysteresis", "friction", "coulomb, lugre", "the same slow sine with two amplitudes about rest"},
      {"spring", "elasticity", "a centre of mass (com_shift), hardening", "stand still at many positions"},
      {"preload", "elasticity", "torque_bias, com_shift",
       "stand still at many positions: the force stays the same"},
      {"hardening", "elasticity", "spring, hard_stop",
       "stand still at many positions, near the ends of the way"},
      {"unilateral_spring", "elasticity", "asymmetric_spring, hard_stop",
       "slow way through the position where it begins"},
      {"asymmetric_spring", "elasticity", "spring with unilateral_spring",
       "slow way through rest, equally far to both sides"},
      {"hard_stop", "elasticity", "unilateral_spring, hardening", "come to the end of the way at two speeds"},
      {"cable_stretch", "drive train", "backlash, encoder_scale, rotor_inertia",
       "hold the link and push with the motor, slowly and at 5 to 30 Hz"},
      {"backlash", "drive train", "cable_stretch, encoder_offset",
       "reverse under a load that changes its sign, and one that does not"},
      {"harmonic_drive", "drive train", "cable_stretch, backlash",
       "hold the link and push with the motor, slowly, to a few shares of the largest torque"},
      {"slipping_coupling", "drive train", "torque_saturation, cable_stretch, encoder_offset",
       "push past the limit and back, with encoders before and behind it: what is lost stays lost"},
      {"cogging", "drive train", "torque_bias, hardening, torque_ripple",
       "turn slowly through several turns of the motor"},
      {"torque_ripple", "drive train", "cogging, encoder_eccentricity",
       "turn slowly under two weights: cogging stays, a ripple doubles with the weight"},
      {"rotor_inertia", "inertia", "added_mass, torque_constant_error",
       "the same motion with a weight added to the link"},
      {"added_mass", "inertia", "com_shift, payload, torque_constant_error",
       "stand still at many positions, then accelerate"},
      {"com_shift", "inertia", "added_mass, payload, gravity_tilt", "stand still at many positions"},
      {"payload", "inertia", "added_mass, com_shift",
       "stand still at many positions, then accelerate about two axes"},
      {"resonator", "inertia", "cable_stretch, rotor_inertia, lugre",
       "a sine swept slowly through its frequency"},
      {"torque_constant_error", "winding and supply", "rotor_inertia, torque_saturation",
       "hold a known weight"},
      {"torque_saturation", "winding and supply", "torque_constant_error, voltage_limit",
       "hold weights up to the largest torque, at rest"},
      {"voltage_limit", "winding and supply", "torque_saturation, viscous",
       "the largest torque at rest and at speed"},
      {"thermal_motor", "winding and supply", "torque_constant_error, viscous that grows",
       "hold a known weight for minutes, from cold"},
      {"battery", "winding and supply", "torque_saturation, voltage_limit, viscous",
       "hold one joint at rest and load another: with a battery the first one sinks, too"},
      {"torque_bias", "winding and supply", "preload, coulomb_directional",
       "stand still at many positions, with the motor off and on"},
      {"actuator_lag", "electronics and clocks", "command_delay",
       "steps of torque: one bends, one comes late"},
      {"current_loop", "electronics and clocks", "actuator_lag, command_delay",
       "steps of torque, sampled at 10 kHz: one overshoots"},
      {"winding", "electronics and clocks", "actuator_lag, viscous, rotor_inertia",
       "steps of voltage with the rotor held, then free"},
      {"command_delay", "electronics and clocks", "actuator_lag",
       "steps of torque: one bends, one comes late"},
      {"switch_lateness", "electronics and clocks", "ground_height_error, ground_stiffness_error",
       "landings at two speeds"},
      {"encoder_offset", "sensors", "gravity_tilt, backlash", "a stop or a mark whose position is known"},
      {"encoder_eccentricity", "sensors", "encoder_scale, cogging",
       "turn slowly and evenly through a whole turn"},
      {"encoder_scale", "sensors", "a ratio, cable_stretch", "two marks whose distance is known"},
      {"gravity_tilt", "surroundings", "com_shift, encoder_offset",
       "stand still at many positions; a spirit level"},
      {"boom", "surroundings", "gravity_tilt, coulomb at the base",
       "the same hop near and far from the tower's height"},
      {"ground_normal", "ground", "ground_stiffness_error", "landings at two speeds"},
      {"ground_friction", "ground", "ground_friction_error", "push sideways until it slips"},
      {"ground_stiffness_error", "ground", "ground_height_error",
       "stand with and without a weight; landings at two speeds"},
      {"ground_damping_error", "ground", "ground_stiffness_error", "landings at two speeds"},
      {"ground_friction_error", "ground", "encoder_offset", "push sideways until it slips"},
      {"ground_height_error", "ground", "encoder_offset, switch_lateness",
       "touch the ground slowly at several places"},
  };
  return kGuide;
}

const EffectGuide* find_guide(const std::string& effect) {
  const auto& all = effects_guide();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const EffectGuide& one) { return one.name == effect; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace plumbline::api
