// Every law tells its reader all there is to tell, and its starts and sizes are usable.
#include <gtest/gtest.h>
#include <udunits2.h>

#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

class EveryLaw : public testing::TestWithParam<std::shared_ptr<const Law>> {
 protected:
  const Law& law() const { return *GetParam(); }
  const Declaration& declared() const { return law().declaration(); }
};

std::string law_name(const testing::TestParamInfo<std::shared_ptr<const Law>>& info) {
  return info.param->declaration().name;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryLaw, testing::ValuesIn(all_laws()), law_name);

TEST_P(EveryLaw, DeclaresWhatAReaderNeeds) {
  EXPECT_EQ(declared().name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos);
  EXPECT_GT(declared().summary.size(), 10U);
  EXPECT_GT(declared().equation.size(), 5U);
  EXPECT_GT(declared().source.size(), 10U);
  EXPECT_FALSE(declared().places.empty());
  ASSERT_FALSE(declared().parameters.empty());
  for (const auto& parameter : declared().parameters) {
    EXPECT_FALSE(parameter.name.empty());
    EXPECT_GT(parameter.meaning.size(), 5U) << parameter.name;
  }
}

TEST_P(EveryLaw, HasDistinctParameterNamesThatAppearInItsEquation) {
  std::set<std::string> names;
  for (const auto& parameter : declared().parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_NE(declared().equation.find(parameter.name), std::string::npos) << parameter.name;
  }
}

TEST_P(EveryLaw, HasReadableUnits) {
  ut_set_error_message_handler(ut_ignore);
  const std::unique_ptr<ut_system, void (*)(ut_system*)> system(ut_read_xml(nullptr), ut_free_system);
  ASSERT_TRUE(system);
  for (const auto& parameter : declared().parameters) {
    for (const bool angular : {true, false}) {
      const std::string text = unit_at(parameter.unit, angular);
      const std::unique_ptr<ut_unit, void (*)(ut_unit*)> unit(ut_parse(system.get(), text.c_str(), UT_ASCII),
                                                              ut_free);
      EXPECT_TRUE(unit) << parameter.name << " [" << text << "]";
    }
  }
}

TEST_P(EveryLaw, HasNullValuesWithinItsBounds) {
  for (const auto& parameter : declared().parameters) {
    EXPECT_LT(parameter.lower, parameter.upper) << parameter.name;
    EXPECT_LE(parameter.lower, parameter.null_value) << parameter.name;
    EXPECT_GE(parameter.upper, parameter.null_value) << parameter.name;
    EXPECT_TRUE(parameter.scale == Scale::linear || parameter.lower > 0.0) << parameter.name;
  }
}

TEST_P(EveryLaw, HasFiniteTypicalSizesWhateverTheScales) {
  Scales zero{0, 0, 0, 0, 0, 0};
  const double nan = std::nan("");
  Scales broken{nan, nan, nan, nan, nan, nan};
  const double huge = std::numeric_limits<double>::infinity();
  Scales infinite{huge, huge, huge, huge, huge, huge};
  for (const Scales& scales : {test_scales(), Scales{}, zero, broken, infinite}) {
    const Values typical = law().typical(scales);
    ASSERT_EQ(typical.size(), declared().parameters.size());
    for (const double value : typical) {
      EXPECT_TRUE(std::isfinite(value));
      EXPECT_NE(value, 0.0);
    }
  }
}

TEST_P(EveryLaw, StartsWithinItsBounds) {
  for (const Scales& scales : {test_scales(), Scales{}, Scales{0, 0, 0, 0, 0, 0}}) {
    const auto starts = law().starts(scales);
    ASSERT_FALSE(starts.empty());
    for (const auto& start : starts) {
      ASSERT_EQ(start.size(), declared().parameters.size());
      for (std::size_t i = 0; i < start.size(); ++i) {
        EXPECT_GE(start[i], declared().parameters[i].lower) << declared().parameters[i].name;
        EXPECT_LE(start[i], declared().parameters[i].upper) << declared().parameters[i].name;
      }
    }
  }
}

TEST_P(EveryLaw, StartsAreDistinct) {
  const auto starts = law().starts(test_scales());
  EXPECT_EQ(std::set<Values>(starts.begin(), starts.end()).size(), starts.size());
}

TEST(Catalogue, HasUniqueNamesThatFindFinds) {
  const Catalogue catalogue = Catalogue::all();
  std::set<std::string> names;
  for (const auto& law : catalogue.laws()) {
    EXPECT_TRUE(names.insert(law->declaration().name).second) << law->declaration().name;
    EXPECT_EQ(catalogue.find(law->declaration().name), law);
  }
  EXPECT_EQ(names.size(), 52U);
  EXPECT_EQ(catalogue.find("no_such_effect"), nullptr);
}

TEST(Catalogue, WithoutLeavesOneOut) {
  const Catalogue fewer = Catalogue::all().without("coulomb");
  EXPECT_EQ(fewer.find("coulomb"), nullptr);
  EXPECT_NE(fewer.find("coulomb_directional"), nullptr);
  EXPECT_EQ(fewer.laws().size() + 1, Catalogue::all().laws().size());
}

TEST(Units, FollowThePlace) {
  EXPECT_EQ(unit_at("{force} s/{position}", true), "N m s/rad");
  EXPECT_EQ(unit_at("{force} s/{position}", false), "N s/m");
  EXPECT_EQ(unit_at("{force}/{position}^3", true), "N m/rad^3");
  EXPECT_EQ(unit_at("{inertia}", false), "kg");
}

}  // namespace
}  // namespace plumbline::effects
