// Every law of the ground tells its reader all there is to tell, what it writes down is what it computes, and
// at its null values it changes nothing.
#include <gtest/gtest.h>
#include <udunits2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "contact/contact_law.h"
#include "contact/laws.h"
#include "tests/contact/values.h"
#include "tests/effects/expression.h"

namespace plumbline::contact {
namespace {

using effects::Law;
using effects::Scales;
using effects::Values;

class Random {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Eigen::Vector2d vector(double size) { return {between(-size, size), between(-size, size)}; }
  /// Every parameter away from null, of typical size and in its bounds.
  Values parameters(const Law& law) {
    Values p = law.typical(Scales{0.01, 0.5, 300.0, 60.0, 1e-3, 0.0});
    const auto& declared = law.declaration().parameters;
    for (std::size_t i = 0; i < p.size(); ++i) {
      p[i] = std::clamp(p[i] * between(0.3, 1.7), declared[i].lower, declared[i].upper);
    }
    return p;
  }

 private:
  std::mt19937 generator_{20240229};
};

std::shared_ptr<const NormalLaw> normal_law() {
  return std::dynamic_pointer_cast<const NormalLaw>(ground_laws()[0]);
}

std::shared_ptr<const TangentialLaw> tangential_law() {
  return std::dynamic_pointer_cast<const TangentialLaw>(ground_laws()[1]);
}

std::shared_ptr<const TangentialLaw> coulomb_law() {
  return std::dynamic_pointer_cast<const TangentialLaw>(ground_laws()[2]);
}

std::map<std::string, double> symbols_of(const Law& law, const Values& p) {
  std::map<std::string, double> symbols;
  for (std::size_t i = 0; i < p.size(); ++i) symbols[law.declaration().parameters[i].name] = p[i];
  return symbols;
}

class EveryGroundLaw : public testing::TestWithParam<std::shared_ptr<const Law>> {
 protected:
  const Law& law() const { return *GetParam(); }
  const effects::Declaration& declared() const { return law().declaration(); }
};

INSTANTIATE_TEST_SUITE_P(Ground, EveryGroundLaw, testing::ValuesIn(ground_laws()),
                         [](const auto& each) { return each.param->declaration().name; });

TEST_P(EveryGroundLaw, DeclaresWhatAReaderNeeds) {
  EXPECT_GT(declared().summary.size(), 10U);
  EXPECT_GT(declared().source.size(), 10U);
  EXPECT_TRUE(law().sits_at(effects::Place::foot));
  EXPECT_EQ(effects::to_string(declared().places.front()), "foot");
  std::set<std::string> names;
  for (const auto& parameter : declared().parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_GT(parameter.meaning.size(), 5U) << parameter.name;
    EXPECT_NE(declared().equation.find(parameter.name), std::string::npos) << parameter.name;
    EXPECT_LE(parameter.lower, parameter.null_value) << parameter.name;
    EXPECT_GE(parameter.upper, parameter.null_value) << parameter.name;
  }
}

// udunits2 reads the paper's "N/m^1.5" as "5 N/m" without a word, so no unit may have a broken power.
TEST_P(EveryGroundLaw, HasUnitsOfOneAndWholePowers) {
  ut_set_error_message_handler(ut_ignore);
  const std::unique_ptr<ut_system, void (*)(ut_system*)> system(ut_read_xml(nullptr), ut_free_system);
  ASSERT_TRUE(system);
  for (const auto& parameter : declared().parameters) {
    const std::unique_ptr<ut_unit, void (*)(ut_unit*)> unit(
        ut_parse(system.get(), parameter.unit.c_str(), UT_ASCII), ut_free);
    EXPECT_TRUE(unit) << parameter.unit;
    EXPECT_EQ(parameter.unit.find('.'), std::string::npos) << parameter.unit;
    EXPECT_EQ(effects::unit_at(parameter.unit, true), parameter.unit);
  }
}

TEST_P(EveryGroundLaw, HasUsableSizesAndStartsWhateverTheScales) {
  const double nan = std::nan("");
  const double huge = std::numeric_limits<double>::infinity();
  for (const Scales& scales :
       {Scales{}, Scales{0.01, 0.5, 300.0, 60.0, 1e-3, 0.0}, Scales{0, 0, 0, 0, 0, 0},
        Scales{nan, nan, nan, nan, nan, nan}, Scales{huge, huge, huge, huge, huge, huge}}) {
    const Values typical = law().typical(scales);
    ASSERT_EQ(typical.size(), declared().parameters.size());
    for (const double value : typical) EXPECT_TRUE(std::isfinite(value) && value > 0.0);
    const auto starts = law().starts(scales);
    ASSERT_FALSE(starts.empty());
    EXPECT_EQ(std::set<Values>(starts.begin(), starts.end()).size(), starts.size());
    for (const auto& start : starts) {
      ASSERT_EQ(start.size(), declared().parameters.size());
      for (std::size_t i = 0; i < start.size(); ++i) {
        EXPECT_GE(start[i], declared().parameters[i].lower) << declared().parameters[i].name;
        EXPECT_LE(start[i], declared().parameters[i].upper) << declared().parameters[i].name;
      }
    }
  }
}

TEST_P(EveryGroundLaw, KnowsWhenItIsNull) {
  Random random;
  EXPECT_TRUE(law().is_null(law().null_values().data()));
  EXPECT_FALSE(law().is_null(random.parameters(law()).data()));
}

TEST(GroundLaws, AreTheNormalOneTheTangentialOnesTheirErrorsAndTurningFriction) {
  ASSERT_EQ(ground_laws().size(), 9U);
  ASSERT_TRUE(normal_law());
  ASSERT_TRUE(tangential_law());
  EXPECT_EQ(normal_law()->declaration().name, "ground_normal");
  EXPECT_EQ(tangential_law()->declaration().name, "ground_friction");
  ASSERT_TRUE(coulomb_law());
  EXPECT_EQ(coulomb_law()->declaration().name, "ground_coulomb");
  EXPECT_EQ(coulomb_law()->state_count(), 0);
}

TEST(GroundLaws, ChangeNothingAtTheirNullValues) {
  Random random;
  const Values normal = normal_law()->null_values();
  const Values tangential = tangential_law()->null_values();
  for (int i = 0; i < 50; ++i) {
    const double depth = random.between(-0.01, 0.01), rate = random.between(-2, 2);
    EXPECT_EQ(normal_law()->force(depth, rate, normal.data()), 0.0);
    EXPECT_EQ(normal_law()->stored_energy(depth, normal.data()), 0.0);
    EXPECT_EQ(normal_law()->dissipated_power(depth, rate, normal.data()), 0.0);
    const Eigen::Vector2d slip = random.vector(2), d = random.vector(0.01);
    EXPECT_EQ(tangential_law()->force(slip, 500.0, d.data(), tangential.data()).norm(), 0.0);
    EXPECT_EQ(tangential_law()->stored_energy(500.0, d.data(), tangential.data()), 0.0);
    EXPECT_EQ(tangential_law()->dissipated_power(slip, 500.0, d.data(), tangential.data()), 0.0);
    Eigen::Vector2d rate_of_d;
    tangential_law()->state_rate(slip, 500.0, d.data(), tangential.data(), rate_of_d.data());
    EXPECT_TRUE(rate_of_d.allFinite());
    const Values coulomb = coulomb_law()->null_values();
    EXPECT_EQ(coulomb_law()->force(slip, 500.0, nullptr, coulomb.data()).norm(), 0.0);
    EXPECT_EQ(coulomb_law()->dissipated_power(slip, 500.0, nullptr, coulomb.data()), 0.0);
  }
}

TEST(GroundLaws, ComputeTheNormalForceThatTheyWriteDown) {
  Random random;
  const effects::Equations equations(normal_law()->declaration().equation);
  for (int i = 0; i < 200; ++i) {
    const Values p = random.parameters(*normal_law());
    auto symbols = symbols_of(*normal_law(), p);
    const double depth = random.between(-0.005, 0.02), rate = random.between(-2, 2);
    symbols["depth"] = depth;
    symbols["rate"] = rate;
    const double written = equations.value("normal", symbols);
    EXPECT_NEAR(normal_law()->force(depth, rate, p.data()), written, 1e-12 * (1 + written));
  }
}

TEST(GroundLaws, ComputeTheFrictionThatTheyWriteDown) {
  Random random;
  const effects::Equations equations(tangential_law()->declaration().equation);
  for (int i = 0; i < 200; ++i) {
    const Values p = random.parameters(*tangential_law());
    auto symbols = symbols_of(*tangential_law(), p);
    const Eigen::Vector2d slip = random.vector(2), d = random.vector(0.01);
    const double normal = i % 4 == 0 ? 0.0 : random.between(0, 900);
    symbols["v_x"] = slip.x();
    symbols["v_y"] = slip.y();
    symbols["normal"] = normal;
    symbols["bristle_x"] = d.x();
    symbols["bristle_y"] = d.y();
    const Eigen::Vector2d force = tangential_law()->force(slip, normal, d.data(), p.data());
    Eigen::Vector2d rate;
    tangential_law()->state_rate(slip, normal, d.data(), p.data(), rate.data());
    const auto expect_close = [&](double found, const char* name) {
      const double written = equations.value(name, symbols);
      EXPECT_NEAR(found, written, 1e-11 * (1 + std::abs(written))) << name;
    };
    expect_close(force.x(), "f_x");
    expect_close(force.y(), "f_y");
    expect_close(rate.x(), "bristle_x_rate");
    expect_close(rate.y(), "bristle_y_rate");
  }
}

TEST(GroundLaws, ComputeTheCoulombFrictionThatTheyWriteDown) {
  Random random;
  const effects::Equations equations(coulomb_law()->declaration().equation);
  for (int i = 0; i < 200; ++i) {
    const Values p = random.parameters(*coulomb_law());
    auto symbols = symbols_of(*coulomb_law(), p);
    const Eigen::Vector2d slip = random.vector(i % 2 == 0 ? 2.0 : 0.01);
    const double normal = i % 4 == 0 ? 0.0 : random.between(0, 900);
    symbols["v_x"] = slip.x();
    symbols["v_y"] = slip.y();
    symbols["normal"] = normal;
    const Eigen::Vector2d force = coulomb_law()->force(slip, normal, nullptr, p.data());
    const double x = equations.value("f_x", symbols), y = equations.value("f_y", symbols);
    EXPECT_NEAR(force.x(), x, 1e-11 * (1 + std::abs(x)));
    EXPECT_NEAR(force.y(), y, 1e-11 * (1 + std::abs(y)));
  }
}

}  // namespace
}  // namespace plumbline::contact
