#include "validation/studies/spring_mass/leg_placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "simulator/trace/error.h"
#include "validation/studies/spring_mass/sensitivity.h"

namespace plumbline::spring_mass {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

/// The scan of the thesis with fewer splays: the steady gait needs those about straight on only.
const Behaviour& scanned() {
  static const Behaviour behaviour = [] {
    Grid grid;
    grid.splays = 9;
    Behaviour made(Body{}, grid);
    made.scan();
    return made;
  }();
  return behaviour;
}

double steady_error(const Disturbance& disturbance) {
  static const DeadbeatLaw law(scanned(), 1.1);
  TrailSettings settings;
  settings.straight = true;
  settings.steps = 80;
  settings.first_apex = 1.1;
  settings.disturbance = disturbance;
  const Trail trail = run_trail(law, Tiles::flat(), settings);
  EXPECT_EQ(trail.ending, Ending::apex);
  return 100.0 * trail.last_apex_error();
}

// Wu 2017, table 3.1, first column. Half a unit of the print is 0.05; two cells are 0.06 and 0.07 off.
TEST(LegPlacement, SteadyErrorsAreThoseOfTheThesis) {
  EXPECT_NEAR(steady_error({}), -0.3, 0.05);
  Disturbance softer, stiffer, flatter, later;
  softer.stiffness = -0.10;
  EXPECT_NEAR(steady_error(softer), -7.5, 0.06);
  stiffer.stiffness = 0.10;
  EXPECT_NEAR(steady_error(stiffer), 7.2, 0.06);
  flatter.attack = -2.0 * degree;
  EXPECT_NEAR(steady_error(flatter), 10.9, 0.06);
  later.delay = 0.030;
  EXPECT_NEAR(steady_error(later), 9.3, 0.06);
}

TEST(LegPlacement, EnergyRowsAreThoseOfElevenCentimetresOfGround) {
  const Body body;
  Disturbance higher, lower;
  higher.energy = -body.mass * body.gravity * 0.11 / body.energy;
  lower.energy = -higher.energy;
  EXPECT_NEAR(steady_error(higher), 5.9, 0.06);
  EXPECT_NEAR(steady_error(lower), -4.2, 0.06);
}

TEST(LegPlacement, TheLargestTurnInSteadyRunningIsThatOfTheThesis) {
  // Section 3.2.2: 74 degrees, with a splay of 20 degrees. Between the two apexes of the scan about 1.1 m.
  const DeadbeatLaw law(scanned(), 1.1);
  int k = 0;
  while (scanned().apex(k + 1) < 1.1) {
    ++k;
  }
  const std::optional<Placement> below = law.at(k, 170.0 * degree), above = law.at(k + 1, 170.0 * degree);
  ASSERT_TRUE(below && above);
  EXPECT_NEAR(below->deflection / degree, 74.0, 1.0);
  EXPECT_NEAR(std::abs(below->leg.splay) / degree, 20.0, 0.5);
  EXPECT_GT(above->deflection, below->deflection);
}

TEST(LegPlacement, ATableOfTurnsFallsShortWhereItsLastEntryIs) {
  const DeadbeatLaw law(scanned(), 1.1);
  const double step = 10.0 * degree, time = std::sqrt(2.0 * (1.1 - std::sin(46.0 * degree)) / 9.81);
  const PolicyTable table(law, step);
  // At an entry it is the law itself; to the other side it is the mirror image.
  const Placement there = table.at(time, -20.0 * degree), law_there = TimeLaw(law, -20.0 * degree).at(time);
  EXPECT_NEAR(there.leg.attack, law_there.leg.attack, 1e-9);
  EXPECT_NEAR(there.leg.splay, law_there.leg.splay, 1e-9);
  EXPECT_NEAR(table.at(time, 20.0 * degree).leg.splay, -there.leg.splay, 1e-12);
  // Beyond the limit the leg is that of an entry within it, and the turn that was wanted is the limit's.
  const Placement sharp = table.at(time, 120.0 * degree), limit = TimeLaw(law, 120.0 * degree).at(time);
  EXPECT_NEAR(sharp.deflection, limit.deflection, 1e-9);
  const double entry = step * std::floor(limit.deflection / step);
  EXPECT_NEAR(sharp.leg.attack, table.at(time, entry).leg.attack, 1e-9);
  EXPECT_GT(sharp.leg.attack, limit.leg.attack);
}

TEST(LegPlacement, RoughGroundOfTwentyFiveCentimetresIsRunOver) {
  const DeadbeatLaw law(scanned(), 1.1);
  TrailSettings settings;
  settings.law = LawKind::constrained;
  settings.steps = 60;
  const Trail trail = run_trail(law, Tiles(1.0, 0.125, 3), settings);
  EXPECT_EQ(trail.ending, Ending::apex);
  EXPECT_LT(trail.worst_apex(), 0.20);
}

TEST(LegPlacement, AScanIsKeptAndRecalled) {
  const std::string file = testing::TempDir() + "behaviour.bin";
  scanned().keep(file);
  Grid grid;
  grid.splays = 9;
  Behaviour again(Body{}, grid);
  ASSERT_TRUE(again.recall(file));
  EXPECT_EQ(again.next_apex(10, 3, 60), scanned().next_apex(10, 3, 60));
  Body heavier;
  heavier.mass = 81.0;
  Behaviour other(heavier, grid);
  EXPECT_FALSE(other.recall(file)) << "of another model";
  std::remove(file.c_str());
}

TEST(LegPlacement, ThePublishedTableIsReadAndHeldAgainst) {
  const auto table = read_published_table(PLUMBLINE_ROOT "/robots/atrias/wu_table_3_1.csv");
  ASSERT_EQ(table.size(), 17U);
  EXPECT_DOUBLE_EQ(table[1].cells[0][0], 15.2);
  EXPECT_TRUE(std::isnan(table[16].cells[2][0]));
  EXPECT_EQ(verdict({5.94, 5.0, 7.0, 0}, 5.9), "=");
  EXPECT_EQ(verdict({6.20, 5.0, 7.0, 0}, 5.9), "~");
  EXPECT_EQ(verdict({6.20, 6.1, 7.0, 0}, 5.9), "x");
  const std::string file = testing::TempDir() + "table.csv";
  std::ofstream(file) << "head\nE,-10%,1,2\n";
  EXPECT_THROW(read_published_table(file), InputError);
}

TEST(LegPlacement, AGridOfOneIsRefused) {
  Grid grid;
  grid.attacks = 1;
  EXPECT_THROW(Behaviour(Body{}, grid), InputError);
}

}  // namespace
}  // namespace plumbline::spring_mass
