#include "validation/identify/closed_loop/reference.h"

#include "tests/identify/trial/fixture.h"

namespace plumbline::validation {
namespace {

constexpr const char* kGood = R"(plumbline: reference/1
values:
  - {compares: inverse_force, model: a, data: x.mat, value: 4.08, unit: "%", source: page 1}
  - {compares: closed_loop_position, model: b, data: y.mat, value: 0.0138, unit: "%", source: page 2}
)";

using ReferenceFile = ScratchFolder;

TEST_F(ReferenceFile, ValuesComeOutInPercent) {
  write_file(folder / "reference.yaml", kGood);
  const auto values = read_reference((folder / "reference.yaml").string());
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0].quantity, ReferenceValue::Quantity::inverse_force);
  EXPECT_NEAR(values[0].percent, 4.08, 1e-12);
  EXPECT_EQ(values[0].data, "x.mat");
  EXPECT_EQ(values[1].quantity, ReferenceValue::Quantity::closed_loop_position);
  EXPECT_NEAR(values[1].percent, 0.0138, 1e-12);
  EXPECT_EQ(values[1].model, "b");
  EXPECT_EQ(values[1].source, "page 2");
}

TEST_F(ReferenceFile, RefusesWhatItDoesNotKnow) {
  const auto message = [&](const std::string& what, const std::string& by) {
    write_file(folder / "reference.yaml", replaced(kGood, what, by));
    return input_error([&] { read_reference((folder / "reference.yaml").string()); });
  };
  EXPECT_NE(message("inverse_force", "inverse_forces").find("did you mean inverse_force?"),
            std::string::npos);
  EXPECT_NE(message("source: page 1", "remark: page 1").find("reference.yaml:3"), std::string::npos);
  EXPECT_NE(message("unit: \"%\"", "unit: m").find("reference.yaml:3"), std::string::npos);
  EXPECT_NE(message("reference/1", "reference/2").find("reference/1"), std::string::npos);
}

TEST_F(ReferenceFile, LiesBesideTheModel) {
  EXPECT_EQ(reference_beside((folder / "model.yaml").string()), "");
  write_file(folder / "reference.yaml", kGood);
  EXPECT_EQ(std::filesystem::path(reference_beside((folder / "model.yaml").string())),
            folder / "reference.yaml");
}

TEST(PublishedValues, OfTheRobotsAreReadable) {
  const auto values = read_reference(PLUMBLINE_ROOT "/robots/emps/reference.yaml");
  EXPECT_EQ(values.size(), 7U);
}

}  // namespace
}  // namespace plumbline::validation
