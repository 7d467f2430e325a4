// A sensor that does not round, or a record that was never rounded: `resolution: 0` is a statement, and the
// floor is then the noise alone.
#include <filesystem>

#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

class Unrounded : public ScratchFolder {
 protected:
  Trial with(const std::string& own) {
    std::filesystem::create_directories(folder / "swing");
    write_file(folder / "swing" / "data.csv", good_csv());
    write_file(folder / "swing" / "trial.yaml", replaced(good_trial(), "unit: deg}", own));
    return read_trial((folder / "swing").string(), robot);
  }
  static constexpr double kDegree = 3.14159265358979323846 / 180;
};

TEST_F(Unrounded, TheFloorIsTheNoiseAlone) {
  const Trial trial = with("unit: deg, resolution: {value: 0, unit: deg}, noise: {value: 0.1, unit: deg}}");
  EXPECT_NEAR(sensor_of(robot, trial.measured[0]).floor(), 0.1 * kDegree, 1e-15);
  EXPECT_EQ(as_recorded(robot, trial).sensors[0].resolution, 0.0);
}

// What the record does not state is the model's.
TEST_F(Unrounded, LeftOutItIsTheModelsResolution) {
  const Trial trial = with("unit: deg, noise: {value: 0, unit: deg}}");
  EXPECT_EQ(as_recorded(robot, trial).sensors[0].resolution, robot.sensors[0].resolution);
}

}  // namespace
}  // namespace plumbline::validation
