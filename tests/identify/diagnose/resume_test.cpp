// A diagnosis that was interrupted, gone on with from its kept results.
#include <gmock/gmock.h>

#include <memory>

#include "tests/identify/diagnose/bench.h"
#include "tests/trace/temporary_folder.h"
#include "validation/identify/predict/kept_keys.h"
#include "validation/report/result_json.h"

namespace plumbline::validation {
namespace {

using testing::HasSubstr;

/// Laws with and without starts of their own, and a hidden one with a state.
class Resume : public testing::Test {
 protected:
  Resume() : data(bench_twins({"actuator_lag@mLS:time_constant=0.002"}).thinned(6)) {}

  std::string diagnosed(const Progress& progress) const {
    const effects::Catalogue laws = some_laws({"actuator_lag", "command_delay", "stribeck", "coulomb"});
    return to_json(diagnose(bench(), laws, data, {}, progress), {}).dump();
  }

  void open() {
    data.kept = nullptr;  // one at a time
    data.kept = std::make_shared<KeptResults>(folder.path("results.txt"), "inputs");
  }

  test::TemporaryFolder folder;
  Data data;
};

TEST_F(Resume, EndsAsIfItHadNotBeenInterrupted) {
  const std::string expected = diagnosed(silent);
  ASSERT_THAT(expected, HasSubstr("\"verdict\":\"missing\""));
  open();
  StopFlag stop;
  data.stop = &stop;
  const auto stop_while_refitting = [&](const std::string& what, double /*fraction*/) {
    stop.raised = stop.raised || what.rfind("refitting", 0) == 0;
  };
  EXPECT_THAT(diagnosed(stop_while_refitting), HasSubstr("\"interrupted\":true"));
  stop.raised = false;
  open();
  EXPECT_GT(data.kept->found(), 5U);
  EXPECT_EQ(diagnosed(silent), expected);
}

TEST_F(Resume, SearchesNothingTwice) {
  open();
  const std::string first = diagnosed(silent);
  const std::string kept = folder.read("results.txt");
  open();
  EXPECT_EQ(diagnosed(silent), first);
  EXPECT_EQ(folder.read("results.txt"), kept);
}

/// A result is found again for nothing but the same work.
TEST_F(Resume, EveryChangeOfTheWorkIsAnotherKey) {
  const model::Model model = bench();
  const std::string key = key_of("work", model, data).hash();
  EXPECT_EQ(key_of("work", bench(), data).hash(), key);
  EXPECT_NE(key_of("other", model, data).hash(), key);

  model::Model other = model;
  other.effects.front().values.front().value *= 1.0 + 1e-15;
  EXPECT_NE(key_of("work", other, data).hash(), key);
  other = model;
  other.effects.pop_back();
  EXPECT_NE(key_of("work", other, data).hash(), key);

  Data changed = data;
  changed.predict.most_steps = 10.0;
  EXPECT_NE(key_of("work", model, changed).hash(), key);
  EXPECT_NE(key_of("work", model, data.thinned(5)).hash(), key);
  EXPECT_NE(key_of("work", model, data.beginnings(0.5)).hash(), key);
}

TEST_F(Resume, EveryChangeOfAFreeParameterIsAnotherKey) {
  const auto hash = [](const FreeParameter& one) {
    ResultKey key{"work"};
    add_parameters({one}, key);
    return key.hash();
  };
  const FreeParameter given;
  std::vector<FreeParameter> others(8, given);
  others[0].id.effect = 1;
  others[1].id.parameter = 1;
  others[2].scale = effects::Scale::logarithm;
  others[3].lower = -1.0;
  others[4].upper = 1.0;
  others[5].mean = 1.0;
  others[6].deviation = 1.0;
  others[7].also = {{2, 0}};
  for (const FreeParameter& other : others) {
    EXPECT_NE(hash(other), hash(given));
  }
}

}  // namespace
}  // namespace plumbline::validation
