// Rendered frames against stored ones, and what must hold of any frame.
//
// The stored frames are pictures that a person has looked at. Another graphics driver shades and smooths a
// little differently, so they are held together by how different they look, not byte by byte. After a change
// on purpose: PLUMBLINE_WRITE_FRAMES=1 build/tests/render/test_render_frames, look at tests/render/frames,
// and keep them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/render/film.h"
#include "simulator/render/virtual_display.h"
#include "tests/render/example_motion.h"

namespace plumbline::render {
namespace {

// Of visible_difference(). Two renderings by one driver differ by 0; a leg that is a degree off changes the
// picture by more (tested below).
constexpr double kAlike = 2.0;

class Frames : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    unsetenv("DISPLAY");  // the same driver everywhere: Xvfb's
    display_ = new VirtualDisplay;
  }
  static void TearDownTestSuite() {
    delete display_;
    display_ = nullptr;
  }

  struct Robot {
    model::Model model;
    std::unique_ptr<model::Plant> plant;
    Figure figure;
    Motion motion;
    std::unique_ptr<Snapshots> snapshots;

    explicit Robot(const std::string& file, const contact::Terrain& terrain = {})
        : model(model::read_model(PLUMBLINE_ROOT "/robots/mabel/" + file, model::known_effects())),
          plant(std::make_unique<model::Plant>(model, std::vector<model::Lock>(), terrain)),
          figure(figure_of(model, model::read_visuals(model.skeleton.file))),
          motion(example_motion(*plant)),
          snapshots(std::make_unique<Snapshots>(*plant, motion)) {}
  };

  static FilmOptions options(Camera camera) {
    FilmOptions film;
    film.title = "MABEL";
    film.phase_names = {"I", "II"};
    film.camera = camera;
    film.width = 320;
    film.height = 180;
    film.to = 1.0;
    return film;
  }
  static Image frame(const Robot& robot, Camera camera, double time) {
    return Film(robot.figure, *robot.plant, *robot.snapshots, nullptr, options(camera)).frame(time);
  }

  static void expect_stored(const Image& image, const std::string& name) {
    const std::string file = PLUMBLINE_ROOT "/tests/render/frames/" + name + ".png";
    if (std::getenv("PLUMBLINE_WRITE_FRAMES") != nullptr) {
      write_png(image, file);
    }
    const double difference = visible_difference(image, read_png(file));
    EXPECT_LT(difference, kAlike) << name;
    if (difference >= kAlike) {
      const std::string found = (std::filesystem::temp_directory_path() / (name + "_found.png")).string();
      write_png(image, found);
      ADD_FAILURE() << "what was found: " << found;
    }
  }

  static VirtualDisplay* display_;
};

VirtualDisplay* Frames::display_ = nullptr;

TEST_F(Frames, StanceFromTheSide) {
  const Robot robot("mabel_planar.yaml");
  expect_stored(frame(robot, Camera::side, 0.0), "stance");
}

TEST_F(Frames, FlightFollowed) {
  const Robot robot("mabel_planar.yaml");
  expect_stored(frame(robot, Camera::follow, 1.0), "flight");
}

TEST_F(Frames, TheBoomFromAbove) {
  const Robot robot("mabel.yaml");
  expect_stored(frame(robot, Camera::boom, 0.2), "boom");
}

TEST_F(Frames, PlatformsAreThere) {
  const Robot robot("mabel_planar.yaml", contact::Terrain(0.0, {{-0.6, -0.15, 0.1}}));
  const Image with = frame(robot, Camera::side, 1.0);
  expect_stored(with, "platform");
  EXPECT_GT(visible_difference(with, frame(Robot("mabel_planar.yaml"), Camera::side, 1.0)), kAlike);
}

TEST_F(Frames, AStripOfStickFigures) {
  const Robot robot("mabel_planar.yaml");
  expect_stored(strip(robot.figure, *robot.plant, *robot.snapshots, 6, options(Camera::side)), "strip");
}

