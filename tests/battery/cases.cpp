#include "tests/battery/cases.h"

#include <algorithm>
#include <stdexcept>

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

void add_hidden(const std::string& robot, const std::vector<Row>& rows, std::vector<Case>& cases) {
  for (const Row& row : rows) {
    for (const Strength strength : {Strength::weak, Strength::strong}) {
      cases.push_back({robot + "/" + row.effect + "@" + row.at + "/" + to_string(strength),
                       robot,
                       Kind::hidden,
                       strength,
                       row,
                       {}});
    }
  }
}

void add_none(const std::string& robot, int count, std::vector<Case>& cases) {
  for (int i = 1; i <= count; ++i) {
    cases.push_back({robot + "/none/" + std::to_string(i), robot, Kind::none, Strength::strong, {}, {}});
  }
}

void add_removed(const std::string& robot, const std::vector<Row>& rows, std::vector<Case>& cases) {
  for (const Removal& removal : leg_bench_removals()) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& one) {
      return one.effect == removal.effect && one.at == removal.at;
    });
    if (row == rows.end()) {
      throw std::logic_error("no row for " + removal.effect + "@" + removal.at);
    }
    cases.push_back({robot + "/removed/" + row->effect + "@" + row->at, robot, Kind::removed,
                     Strength::strong, *row, removal.laws});
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

std::string to_string(Kind kind) {
  switch (kind) {
    case Kind::hidden:
      return "hidden";
    case Kind::none:
      return "none";
    case Kind::removed:
      break;
  }
  return "removed";
}

std::string to_string(Strength strength) { return strength == Strength::weak ? "weak" : "strong"; }

const std::vector<Robot>& robots() {
  static const std::string kMabel = "robots/mabel/";
  static const std::string kPendulum = "tests/robots/pendulum/";
  static const std::vector<Robot> kRobots{
      {"leg_bench",
       kMabel + "leg_bench.yaml",
       {kMabel + "experiments/siso_mLA.yaml", kMabel + "experiments/siso_mLS.yaml",
        kMabel + "experiments/mimo.yaml"}},
      {"pendulum",
       kPendulum + "model.yaml",
       {kPendulum + "experiments/chirp.yaml", kPendulum + "experiments/steps.yaml",
        kPendulum + "experiments/multisine.yaml"}}};
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

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  add_hidden("leg_bench", leg_bench_rows(), cases);
  add_none("leg_bench", 5, cases);
  add_removed("leg_bench", leg_bench_rows(), cases);
  add_hidden("pendulum", pendulum_rows(), cases);
  add_none("pendulum", 1, cases);
  return cases;
}

std::vector<Row> expected_leg_bench_rows(const model::Model& model, const effects::Catalogue& catalogue) {
  std::vector<Row> expected;
  for (const auto& law : catalogue.laws()) {
    for (const Place place : law->declaration().places) {
      for (const std::string& at : model.places(place)) {
        if (!is_left_out(model, *law, place, at)) {
          expected.push_back({law->declaration().name, at, ""});
        }
      }
    }
  }
  return expected;
}

}  // namespace plumbline::battery
