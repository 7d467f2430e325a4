// A small catalogue for the reader's tests, independent of the project's own laws.
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "simulator/effects/catalogue.h"

namespace plumbline::test {

class DeclaredLaw final : public effects::Law {
 public:
  DeclaredLaw(effects::Declaration declaration, effects::Values start)
      : declaration_(std::move(declaration)), start_(std::move(start)) {}
  const effects::Declaration& declaration() const override { return declaration_; }
  effects::Values typical(const effects::Scales&) const override { return start_; }
  std::vector<effects::Values> starts(const effects::Scales&) const override { return {start_}; }

 private:
  effects::Declaration declaration_;
  effects::Values start_;
};

inline effects::Catalogue test_catalogue() {
  using effects::Parameter;
  using effects::Place;
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto law = [](const char* name, std::vector<Place> places, std::vector<Parameter> parameters,
                      effects::Values start) {
    effects::Declaration declaration;
    declaration.name = name;
    declaration.places = std::move(places);
    declaration.parameters = std::move(parameters);
    return std::make_shared<const DeclaredLaw>(declaration, std::move(start));
  };
  const auto parameter = [](const char* name, const char* unit, double null, double lower, double upper) {
    Parameter p;
    p.name = name;
    p.unit = unit;
    p.null_value = null;
    p.lower = lower;
    p.upper = upper;
    return p;
  };
  Parameter side = parameter("side", "1", 1, -1, 1);
  side.structural = true;
  return effects::Catalogue({
      law("drag", {Place::coordinate, Place::motor}, {parameter("damping", "{force} s/{position}", 0, 0, 10)},
          {0}),
      law("stop", {Place::coordinate},
          {parameter("stiffness", "{force}/{position}", 0, 0, inf),
           parameter("position", "{position}", 0, -inf, inf), side},
          {100, 0.1, -1}),
      law("stretch", {Place::ratio},
          {parameter("stiffness", "{force}/{position}", inf, 0, inf),
           parameter("damping", "{force} s/{position}", 0, 0, inf)},
          {inf, 0}),
      law("payload", {Place::body}, {parameter("mass", "kg", 0, -1, 5)}, {0}),
      law("gain", {Place::sensor}, {parameter("error", "1", 0, -0.5, 0.5)}, {0}),
      law("tilt", {Place::world}, {parameter("roll", "rad", 0, -1, 1)}, {0}),
  });
}

}  // namespace plumbline::test
