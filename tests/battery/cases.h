// What the battery tries: which effect is hidden where, how strong, and on which robot. Data only; nothing is
// simulated here.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::battery {

/// hidden: the effect is in the data and in the catalogue. none: nothing is in the data that the model does
/// not have. removed: the effect is in the data, but the catalogue knows neither it nor laws that contain it.
/// foreign: what is in the data is a law that only this test knows. pair: two effects of the catalogue.
enum class Kind { hidden, none, removed, foreign, pair };
std::string to_string(Kind kind);

enum class Strength { weak, medium, strong };
std::string to_string(Strength strength);

/// Files are relative to the project's root.
struct Robot {
  std::string name;
  std::string model;
  std::vector<std::string> experiments;
  std::string scenario;  ///< in place of experiments: a controller under which it hops, from drawn starts
};

/// One effect at one place. `parameters` reads "name=value,name=value" in SI units of the place. A value is
/// NUMBER, or WEAK|STRONG or WEAK|MEDIUM|STRONG when it differs between the strengths (medium, where it is
/// not given: the geometric mean); BASE+NUMBER or BASE-NUMBER adds a base that is never varied
/// ("scale=1+0.01|0.1", "rest=0.35-0.05").
struct Row {
  std::string effect, at, parameters;
};
std::string name_of(const Row& row);  ///< "coulomb@mLA"

struct Case {
  std::string name;   ///< "leg_bench/coulomb@mLA/weak"
  std::string robot;  ///< Robot::name
  Kind kind = Kind::hidden;
  Strength strength = Strength::strong;
  std::vector<Row> rows;             ///< what is hidden: none, one, or the two of a pair
  std::vector<std::string> removed;  ///< laws that this case takes out of the catalogue
};

const std::vector<Robot>& robots();
/// Throws std::out_of_range when the name is unknown.
const Robot& robot_of(const Case& one);

/// The tables.
const std::vector<Row>& leg_bench_rows();
const std::vector<Row>& pendulum_rows();
const std::vector<Row>& inertial_rows();
const std::vector<Row>& hopper_rows();
const std::vector<Row>& mabel_rows();
const std::vector<Row>& cart_rows();
/// Laws of foreign_laws.h.
const std::vector<Row>& leg_bench_foreign_rows();
const std::vector<Row>& pendulum_foreign_rows();
const std::vector<Row>& hopper_foreign_rows();

/// Names "effect@place" of two rows of the leg bench's table.
using Pair = std::pair<std::string, std::string>;
const std::vector<Pair>& leg_bench_pairs();

/// The robots of a rig: bench, pendulum, inertial, hopper, mabel, sealed or all (but mabel, which takes
/// minutes a case, and the sealed one, which is for releases). Throws std::invalid_argument for another name.
std::vector<std::string> robots_of_rig(const std::string& rig);

/// All cases in the order of the tables.
std::vector<Case> all_cases();

/// The one of this name among them. Throws std::runtime_error where there is none.
Case case_of(const std::string& name);

/// Pairs (effect, place) that belong into the leg bench's table: every law of the catalogue at every place
/// where it can sit, but a law that sits at motors is left out at coordinates that are rigidly a motor's, and
/// bodies that the bench hides behind rigid ratios (or that do not move) are left out.
std::vector<Row> expected_leg_bench_rows(const model::Model& model, const effects::Catalogue& catalogue);
/// The same for the hopper: nothing on it turns and its foot does not slip, so that a centre of mass, a small
/// tilt of gravity and the ground's friction move nothing; where a payload hangs does not show there, and its
/// mass alone is an added mass.
std::vector<Row> expected_hopper_rows(const model::Model& model, const effects::Catalogue& catalogue);

}  // namespace plumbline::battery
