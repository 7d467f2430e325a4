// At its null values an effect changes nothing, and it says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

TEST(NullValues, AreRecognised) {
  for (const auto& law : all_laws()) {
    EXPECT_TRUE(law->is_null(law->null_values().data())) << law->declaration().name;
  }
}

TEST(NullValues, StayNullWhateverTheStructuralValuesAre) {
  for (const auto& law : all_laws()) {
    Values p = law->null_values();
    const auto& declared = law->declaration().parameters;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (declared[i].structural) p[i] = std::clamp(0.37, declared[i].lower, declared[i].upper);
    }
    EXPECT_TRUE(law->is_null(p.data())) << law->declaration().name;
  }
}

TEST(NullValues, AreNotConfusedWithOthers) {
  Sampler sampler;
  for (const auto& law : all_laws()) {
    for (int i = 0; i < 20; ++i) {
      EXPECT_FALSE(law->is_null(sampler.parameters(*law).data())) << law->declaration().name;
    }
  }
}

TEST(NullValues, GiveNoForceNoEnergyAndNoLoss) {
  Sampler sampler;
  for (const auto& law : force_laws()) {
    const Values p = law->null_values();
    for (int i = 0; i < 50; ++i) {
      const Motion m = sampler.motion();
      const auto states = sampler.states(*law, p);
      EXPECT_EQ(law->force(m, states.data(), p.data()), 0.0) << law->declaration().name;
      EXPECT_EQ(law->stored_energy(m, states.data(), p.data()), 0.0) << law->declaration().name;
      EXPECT_EQ(law->dissipated_power(m, states.data(), p.data()), 0.0) << law->declaration().name;
    }
  }
}

// What is called null must not act, also where only some of the parameters are at their null values.
TEST(NullValues, HaveNoForceWhereverIsNullSaysSo) {
  Sampler sampler;
  for (const auto& law : force_laws()) {
    for (int i = 0; i < 200; ++i) {
      Values p = sampler.parameters(*law);
      for (std::size_t k = 0; k < p.size(); ++k) {
        if (sampler.sign() > 0) p[k] = law->null_values()[k];
      }
      if (!law->is_null(p.data())) continue;
      const Motion m = sampler.motion();
      const auto states = sampler.states(*law, p);
      EXPECT_EQ(law->force(m, states.data(), p.data()), 0.0) << law->declaration().name;
    }
  }
}

TEST(NullValues, PassCommandsOn) {
  for (const auto& law : all_laws()) {
    const auto actuator = std::dynamic_pointer_cast<const ActuatorLaw>(law);
    if (!actuator) continue;
    const Values p = law->null_values();
    std::vector<double> states(static_cast<std::size_t>(law->state_count()), 0.123);
    for (const double command : {-2.5, 0.0, 0.7}) {
      EXPECT_EQ(actuator->torque(command, states.data(), p.data()), command) << law->declaration().name;
    }
    EXPECT_EQ(actuator->delay(p.data()), 0.0) << law->declaration().name;
  }
}

TEST(NullValues, PassReadingsOn) {
  for (const auto& law : all_laws()) {
    const auto sensor = std::dynamic_pointer_cast<const SensorLaw>(law);
    if (!sensor) continue;
    for (const double actual : {-2.5, 0.0, 0.7}) {
      EXPECT_EQ(sensor->reading(actual, law->null_values().data()), actual) << law->declaration().name;
    }
  }
}

TEST(NullValues, LeaveASwitchInTime) {
  for (const auto& law : all_laws()) {
    const auto late = std::dynamic_pointer_cast<const SwitchLaw>(law);
    if (!late) continue;
    EXPECT_EQ(late->lateness(true, law->null_values().data()), 0.0);
    EXPECT_EQ(late->lateness(false, law->null_values().data()), 0.0);
  }
}

TEST(NullValues, LeaveTheStructureAlone) {
  for (const auto& law : all_laws()) {
    const auto structure = std::dynamic_pointer_cast<const StructureLaw>(law);
    if (!structure) continue;
    const StructureChange change = structure->change(law->null_values().data());
    EXPECT_EQ(change.inertia, 0.0);
    EXPECT_EQ(change.mass, 0.0);
    EXPECT_EQ(change.payload, 0.0);
    EXPECT_EQ(change.com_shift.norm(), 0.0);
    EXPECT_EQ(change.tilt.norm(), 0.0);
  }
}

}  // namespace
}  // namespace plumbline::effects
