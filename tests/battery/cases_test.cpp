// Checks of the battery's table, without running any case: every case reads, its draws stay in bounds and
// differ, and no effect that can sit on the bench is forgotten. Prints what is wrong; exit status 1 then.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/battery/draw.h"
#include "tests/battery/foreign_laws.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::battery {
namespace {

class Checks {
 public:
  void expect(bool held, const std::string& what) {
    ++count_;
    if (!held) {
      ++failed_;
      fmt::print(stderr, "FAILED: {}\n", what);
    }
  }
  int finish() const {
    fmt::print("{} checks, {} failed\n", count_, failed_);
    return failed_ == 0 && count_ > 0 ? 0 : 1;
  }

 private:
  int count_ = 0, failed_ = 0;
};

std::string in_root(const std::string& file) { return std::string(PLUMBLINE_ROOT) + "/" + file; }

/// The use that the command line would make of what the case hides.
model::EffectUse use_of(const Case& one, const Row& row, const model::Model& model, std::uint64_t seed) {
  const effects::Catalogue all = every_law();
  Draw draw(one, seed);
  return validation::parse_effect(drawn_effect(row, one.strength, all, draw), with_foreign_places(model),
                                  all);
}

void check_hidden(const Case& one, const Row& row, const model::Model& model, Checks& checks) {
  const effects::Values a = use_of(one, row, model, 1).numbers();
  const effects::Values b = use_of(one, row, model, 2).numbers();
  const std::shared_ptr<const effects::Law> law = every_law().find(row.effect);
  checks.expect(!law->is_null(a.data()), one.name + " hides nothing");
  checks.expect(a != b, one.name + " draws the same values from different seeds");
  checks.expect(a == use_of(one, row, model, 1).numbers(),
                one.name + " draws different values from one seed");
  for (std::size_t p = 0; p < a.size(); ++p) {
    if (law->declaration().parameters[p].structural) {
      checks.expect(a[p] == b[p],
                    one.name + " draws the structural " + law->declaration().parameters[p].name);
    } else if (std::isfinite(a[p])) {
      // Both lie within 20 % of the nominal value, which may have a base that is not varied.
      const double ratio =
          std::max(std::abs(a[p]), std::abs(b[p])) / std::min(std::abs(a[p]), std::abs(b[p]));
      checks.expect(a[p] == b[p] || ratio < 1.5001, one.name + " draws too widely");
    }
  }
}

void check_removed(const Case& one, Checks& checks) {
  const effects::Catalogue all = effects::Catalogue::all();
  checks.expect(std::count(one.removed.begin(), one.removed.end(), one.rows.front().effect) == 1,
                one.name + " leaves its own effect in the catalogue");
  for (const std::string& law : one.removed) {
    checks.expect(all.find(law) != nullptr, one.name + " removes the unknown " + law);
  }
}

/// Models by the robot's name, each read once.
std::map<std::string, model::Model> read_models() {
  std::map<std::string, model::Model> models;
  for (const Robot& robot : robots()) {
    models[robot.name] = model::read_model(in_root(robot.model), model::known_effects());
  }
  return models;
}

void check_cases(const std::map<std::string, model::Model>& models, Checks& checks) {
  std::set<std::string> names;
  for (const Case& one : all_cases()) {
    try {
      checks.expect(names.insert(one.name).second, one.name + " is there twice");
      for (const Row& row : one.rows) {
        check_hidden(one, row, models.at(one.robot), checks);
      }
      checks.expect(one.rows.size() == (one.kind == Kind::none   ? 0U
                                        : one.kind == Kind::pair ? 2U
                                                                 : 1U),
                    one.name + " hides the wrong number of effects");
      if (one.kind == Kind::removed) {
        check_removed(one, checks);
      }
    } catch (const std::exception& error) {
      checks.expect(false, one.name + ": " + error.what());
    }
  }
}

void check_experiments(const std::map<std::string, model::Model>& models, Checks& checks) {
  for (const Robot& robot : robots()) {
    if (!robot.scenario.empty()) {
      checks.expect(std::filesystem::exists(in_root(robot.scenario)), robot.name + " lacks its scenario");
      continue;
    }
    bool train = false;
    bool held_out = false;
    for (const std::string& file : robot.experiments) {
      const validation::Role role = validation::read_experiment(in_root(file), models.at(robot.name)).role;
      (role == validation::Role::train ? train : held_out) = true;
    }
    checks.expect(train && held_out, robot.name + " lacks train or held-out experiments");
  }
}

void check_rows(const std::vector<Row>& rows, const std::vector<Row>& expected, Checks& checks) {
  const auto rows_of = [&](const std::string& effect, const std::string& at) {
    return std::count_if(rows.begin(), rows.end(),
                         [&](const Row& row) { return row.effect == effect && row.at == at; });
  };
  for (const Row& row : expected) {
    checks.expect(rows_of(row.effect, row.at) == 1,
                  "the table needs one row for " + row.effect + "@" + row.at);
  }
}

void check_complete(const model::Model& model, const model::Model& hopper, Checks& checks) {
  const effects::Catalogue all = effects::Catalogue::all();
  const std::vector<Row>& rows = leg_bench_rows();
  check_rows(rows, expected_leg_bench_rows(model, all), checks);
  check_rows(hopper_rows(), expected_hopper_rows(hopper, model::known_effects()), checks);
  for (const auto& law : all.laws()) {
    const std::string& name = law->declaration().name;
    const auto has_row = [&](const std::vector<Row>& some) {
      return std::any_of(some.begin(), some.end(), [&](const Row& row) { return row.effect == name; });
    };
    checks.expect(has_row(rows) || has_row(hopper_rows()) || has_row(inertial_rows()) ||
                      (law->sits_at(effects::Place::base) && has_row(mabel_rows())),
                  "no rig of the battery has a row for " + name);
  }
}

}  // namespace
}  // namespace plumbline::battery

int main() {
  try {
    plumbline::battery::Checks checks;
    const auto models = plumbline::battery::read_models();
    plumbline::battery::check_experiments(models, checks);
    plumbline::battery::check_cases(models, checks);
    plumbline::battery::check_complete(models.at("leg_bench"), models.at("hopper"), checks);
    return checks.finish();
  } catch (const std::exception& error) {
    fmt::print(stderr, "FAILED: {}\n", error.what());
    return 1;
  }
}
