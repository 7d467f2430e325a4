#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "tests/model/robot_texts.h"
#include "tests/model/test_laws.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class OverlayTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("arm.sdf", test::kSkeleton);
    base_ = folder_.write("model.yaml", test::kModel);
  }
  Model read(const std::string& path) const { return read_model(path, catalogue_); }
  void write(const std::string& path, const std::string& base, const std::vector<AddedEffect>& added,
             const std::vector<NewValue>& values, const std::string& note = "") const {
    write_overlay(path, base, added, values, note, catalogue_);
  }
  std::string refusal_of(const std::string& overlay) const {
    const std::string path = folder_.write("bad.yaml", "plumbline: model/1\nbase: model.yaml\n" + overlay);
    const std::string text = test::refusal([&] { read(path); });
    return text.substr(std::min(text.size(), path.size()));
  }

  effects::Catalogue catalogue_ = test::test_catalogue();
  test::TemporaryFolder folder_;
  std::string base_;
};

TEST_F(OverlayTest, WhatIsWrittenReadsBack) {
  const double inf = std::numeric_limits<double>::infinity();
  const double awkward = 0.1 + 0.2;
  const std::string path = folder_.path("fits/second/overlay.yaml");
  std::filesystem::create_directories(folder_.path("fits/second"));
  write(path, base_, {{"payload", "lower", {awkward}}, {"stretch", "rail", {inf, 0}}},
        {{"drag@mTip:damping", awkward, 0.01, "N m s/rad", "fit on \"a\"\nand: b # c"},
         {"payload@lower:mass", 1500, 0, "g", "scales"}},
        "added by: a test");
  const Model model = read(path);
  EXPECT_EQ(model.file, path);
  ASSERT_EQ(model.lineage.size(), 2U);
  EXPECT_TRUE(std::filesystem::equivalent(model.lineage[0], base_));
  EXPECT_EQ(model.lineage[1], path);
  ASSERT_EQ(model.effects.size(), 6U);
  EXPECT_EQ(model.effects[0].values[0].value, awkward);
  EXPECT_EQ(model.effects[0].values[0].uncertainty, 0.01);
  EXPECT_EQ(model.effects[0].values[0].source, "fit on \"a\"\nand: b # c");
  EXPECT_FALSE(model.effects[0].values[0].assumed);
  EXPECT_EQ(model.effects[4].label(), "payload at lower");
  EXPECT_EQ(model.effects[4].values[0].value, 1.5);
  EXPECT_THAT(model.effects[5].numbers(), ElementsAre(inf, 0.0));
  EXPECT_TRUE(model.effects[5].values[0].assumed);
  EXPECT_EQ(model.effects[5].values[0].source, "added by: a test");
}

TEST_F(OverlayTest, OverlaysStack) {
  const std::string first = folder_.path("first.yaml");
  const std::string second = folder_.path("second.yaml");
  write(first, base_, {{"drag", "rail", {2}}}, {});
  write(second, first, {}, {{"drag@rail:damping", 3, 0, "N s/m", "fit"}});
  const Model model = read(second);
  EXPECT_EQ(model.lineage.size(), 3U);
  EXPECT_EQ(model.effects.back().values[0].value, 3.0);
  EXPECT_EQ(read(first).effects.back().values[0].value, 2.0);
}

TEST_F(OverlayTest, ASecondEffectOfOneNameAtOnePlaceHasANumber) {
  const std::string path = folder_.path("o.yaml");
  write(path, base_, {},
        {{"stop@rail:stiffness", 7, 0, "N/m", "fit"}, {"stop@rail#2:stiffness", 8, 0, "N/m", "fit"}});
  const Model model = read(path);
  EXPECT_EQ(model.effects[1].values[0].value, 7.0);
  EXPECT_EQ(model.effects[2].values[0].value, 8.0);
}

TEST_F(OverlayTest, HoldsASecondEffectOfAKindWhenItSaysSo) {
  const std::string path = folder_.path("again.yaml");
  write(path, base_, {{"drag", "mTip", {0.7}, true}}, {{"drag@mTip#2:damping", 0.8, 0, "N m s/rad", "fit"}});
  const Model model = read(path);
  EXPECT_EQ(model.effects.back().label(), "drag at mTip");
  EXPECT_EQ(model.effects[0].label(), "drag at mTip");
  EXPECT_EQ(model.effects.back().values[0].value, 0.8);
}

