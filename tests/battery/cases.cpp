#include "tests/battery/cases.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "contact/contact_law.h"
#include "contact/ground_turning.h"
#include "simulator/model/places.h"

namespace plumbline::battery {
namespace {

using effects::Place;

struct Removal {
  std::string effect, at;
  std::vector<std::string> laws;  ///< the effect and those that contain it
};

const std::vector<Removal>& leg_bench_removals() {
  static const std::vector<Removal> kRemovals{{"coulomb", "mLA", {"coulomb", "stribeck", "lugre"}},
                                              {"actuator_lag", "mLS", {"actuator_lag"}},
                                              {"cogging", "mLA", {"cogging"}},
                                              {"quadratic", "mLS", {"quadratic"}},
                                              {"backlash", "leg_shape", {"backlash"}}};
  return kRemovals;
}

void add_hidden(const std::string& robot, const std::vector<Row>& rows,
                const std::vector<Strength>& strengths, std::vector<Case>& cases) {
  for (const Row& row : rows) {
    for (const Strength strength : strengths) {
      cases.push_back(
          {robot + "/" + name_of(row) + "/" + to_string(strength), robot, Kind::hidden, strength, {row}, {}});
    }
  }
}

void add_none(const std::string& robot, int count, std::vector<Case>& cases) {
  for (int i = 1; i <= count; ++i) {
    cases.push_back({robot + "/none/" + std::to_string(i), robot, Kind::none, Strength::strong, {}, {}});
  }
}

const Row& find_row(const std::vector<Row>& rows, const std::string& name) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const Row& one) { return name_of(one) == name; });
  if (row == rows.end()) {
    throw std::logic_error("no row for " + name);
  }
  return *row;
}

void add_removed(const std::string& robot, const std::vector<Row>& rows, std::vector<Case>& cases) {
  for (const Removal& removal : leg_bench_removals()) {
    const std::string name = removal.effect + "@" + removal.at;
    cases.push_back({fmt::format("{}/removed/{}", robot, name),
                     robot,
                     Kind::removed,
                     Strength::strong,
                     {find_row(rows, name)},
                     removal.laws});
  }
}

void add_pairs(const std::string& robot, const std::vector<Row>& rows, const std::vector<Pair>& pairs,
               std::vector<Case>& cases) {
  for (const auto& [one, other] : pairs) {
    cases.push_back({fmt::format("{}/pair/{}+{}", robot, one, other),
                     robot,
                     Kind::pair,
                     Strength::medium,
                     {find_row(rows, one), find_row(rows, other)},
                     {}});
  }
}

void add_foreign(const std::string& robot, const std::vector<Row>& rows, std::vector<Case>& cases) {
  for (const Row& row : rows) {
    cases.push_back(
        {robot + "/foreign/" + row.effect + "@" + row.at, robot, Kind::foreign, Strength::strong, {row}, {}});
  }
}

/// Does the motor's angle alone fix this coordinate?
bool is_tied_to_motor(const model::Model& model, const std::string& coordinate) {
  const model::Ratio* ratio = model.find_ratio(coordinate);
  return ratio != nullptr && ratio->to.size() == 1 && model.find_motor(ratio->motor) != nullptr;
}

bool is_left_out(const model::Model& model, const effects::Law& law, Place place, const std::string& at) {
  if (place == Place::coordinate) {
    return law.sits_at(Place::motor) && is_tied_to_motor(model, at);
  }
  // The torso is the bench; spring and pulley bodies turn with the leg shape and the shin.
  return place == Place::body && (at == "torso" || at == "cspring" || at == "cshin");
}

}  // namespace

std::string name_of(const Row& row) { return row.effect + "@" + row.at; }

std::string to_string(Kind kind) {
  switch (kind) {
    case Kind::hidden:
      return "hidden";
    case Kind::none:
      return "none";
    case Kind::foreign:
      return "foreign";
    case Kind::pair:
      return "pair";
    case Kind::removed:
      break;
  }
  return "removed";
}

std::string to_string(Strength strength) {
  switch (strength) {
    case Strength::weak:
      return "weak";
    case Strength::medium:
      return "medium";
    case Strength::strong:
      break;
  }
  return "strong";
}

