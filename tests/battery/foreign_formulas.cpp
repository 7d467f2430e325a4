#include "tests/battery/foreign_formulas.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "simulator/effects/parameters.h"

namespace plumbline::battery {
namespace {

using effects::Declaration;
using effects::Motion;
using effects::Place;
using effects::Values;

/// Force of a place from its motion, one state at most and the parameters.
struct ForceFormula {
  std::function<double(const Motion&, double state, const double* p)> force;
  std::function<double(const Motion&, double state, const double* p)> state_rate;
};

/// What these laws share: no search ever begins at them.
template <class Kind>
class Foreign : public Kind {
 public:
  explicit Foreign(Declaration declaration) : declaration_(std::move(declaration)) {}
  const Declaration& declaration() const override { return declaration_; }
  Values typical(const effects::Scales& /*scales*/) const override { return this->null_values(); }
  std::vector<Values> starts(const effects::Scales& /*scales*/) const override {
    return {this->null_values()};
  }

 private:
  Declaration declaration_;
};

class FormulaForce final : public Foreign<effects::ForceLaw> {
 public:
  FormulaForce(Declaration declaration, ForceFormula formula)
      : Foreign(std::move(declaration)), formula_(std::move(formula)) {}
  double force(const Motion& m, const double* state, const double* p) const override {
    return formula_.force(m, state_count() > 0 ? state[0] : 0.0, p);
  }
  void state_rate(const Motion& m, const double* state, const double* p, double* rate) const override {
    if (state_count() > 0) {
      rate[0] = formula_.state_rate(m, state[0], p);
    }
  }

 private:
  ForceFormula formula_;
};

struct TorqueFormula {
  std::function<double(double command, double state, const double* p)> torque;
  std::function<double(double command, double state, const double* p)> state_rate;
};

class FormulaTorque final : public Foreign<effects::ActuatorLaw> {
 public:
  FormulaTorque(Declaration declaration, TorqueFormula formula)
      : Foreign(std::move(declaration)), formula_(std::move(formula)) {}
  double torque(double commanded, const double* state, const double* p) const override {
    return formula_.torque(commanded, state_count() > 0 ? state[0] : 0.0, p);
  }
  void state_rate(double commanded, const double* state, const double* p, double* rate) const override {
    if (state_count() > 0) {
      rate[0] = formula_.state_rate(commanded, state[0], p);
    }
  }

 private:
  TorqueFormula formula_;
};

Declaration declare(const std::string& name, const std::string& summary, const std::string& equation,
                    Place place, std::vector<effects::Parameter> parameters,
                    std::vector<std::string> states = {}) {
  return {name, summary, equation, "test only", {place}, std::move(parameters), std::move(states), ""};
}

effects::Parameter strength(const std::string& name) { return effects::any(name, "1", "strength"); }

using Laws = std::vector<std::shared_ptr<const effects::Law>>;

void add_frictions(Laws& laws) {
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("sticky_spot", "friction at one place of the way only",
              "f = -level*exp(-((x - centre)/width)^2)*tanh(v/speed)", Place::coordinate,
              {strength("level"), effects::fixed("centre", "rad", "middle", 0.0, -10.0, 10.0),
               effects::fixed("width", "rad", "half width", 0.05, 1e-4, 10.0),
               effects::fixed("speed", "rad/s", "smoothing", 0.001, 1e-6, 10.0)}),
      ForceFormula{[](const Motion& m, double, const double* p) {
                     return -p[0] * std::exp(-std::pow((m.position - p[1]) / p[2], 2)) *
                            std::tanh(m.velocity / p[3]);
                   },
                   nullptr}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("drying_bearing", "viscous friction that grows over the trial",
              "f = -damping*age*v; age_rate = 1", Place::motor, {strength("damping")}, {"age"}),
      ForceFormula{[](const Motion& m, double age, const double* p) { return -p[0] * age * m.velocity; },
                   [](const Motion&, double, const double*) { return 1.0; }}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("pressing_friction", "viscous friction that depends on the position",
              "f = -damping*(1 + cos(waves*x))*v", Place::motor,
              {strength("damping"), effects::fixed("waves", "1/rad", "per radian", 0.5, 0.0, 100.0)}),
      ForceFormula{[](const Motion& m, double, const double* p) {
                     return -p[0] * (1.0 + std::cos(p[1] * m.position)) * m.velocity;
                   },
                   nullptr}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare(
          "eddy_brake", "a brake of eddy currents, which lets go above its best speed",
          "f = -2*peak*u/(1 + u^2), u = v/speed", Place::motor,
          {strength("peak"), effects::fixed("speed", "rad/s", "at which it brakes most", 10.0, 1e-3, 1e4)}),
      ForceFormula{[](const Motion& m, double, const double* p) {
                     const double u = m.velocity / p[1];
                     return -2.0 * p[0] * u / (1.0 + u * u);
                   },
                   nullptr}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("thickening_oil", "drag with the fourth power of the speed", "f = -drag*|v|^3*v", Place::motor,
              {strength("drag")}),
      ForceFormula{[](const Motion& m, double, const double* p) {
                     return -p[0] * std::pow(std::abs(m.velocity), 3) * m.velocity;
                   },
                   nullptr}));
}

