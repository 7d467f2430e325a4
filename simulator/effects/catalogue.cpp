#include "simulator/effects/catalogue.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "simulator/effects/actuator_lag.h"
#include "simulator/effects/added_mass.h"
#include "simulator/effects/asymmetric_spring.h"
#include "simulator/effects/backlash.h"
#include "simulator/effects/battery.h"
#include "simulator/effects/boom.h"
#include "simulator/effects/bus_delay.h"
#include "simulator/effects/cable_stretch.h"
#include "simulator/effects/clock_drift.h"
#include "simulator/effects/cogging.h"
#include "simulator/effects/com_shift.h"
#include "simulator/effects/command_delay.h"
#include "simulator/effects/coulomb.h"
#include "simulator/effects/coulomb_directional.h"
#include "simulator/effects/current_loop.h"
#include "simulator/effects/encoder_eccentricity.h"
#include "simulator/effects/encoder_offset.h"
#include "simulator/effects/encoder_scale.h"
#include "simulator/effects/gear_efficiency.h"
#include "simulator/effects/gear_friction.h"
#include "simulator/effects/gravity_tilt.h"
#include "simulator/effects/hard_stop.h"
#include "simulator/effects/hardening.h"
#include "simulator/effects/harmonic_drive.h"
#include "simulator/effects/hysteresis.h"
#include "simulator/effects/imu_bias.h"
#include "simulator/effects/imu_misalignment.h"
#include "simulator/effects/imu_scale.h"
#include "simulator/effects/link_inertia.h"
#include "simulator/effects/load_friction.h"
#include "simulator/effects/lost_counts.h"
#include "simulator/effects/lugre.h"
#include "simulator/effects/payload.h"
#include "simulator/effects/preload.h"
#include "simulator/effects/quadratic.h"
#include "simulator/effects/resonator.h"
#include "simulator/effects/rotor_inertia.h"
#include "simulator/effects/sensor_lag.h"
#include "simulator/effects/slipping_coupling.h"
#include "simulator/effects/spring.h"
#include "simulator/effects/stribeck.h"
#include "simulator/effects/switch_lateness.h"
#include "simulator/effects/thermal_motor.h"
#include "simulator/effects/torque_bias.h"
#include "simulator/effects/torque_constant_error.h"
#include "simulator/effects/torque_ripple.h"
#include "simulator/effects/torque_saturation.h"
#include "simulator/effects/unilateral_spring.h"
#include "simulator/effects/viscous.h"
#include "simulator/effects/viscous_directional.h"
#include "simulator/effects/voltage_limit.h"
#include "simulator/effects/winding.h"

namespace plumbline::effects {

// A new effect is one line here (and one file pair).
Catalogue Catalogue::all() {
  return Catalogue({
      std::make_shared<const Viscous>(),
      std::make_shared<const Coulomb>(),
      std::make_shared<const Stribeck>(),
      std::make_shared<const LuGre>(),
      std::make_shared<const ViscousDirectional>(),
      std::make_shared<const CoulombDirectional>(),
      std::make_shared<const LoadFriction>(),
      std::make_shared<const GearFriction>(),
      std::make_shared<const GearEfficiency>(),
      std::make_shared<const Quadratic>(),
      std::make_shared<const Hysteresis>(),
      std::make_shared<const Backlash>(),
      std::make_shared<const CableStretch>(),
      std::make_shared<const HarmonicDrive>(),
      std::make_shared<const SlippingCoupling>(),
      std::make_shared<const Spring>(),
      std::make_shared<const Preload>(),
      std::make_shared<const Hardening>(),
      std::make_shared<const AsymmetricSpring>(),
      std::make_shared<const UnilateralSpring>(),
      std::make_shared<const HardStop>(),
      std::make_shared<const Resonator>(),
      std::make_shared<const Cogging>(),
      std::make_shared<const TorqueRipple>(),
      std::make_shared<const TorqueBias>(),
      std::make_shared<const TorqueConstantError>(),
      std::make_shared<const TorqueSaturation>(),
      std::make_shared<const VoltageLimit>(),
      std::make_shared<const ThermalMotor>(),
      std::make_shared<const Battery>(),
      std::make_shared<const ActuatorLag>(),
      std::make_shared<const CurrentLoop>(),
      std::make_shared<const Winding>(),
      std::make_shared<const CommandDelay>(),
      std::make_shared<const BusDelay>(),
      std::make_shared<const ClockDrift>(),
      std::make_shared<const RotorInertia>(),
      std::make_shared<const AddedMass>(),
      std::make_shared<const ComShift>(),
      std::make_shared<const LinkInertia>(),
      std::make_shared<const Payload>(),
      std::make_shared<const GravityTilt>(),
      std::make_shared<const Boom>(),
      std::make_shared<const EncoderOffset>(),
      std::make_shared<const EncoderScale>(),
      std::make_shared<const EncoderEccentricity>(),
      std::make_shared<const SensorLag>(),
      std::make_shared<const LostCounts>(),
      std::make_shared<const ImuBias>(),
      std::make_shared<const ImuScale>(),
      std::make_shared<const ImuMisalignment>(),
      std::make_shared<const SwitchLateness>(),
  });
}

std::shared_ptr<const Law> Catalogue::find(const std::string& name) const {
  const auto found = std::find_if(laws_.begin(), laws_.end(),
                                  [&](const auto& law) { return law->declaration().name == name; });
  return found == laws_.end() ? nullptr : *found;
}

Catalogue Catalogue::without(const std::string& name) const {
  std::vector<std::shared_ptr<const Law>> kept;
  std::copy_if(laws_.begin(), laws_.end(), std::back_inserter(kept),
               [&](const auto& law) { return law->declaration().name != name; });
  return Catalogue(std::move(kept));
}

}  // namespace plumbline::effects