const std::vector<Robot>& robots() {
  static const std::string kMabel = "robots/mabel/";
  static const std::string kPendulum = "tests/robots/pendulum/";
  static const std::string kHopper = "robots/hopper/";
  static const std::string kCart = "tests/robots/cart/";
  static const std::vector<Robot> kRobots{
      {"leg_bench",
       kMabel + "leg_bench.yaml",
       {kMabel + "experiments/siso_mLA.yaml", kMabel + "experiments/siso_mLS.yaml",
        kMabel + "experiments/mimo.yaml"},
       ""},
      {"pendulum",
       kPendulum + "model.yaml",
       {kPendulum + "experiments/chirp.yaml", kPendulum + "experiments/steps.yaml",
        kPendulum + "experiments/multisine.yaml"},
       ""},
      {"pendulum_imu",
       kPendulum + "inertial.yaml",
       {kPendulum + "experiments/chirp.yaml", kPendulum + "experiments/steps.yaml",
        kPendulum + "experiments/multisine.yaml"},
       ""},
      {"hopper",
       kHopper + "hopper.yaml",
       {kHopper + "experiments/bounce.yaml", kHopper + "experiments/steps.yaml"},
       ""},
      {"mabel", kMabel + "mabel_planar.yaml", {}, kMabel + "scenarios/hopping.yaml"},
      {"cart",
       kCart + "model.yaml",
       {kCart + "experiments/noise.yaml", kCart + "experiments/pulses.yaml",
        kCart + "experiments/sines.yaml"},
       ""}};
  return kRobots;
}

const Robot& robot_of(const Case& one) {
  for (const Robot& robot : robots()) {
    if (robot.name == one.robot) {
      return robot;
    }
  }
  throw std::out_of_range("no robot " + one.robot);
}

std::vector<std::string> robots_of_rig(const std::string& rig) {
  const std::map<std::string, std::vector<std::string>> rigs{
      {"bench", {"leg_bench"}},
      {"pendulum", {"pendulum"}},
      {"inertial", {"pendulum_imu"}},
      {"hopper", {"hopper"}},
      {"mabel", {"mabel"}},
      {"sealed", {"cart"}},
      {"all", {"leg_bench", "pendulum", "pendulum_imu", "hopper"}}};
  const auto found = rigs.find(rig);
  if (found == rigs.end()) {
    throw std::invalid_argument("--rig: found '" + rig +
                                "', expected bench, pendulum, inertial, hopper, mabel, sealed or "
                                "all");
  }
  return found->second;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const std::vector<Strength> all{Strength::weak, Strength::medium, Strength::strong};
  add_hidden("leg_bench", leg_bench_rows(), all, cases);
  add_none("leg_bench", 10, cases);
  add_removed("leg_bench", leg_bench_rows(), cases);
  add_pairs("leg_bench", leg_bench_rows(), leg_bench_pairs(), cases);
  add_foreign("leg_bench", leg_bench_foreign_rows(), cases);
  add_hidden("pendulum", pendulum_rows(), all, cases);
  add_none("pendulum", 4, cases);
  add_foreign("pendulum", pendulum_foreign_rows(), cases);
  add_hidden("pendulum_imu", inertial_rows(), all, cases);
  add_none("pendulum_imu", 4, cases);
  add_hidden("hopper", hopper_rows(), all, cases);
  add_none("hopper", 6, cases);
  add_foreign("hopper", hopper_foreign_rows(), cases);
  add_hidden("mabel", mabel_rows(), all, cases);
  add_none("mabel", 4, cases);
  add_hidden("cart", cart_rows(), all, cases);
  add_none("cart", 4, cases);
  return cases;
}

std::vector<Row> expected_leg_bench_rows(const model::Model& model, const effects::Catalogue& catalogue) {
  std::vector<Row> expected;
  for (const auto& law : catalogue.laws()) {
    for (const Place place : law->declaration().places) {
      for (const std::string& at : model::places_of(model, *law, place)) {
        if (!is_left_out(model, *law, place, at)) {
          expected.push_back({law->declaration().name, at, ""});
        }
      }
    }
  }
  return expected;
}

std::vector<Row> expected_hopper_rows(const model::Model& model, const effects::Catalogue& catalogue) {
  std::vector<Row> expected;
  for (const auto& law : catalogue.laws()) {
    const std::string& name = law->declaration().name;
    const bool unseen = law->sits_at(Place::world) || name == "com_shift" || name == "payload" ||
                        name == "link_inertia" || name == "ground_friction_error" ||
                        name == "clock_drift";  // a controller is in the loop of one of its experiments
    const bool is_the_ground = dynamic_cast<const contact::NormalLaw*>(law.get()) != nullptr ||
                               dynamic_cast<const contact::TangentialLaw*>(law.get()) != nullptr ||
                               dynamic_cast<const contact::TurningLaw*>(law.get()) != nullptr;
    for (const Place place : law->declaration().places) {
      for (const std::string& at : model::places_of(model, *law, place)) {
        const bool motor_s =
            place == Place::coordinate && law->sits_at(Place::motor) && is_tied_to_motor(model, at);
        const bool stands_still = place == Place::body && at == "stand";
        if (!unseen && !is_the_ground && !motor_s && !stands_still) {
          expected.push_back({name, at, ""});
        }
      }
    }
  }
  return expected;
}

Case case_of(const std::string& name) {
  static const std::vector<Case> cases = all_cases();
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const Case& one) { return one.name == name; });
  if (found == cases.end()) {
    throw std::runtime_error("there is no case " + name);
  }
  return *found;
}

}  // namespace plumbline::battery
