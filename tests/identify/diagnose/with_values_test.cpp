// Setting the values that a search ended at.
#include <gtest/gtest.h>

#include "simulator/effects/parameters.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

model::Model pendulum() {
  return model::read_model("tests/robots/pendulum/model.yaml", effects::Catalogue::all());
}

int states(const model::Model& model) { return model::Plant(model, {}).states(); }

/// `effect` as on the command line; its searched parameters, and the values of which `name` is replaced.
struct Fitted {
  Fitted(const std::string& effect, const std::string& name, double value) : model(pendulum()) {
    model.effects.push_back(parse_effect(effect, model, effects::Catalogue::all()));
    const int last = static_cast<int>(model.effects.size()) - 1;
    parameters = free_parameters_of(model.effects.back(), last, {}, true);
    theta = values_of(model, parameters);
    const auto& declared = model.effects.back().law->declaration().parameters;
    for (Eigen::Index p = 0; p < theta.size(); ++p) {
      const auto own = static_cast<std::size_t>(parameters[static_cast<std::size_t>(p)].id.parameter);
      theta[p] = declared[own].name == name ? value : theta[p];
    }
  }
  model::Model after() const { return with_values(model, parameters, theta); }
  model::Model model;
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd theta;
};

// A search may end on the bound where play has no gap or a cable no stretch; the windows' initial states that
// it found have the motor's own position in them.
TEST(WithValues, KeepTheStatesOfALawThatHasBecomeNothing) {
  const Fitted play("backlash@shoulder:gap=0.01,stiffness=50,damping=0.1", "gap", 0.0);
  EXPECT_GT(states(play.model), states(pendulum()));
  EXPECT_EQ(states(play.after()), states(play.model));
  EXPECT_LT(play.after().effects.back().numbers().front(), 1e-4);
  const Fitted rigid("cable_stretch@shoulder:stiffness=50,damping=0.1", "stiffness", effects::kInfinity);
  EXPECT_EQ(states(rigid.after()), states(rigid.model));
  EXPECT_GT(rigid.after().effects.back().numbers().front(), 500.0);
}

TEST(WithValues, SetNothingWhereNoStateDependsOnIt) {
  const Fitted friction("coulomb@drive:level=0.1", "level", 0.0);
  EXPECT_EQ(friction.after().effects.back().numbers().front(), 0.0);
}

}  // namespace
}  // namespace plumbline::validation