TEST_F(OverlayTest, ReplacesTheSkeletonAndAddsSensors) {
  std::string heavier = test::kSkeleton;
  heavier.replace(heavier.find("<mass>4</mass>"), 14, "<mass>5</mass>");
  folder_.write("heavier.sdf", heavier);
  const std::string tip =
      "  tip_too: {measures: tip, counts_per_turn: 100, gear: 2, noise: {value: 0, unit: rad, assumed: a}, "
      "source: s}\n";
  const std::string path = folder_.write(
      "o.yaml", "plumbline: model/1\nbase: model.yaml\nskeleton: heavier.sdf\nsensors:\n" + tip);
  const Model given = read(base_);
  const Model model = read(path);
  EXPECT_EQ(given.skeleton.bodies[0].mass, 4.0);
  EXPECT_EQ(model.skeleton.bodies[0].mass, 5.0);
  ASSERT_EQ(model.sensors.size(), given.sensors.size() + 1);
  EXPECT_EQ(model.sensors.back().name, "tip_too");
  folder_.write("model_2.yaml", "plumbline: model/1\nbase: o.yaml\nsensors:\n" + tip);
  EXPECT_THAT(test::refusal([&] { read(folder_.path("model_2.yaml")); }),
              HasSubstr("model_2.yaml:4: sensors.tip_too: found sensor \"tip_too\", which the base has"));
}

TEST_F(OverlayTest, RefusesBadOverlays) {
  EXPECT_THAT(refusal_of("robot: x\n"), HasSubstr(":3: robot: found an unknown key, expected a known key"));
  EXPECT_THAT(
      refusal_of("values:\n  drag@mTop:damping: {value: 1, unit: N m s/rad, source: s}\n"),
      HasSubstr(":4: values.drag@mTop:damping: found an unknown value, expected effect@place:parameter of "
                "the model; did you mean drag@mTip:damping?"));
  EXPECT_THAT(refusal_of("values:\n  drag@mTip:damping: {value: 11, unit: N m s/rad, source: s}\n"),
              HasSubstr(":4: values.drag@mTip:damping.value: found 11 (SI), expected a value from 0 to 10"));
  EXPECT_THAT(refusal_of("effects:\n  - {effect: drag, at: mTip}\n"),
              HasSubstr(":4: effects.1: found drag at mTip twice"));
  EXPECT_THAT(refusal_of("effects:\n  - {effect: drag, at: mTip, again: 2}\n"),
              HasSubstr(":4: effects.1.again: found \"2\", expected true"));
  EXPECT_THAT(refusal_of("effects: {drag: 1}\n"), HasSubstr(":3: effects: found a map, expected a list"));
}

TEST_F(OverlayTest, RefusesBasesThatLeadNowhereOrBack) {
  folder_.write("a.yaml", "plumbline: model/1\nbase: b.yaml\n");
  folder_.write("b.yaml", "plumbline: model/1\nbase: ./a.yaml\n");
  EXPECT_THAT(test::refusal([&] { read(folder_.path("a.yaml")); }),
              HasSubstr("b.yaml:2: base: found \"./a.yaml\", which leads back to itself"));
  const std::string self = folder_.write("self.yaml", "plumbline: model/1\nbase: self.yaml\n");
  EXPECT_THAT(test::refusal([&] { read(self); }), HasSubstr("self.yaml:2: base: found"));
  const std::string lost = folder_.write("lost.yaml", "plumbline: model/1\nbase: nowhere.yaml\n");
  EXPECT_THAT(test::refusal([&] { read(lost); }),
              HasSubstr("lost.yaml:2: base: found \"nowhere.yaml\", where"));
}

TEST_F(OverlayTest, WritesNothingWhenTheOverlayWouldBeRefused) {
  const std::size_t files = folder_.file_count();
  const std::string path = folder_.path("o.yaml");
  EXPECT_THAT(test::refusal([&] {
                write(path, base_, {}, {{"drag@mTip:damping", 99, 0, "N m s/rad", "fit"}});
              }),
              HasSubstr("found 99 (SI)"));
  EXPECT_THAT(test::refusal([&] {
                write(path, base_, {{"drug", "mTip", {1}}}, {});
              }),
              HasSubstr("did you mean drag?"));
  EXPECT_THAT(test::refusal([&] {
                write(path, base_, {{"drag", "mTop", {1}}}, {});
              }),
              HasSubstr("did you mean mTip?"));
  EXPECT_THAT(test::refusal([&] { write(base_, base_, {}, {}); }), HasSubstr("found the base itself"));
  EXPECT_THROW(write(path, base_, {{"drag", "mRail", {1, 2}}}, {}), std::invalid_argument);
  EXPECT_EQ(folder_.file_count(), files);
  EXPECT_EQ(folder_.read("model.yaml"), test::kModel);
}

}  // namespace
}  // namespace plumbline::model