void add_elasticities(Laws& laws) {
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("relaxing_spring", "a spring whose other end creeps",
              "f = -stiffness*(x - end); end_rate = (x - end)/time", Place::coordinate,
              {strength("stiffness"), effects::fixed("time", "s", "of creep", 0.1, 1e-3, 10.0)}, {"end"}),
      ForceFormula{[](const Motion& m, double end, const double* p) { return -p[0] * (m.position - end); },
                   [](const Motion& m, double end, const double* p) { return (m.position - end) / p[1]; }}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("detent", "a notch that pulls the joint to one position",
              "f = -force*u*exp(0.5 - u^2/2), u = (x - centre)/width", Place::coordinate,
              {strength("force"), effects::fixed("centre", "rad", "of the notch", 0.0, -10.0, 10.0),
               effects::fixed("width", "rad", "of the notch", 0.03, 1e-4, 1.0)}),
      ForceFormula{[](const Motion& m, double, const double* p) {
                     const double u = (m.position - p[1]) / p[2];
                     return -p[0] * u * std::exp(0.5 - 0.5 * u * u);
                   },
                   nullptr}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("two_waves", "a ripple of two frequencies that are no multiples of each other",
              "f = force*(sin(7.3*x) + cos(17.9*x))", Place::motor, {strength("force")}),
      ForceFormula{[](const Motion& m, double, const double* p) {
                     return p[0] * (std::sin(7.3 * m.position) + std::cos(17.9 * m.position));
                   },
                   nullptr}));
}

/// Of the hopper: its ground and its rail.
void add_grounds_and_rails(Laws& laws) {
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("fading_ground", "a ground that gets softer over the trial",
              "f = -share*min(age/time, 1)*stiffness*max(ground - x, 0)^1.5; age_rate = 1", Place::coordinate,
              {effects::any("share", "1", "of the stiffness that is lost in the end"),
               effects::positive("stiffness", "N/m^1.5", "of the ground at first", 2e6),
               effects::positive("time", "s", "after which it is lost", 4.0),
               effects::fixed("ground", "m", "x where the foot touches", 0.4, 0.0, 10.0)},
              {"age"}),
      ForceFormula{[](const Motion& m, double age, const double* p) {
                     return -p[0] * std::min(age / p[2], 1.0) * p[1] *
                            std::pow(std::max(p[3] - m.position, 0.0), 1.5);
                   },
                   [](const Motion&, double, const double*) { return 1.0; }}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("warming_friction", "friction that grows with the heat it makes",
              "f = -level*(1 + heat)*tanh(v/0.003); heat_rate = gain*|v|", Place::coordinate,
              {effects::non_negative("level", "{force}", "friction when cold"),
               effects::non_negative("gain", "1/{position}", "rise for each metre of way")},
              {"heat"}),
      ForceFormula{[](const Motion& m, double heat, const double* p) {
                     return -p[0] * (1.0 + heat) * std::tanh(m.velocity / 0.003);
                   },
                   [](const Motion& m, double, const double* p) { return p[1] * std::abs(m.velocity); }}));
  laws.push_back(std::make_shared<const FormulaForce>(
      declare("rail_magnets", "a force that repeats along the way", "f = amplitude*sin(2*pi*x/pitch)",
              Place::coordinate,
              {effects::any("amplitude", "{force}", "largest force"),
               effects::fixed("pitch", "{position}", "way after which it repeats", 0.02, 1e-4, 1.0)}),
      ForceFormula{[](const Motion& m, double, const double* p) {
                     return p[0] * std::sin(2.0 * effects::kPi * m.position / p[1]);
                   },
                   nullptr}));
}

void add_actuators(Laws& laws) {
  laws.push_back(std::make_shared<const FormulaTorque>(
      declare("coarse_converter", "an amplifier that knows a few values only, with a soft edge between them",
              "torque = u - step/(2*pi)*sin(2*pi*u/step)", Place::motor, {strength("step")}),
      TorqueFormula{[](double u, double, const double* p) {
                      return p[0] > 0.0
                                 ? u - p[0] / (2.0 * effects::kPi) * std::sin(2.0 * effects::kPi * u / p[0])
                                 : u;
                    },
                    nullptr}));
  laws.push_back(std::make_shared<const FormulaTorque>(
      declare(
          "slewing_amplifier", "an amplifier that follows no faster than so much in a second",
          "torque = given; given_rate = rate*tanh((u - given)/band)", Place::motor,
          {strength("rate"), effects::fixed("band", "N m", "in which it follows as a lag", 0.01, 1e-6, 10.0)},
          {"given"}),
      TorqueFormula{
          [](double u, double given, const double* p) { return p[0] > 0.0 ? given : u; },
          [](double u, double given, const double* p) { return p[0] * std::tanh((u - given) / p[1]); }}));
  laws.push_back(std::make_shared<const FormulaTorque>(
      declare("dead_zone", "an amplifier that swallows small commands", "torque = u - zone*tanh(u/zone)",
              Place::motor, {strength("zone")}),
      TorqueFormula{
          [](double u, double, const double* p) { return p[0] > 0.0 ? u - p[0] * std::tanh(u / p[0]) : u; },
          nullptr}));
  laws.push_back(std::make_shared<const FormulaTorque>(
      declare("uneven_bridge", "an amplifier stronger one way than the other", "torque = u + share*|u|",
              Place::motor, {strength("share")}),
      TorqueFormula{[](double u, double, const double* p) { return u + p[0] * std::abs(u); }, nullptr}));
}

}  // namespace

Laws foreign_laws() {
  Laws laws;
  add_frictions(laws);
  add_elasticities(laws);
  add_actuators(laws);
  add_grounds_and_rails(laws);
  return laws;
}

}  // namespace plumbline::battery
