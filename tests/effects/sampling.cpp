#include "tests/effects/sampling.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline::effects {

Scales test_scales() {
  Scales scales;
  scales.position = 0.5;
  scales.velocity = 3.0;
  scales.force = 2.0;
  scales.inertia = 0.1;
  scales.period = 1e-3;
  scales.center = 0.2;
  return scales;
}

std::vector<std::shared_ptr<const Law>> all_laws() { return Catalogue::all().laws(); }

std::vector<std::shared_ptr<const ForceLaw>> force_laws() {
  std::vector<std::shared_ptr<const ForceLaw>> result;
  for (const auto& law : all_laws()) {
    if (auto force = std::dynamic_pointer_cast<const ForceLaw>(law)) result.push_back(force);
  }
  return result;
}

Values values_of(const Law& law, const std::vector<std::pair<std::string, double>>& given) {
  Values values = law.null_values();
  for (const auto& [name, value] : given) {
    const int index = law.parameter_index(name);
    if (index < 0) throw std::invalid_argument("no parameter " + name);
    values[static_cast<std::size_t>(index)] = value;
  }
  return values;
}

Values Sampler::parameters(const Law& law) {
  const auto starts = law.starts(test_scales());
  const auto pick = static_cast<std::size_t>(between(0, static_cast<double>(starts.size()) - 1e-9));
  Values values = starts[pick];
  const Values typical = law.typical(test_scales());
  const auto& declared = law.declaration().parameters;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (declared[i].structural) continue;
    const double size = typical[i] * between(0.2, 1.5);
    const double drawn = declared[i].lower < 0 ? sign() * size : size;
    values[i] = std::clamp(drawn, declared[i].lower, declared[i].upper);
  }
  return values;
}

Motion Sampler::motion() {
  const Scales scales = test_scales();
  Motion m;
  m.position = scales.center + 2.0 * scales.position * between(-1, 1);
  // Half of the velocities are slow, where friction laws bend.
  m.velocity = scales.velocity * between(-1, 1) * (between(0, 1) < 0.5 ? 0.05 : 2.0);
  m.load = scales.force * between(-1, 1);
  return m;
}

std::vector<double> Sampler::states(const Law& law, const Values& p) {
  std::vector<double> states(static_cast<std::size_t>(law.state_count()));
  for (auto& state : states) state = between(-1, 1);
  if (law.declaration().name == "lugre") {
    const auto value = [&](const char* name) {
      return p[static_cast<std::size_t>(law.parameter_index(name))];
    };
    states[0] *= (value("level") + value("rise")) / value("stiffness");
  }
  if (law.declaration().name == "slipping_coupling") {
    states[0] *= p[static_cast<std::size_t>(law.parameter_index("limit"))] /
                 p[static_cast<std::size_t>(law.parameter_index("stiffness"))];
  }
  if (law.declaration().name == "resonator") {
    states[0] /= 50.0;  // at 8 Hz the stretch whose speed is 1
  }
  return states;
}

}  // namespace plumbline::effects