TEST_F(Frames, TheSameBytesTwice) {
  const Robot robot("mabel.yaml");
  EXPECT_EQ(frame(robot, Camera::boom, 0.4).rgb, frame(robot, Camera::boom, 0.4).rgb);
  FilmOptions film = options(Camera::side);
  Film one(robot.figure, *robot.plant, *robot.snapshots, nullptr, film);
  const Image first = one.frame(0.7);
  one.frame(0.1);
  EXPECT_EQ(one.frame(0.7).rgb, first.rgb);  // what was drawn in between leaves nothing behind
}

// A ghost that is where the model is is hidden by it; one that is a degree off shows.
TEST_F(Frames, GhostAndModelCoincideWhenTheyShould) {
  const Robot robot("mabel_planar.yaml");
  FilmOptions film = options(Camera::side);
  const auto without_key = [](const Image& image) {  // the ghost has a line in it, in the upper third
    Image cut(image.width, image.height * 2 / 3);
    std::copy(image.rgb.end() - static_cast<std::ptrdiff_t>(cut.rgb.size()), image.rgb.end(),
              cut.rgb.begin());
    return cut;
  };
  const Image alone =
      without_key(Film(robot.figure, *robot.plant, *robot.snapshots, nullptr, film).frame(0.5));
  Motion near = robot.motion;
  near.positions.array() += 1e-6;  // exactly the same place is not drawn at all
  const Snapshots ghost(*robot.plant, near);
  const Image same = without_key(Film(robot.figure, *robot.plant, *robot.snapshots, &ghost, film).frame(0.5));
  const double coinciding = visible_difference(alone, same);
  EXPECT_LT(coinciding, 0.3);  // where parts cut through each other a few pixels of the ghost show

  Motion moved = robot.motion;
  const std::vector<std::string> names = robot.plant->state_names();
  const auto torso = std::find(names.begin(), names.end(), "position of torso") - names.begin();
  moved.positions.row(torso).array() += 3.0 * M_PI / 180.0;
  const Snapshots other(*robot.plant, moved);
  const Image apart =
      without_key(Film(robot.figure, *robot.plant, *robot.snapshots, &other, film).frame(0.5));
  EXPECT_GT(visible_difference(alone, apart), 4.0 * coinciding);
}

// Faces that stand still would show their ghost where it lies in the same plane.
TEST_F(Frames, WhatDoesNotMoveHasNoGhost) {
  const Robot robot("mabel.yaml");
  const FilmOptions film = options(Camera::boom);
  const Image alone = Film(robot.figure, *robot.plant, *robot.snapshots, nullptr, film).frame(0.5);
  const Image ghost =
      Film(robot.figure, *robot.plant, *robot.snapshots, robot.snapshots.get(), film).frame(0.5);
  Image below(alone.width, alone.height / 2);  // without the key
  Image other = below;
  std::copy(alone.rgb.end() - static_cast<std::ptrdiff_t>(below.rgb.size()), alone.rgb.end(),
            below.rgb.begin());
  std::copy(ghost.rgb.end() - static_cast<std::ptrdiff_t>(other.rgb.size()), ghost.rgb.end(),
            other.rgb.begin());
  EXPECT_EQ(below.rgb, other.rgb);
}

TEST_F(Frames, StoredFramesWouldCatchALegThatIsOff) {
  Robot robot("mabel_planar.yaml");
  const Image right = frame(robot, Camera::side, 0.0);
  const std::vector<std::string> names = robot.plant->state_names();
  const auto knee = std::find(names.begin(), names.end(), "position of knee_right") - names.begin();
  robot.motion.positions.row(knee).array() += 0.25;
  EXPECT_GT(visible_difference(right, frame(robot, Camera::side, 0.0)), kAlike);
}

}  // namespace
}  // namespace plumbline::render
