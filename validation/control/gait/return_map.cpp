#include "validation/control/gait/return_map.h"

#include <Eigen/QR>
#include <algorithm>
#include <deque>
#include <stdexcept>

#include "simulator/model/plain_number.h"
#include "simulator/run/ends.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;

constexpr std::size_t kHistory = 32;                                   // samples, as long as any rate filter
constexpr std::size_t kAveraged = 10;                                  // passages
constexpr double kPosition = 1e-3, kVelocity = 1e-2, kContact = 1e-5;  // smallest steps, SI

/// Where a run passes the section.
struct Passage {
  Eigen::VectorXd state;       // of the plant, interpolated between two samples
  Eigen::MatrixXd history;     // states at the samples before, one a column, oldest first, less `state`
  std::vector<double> memory;  // all of the controller's
};

/// Follows a run sample by sample and finds its passages.
class PassageFinder {
 public:
  PassageFinder(const PoincareSection& section, run::SampledRun& sampled)
      : section_(section), past_{sampled.simulation().state()} {}

  /// After each sample; a passage lies between this sample and the one before.
  std::optional<Passage> look(run::SampledRun& sampled) {
    const Eigen::VectorXd state = sampled.simulation().state();
    const model::Plant& plant = sampled.plant();
    const double value = (section_.rate ? plant.velocity_of(section_.position, state.data())
                                        : plant.position_of(section_.position, state.data())) -
                         section_.level;
    const double sign = section_.falling ? 1.0 : -1.0;
    const bool here = !section_.in_flight || !touching(sampled);
    const bool passed = known_ && here && sign * value <= 0.0 && sign * value_ > 0.0;
    const double share = passed ? value_ / (value_ - value) : 0.0;  // of the sample
    value_ = value;
    known_ = true;
    past_.push_back(state);
    if (past_.size() > kHistory + 2) {
      past_.pop_front();
    }
    if (!passed || past_.size() < kHistory + 2) {
      return std::nullopt;
    }
    return make(sampled, share);
  }

 private:
  static bool touching(const run::SampledRun& sampled) {
    const auto& touches = sampled.simulation().touches();
    return std::any_of(touches.begin(), touches.end(),
                       [](const model::Touch& touch) { return touch.depth > 0.0; });
  }

  Passage make(run::SampledRun& sampled, double share) const {
    const auto between = [&](std::size_t i) -> Eigen::VectorXd {
      return (1.0 - share) * past_[i] + share * past_[i + 1];
    };
    Passage passage;
    passage.state = between(kHistory);
    passage.history.resize(passage.state.size(), static_cast<Eigen::Index>(kHistory));
    for (std::size_t i = 0; i < kHistory; ++i) {
      passage.history.col(static_cast<Eigen::Index>(i)) = between(i) - passage.state;
    }
    if (sampled.controller() != nullptr) {
      passage.memory = sampled.controller()->memory();
    }
    return passage;
  }

  const PoincareSection& section_;
  std::deque<Eigen::VectorXd> past_;
  double value_ = 0.0;
  bool known_ = false;
};

/// Until the given number of passages, or the end.
std::vector<Passage> passages_of(run::SampledRun& sampled, const PoincareSection& section,
                                 const run::Scenario& scenario, std::size_t count, std::string& end,
                                 const StopFlag* stop) {
  std::vector<Passage> passages;
  run::EndWatch watch(scenario.ends, sampled.controller());
  sampled.sample();
  PassageFinder finder(section, sampled);
  while (passages.size() < count && end.empty()) {
    if (stop != nullptr && stop->raised) {
      throw Stopped();
    }
    sampled.advance();
    sampled.sample();
    if (auto passage = finder.look(sampled)) {
      passages.push_back(*passage);
    }
    end = watch.look(sampled.simulation());
    if (end.empty() && sampled.simulation().time() > scenario.longest) {
      end = "the scenario's length";
    }
  }
  return passages;
}

/// Index of a memory of the controller; the section's names were checked when it was read.
std::size_t memory_index(const run::ControllerSetup& setup, const std::string& name) {
  const auto ports = setup.library.memory();
  for (std::size_t m = 0; m < ports.size(); ++m) {
    if (ports[m].name == name) {
      return m;
    }
  }
  throw std::invalid_argument(name + " is no memory of the controller");
}

int sensor_of(const model::Model& model, const std::string& position) {
  for (std::size_t s = 0; s < model.sensors.size(); ++s) {
    if (model.sensors[s].measures == position) {
      return static_cast<int>(s);
    }
  }
  throw InputError({model.file, 0, "sensors"}, "none that measures " + position,
                   "one: the gait's travel is taken out along it");
}

/// The map itself, with what does not change while it is evaluated.
class ReturnMap {
 public:
  ReturnMap(const run::LoadedScenario& loaded, const PoincareSection& section, const OrbitOptions& options)
      : loaded_(loaded), section_(section), options_(options) {
    if (loaded.controller) {
      held_setup_ = *loaded.controller;
      for (const auto& [name, value] : section.held) {
        held_setup_->set(name, value);
      }
    }
    const model::Plant plant(loaded.model, {});
    positions_ = plant.positions();
    const int sensor = sensor_of(loaded.model, section.travel);
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(plant.sensors(), sensor);
    along_ = plant.output_map().completeOrthogonalDecomposition().solve(unit);
    across_ = plant.output_map().row(sensor);
  }

  std::vector<Passage> run(std::string& end) const {
    run::SampledRun sampled(loaded_.model, loaded_.scenario.terrain, setup(), options_.run);
    sampled.start(run::state_at_start(loaded_.model, loaded_.scenario));
    return passages_of(sampled, section_, loaded_.scenario, static_cast<std::size_t>(options_.cycles), end,
                       options_.stop);
  }

  void use_history(const Eigen::MatrixXd& history) { history_ = history; }
  void use_memory(const std::vector<double>& memory) { memory_ = memory; }
  void deviations_from(const Eigen::VectorXd& reference) { reference_ = reference; }
  /// From now on with the controller's memory as it is in `u`, which then has none.
  Eigen::VectorXd hold(const Eigen::VectorXd& u) {
    for (std::size_t k = 0; k < section_.memory.size(); ++k) {
      memory_[memory_index(*loaded_.controller, section_.memory[k])] =
          u[states(u) + static_cast<Eigen::Index>(k)];
    }
    held_ = true;
    Eigen::VectorXd without = u;
    without.tail(static_cast<Eigen::Index>(section_.memory.size())).setZero();
    return without;
  }

  /// (state with the travel counted from its memory; the section's memory).
  Eigen::VectorXd vector_of(const Passage& passage) const {
    const auto memories = static_cast<Eigen::Index>(section_.memory.size());
    Eigen::VectorXd u = Eigen::VectorXd::Zero(passage.state.size() + memories);
    u.head(passage.state.size()) = passage.state;
    const bool counted = !held_ && !section_.travel_memory.empty();
    const double moved =
        counted
            ? section_.per_memory * passage.memory[memory_index(*loaded_.controller, section_.travel_memory)]
            : across_.dot(passage.state.head(positions_));
    u.head(positions_) -= along_ * moved;
    for (Eigen::Index k = 0; k < memories && !held_; ++k) {
      u[passage.state.size() + k] =
          passage.memory[memory_index(*loaded_.controller, section_.memory[static_cast<std::size_t>(k)])];
    }
    return u;
  }

  std::optional<Eigen::VectorXd> operator()(const Eigen::VectorXd& u) const {
    run::SampledRun sampled(loaded_.model, loaded_.scenario.terrain, setup(), options_.run);
    const Eigen::VectorXd x = u.head(states(u));
    if (sampled.controller() != nullptr) {
      sampled.controller()->reset();
      sampled.controller()->set_memory(memory_at(u));
      show_past(sampled, x);
    }
    sampled.start(x);
    std::string end;
    try {
      const std::vector<Passage> next =
          passages_of(sampled, section_, loaded_.scenario, 1, end, options_.stop);
      return next.empty() ? std::nullopt : std::optional<Eigen::VectorXd>(vector_of(next.front()));
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }

  Eigen::Index positions() const { return positions_; }
  Eigen::Index states(const Eigen::VectorXd& u) const {
    return u.size() - static_cast<Eigen::Index>(section_.memory.size());
  }

 private:
  const run::ControllerSetup* setup() const {
    if (!loaded_.controller) {
      return nullptr;
    }
    return held_ ? &*held_setup_ : &*loaded_.controller;
  }

  std::vector<double> memory_at(const Eigen::VectorXd& u) const {
    std::vector<double> memory = memory_;
    for (std::size_t k = 0; k < section_.memory.size() && !held_; ++k) {
      memory[memory_index(*loaded_.controller, section_.memory[k])] =
          u[states(u) + static_cast<Eigen::Index>(k)];
    }
    if (!section_.travel_memory.empty()) {
      memory[memory_index(*loaded_.controller, section_.travel_memory)] = 0.0;
    }
    return memory;
  }

  void show_past(run::SampledRun& sampled, const Eigen::VectorXd& x) const {
    Eigen::VectorXd outputs(sampled.plant().sensors());
    for (Eigen::Index i = 0; i < history_.cols(); ++i) {
      Eigen::VectorXd past = x + history_.col(i);
      const double ago = static_cast<double>(history_.cols() - i) * loaded_.controller->period;
      past.head(positions_) -= ago * (x - reference_).segment(positions_, positions_);
      sampled.plant().outputs(past.data(), outputs.data());
      sampled.show_past(outputs);
    }
  }

  const run::LoadedScenario& loaded_;
  const PoincareSection& section_;
  const OrbitOptions& options_;
  std::optional<run::ControllerSetup> held_setup_;
  Eigen::Index positions_ = 0;
  Eigen::VectorXd along_, across_;  // of the travel, in positions
  Eigen::MatrixXd history_;
  std::vector<double> memory_;
  Eigen::VectorXd reference_;
  bool held_ = false;
};

/// Scatter of the last passages within what is large against counts and still small for a gait.
Eigen::VectorXd steps_of(const Eigen::MatrixXd& points, Eigen::Index positions, Eigen::Index memories) {
  const Eigen::VectorXd mean = points.rowwise().mean();
  const Eigen::VectorXd scatter =
      ((points.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(points.cols() - 1))
          .cwiseSqrt();
  const Eigen::Index contact = points.rows() - memories - 2 * positions;
  Eigen::VectorXd smallest(points.rows());
  smallest << Eigen::VectorXd::Constant(positions, kPosition),
      Eigen::VectorXd::Constant(positions, kVelocity), Eigen::VectorXd::Constant(contact, kContact),
      Eigen::VectorXd::Constant(memories, kPosition);
  return scatter.cwiseMax(smallest).cwiseMin(10.0 * smallest);
}

/// A position of the model, named itself or by a quantity that is a multiple (or a sine) of it.
run::Quantity position_named(const YamlNode& node, const run::LoadedScenario& loaded) {
  for (const run::Quantity& quantity : loaded.scenario.quantities) {
    if (quantity.name == node.text()) {
      return quantity;
    }
  }
  run::Quantity itself;
  itself.name = itself.of = node.text();
  itself.unit = model::position_unit_of(loaded.model, node.text(), node);
  return itself;
}

/// The level of a quantity or of its rate, as one of the position behind it.
double level_of(const YamlNode& node, const run::Quantity& quantity, bool rate) {
  const double level = model::read_number(node, rate ? quantity.unit + "/s" : quantity.unit);
  if (quantity.sine && level != 0.0) {
    node.refuse("0: " + quantity.name + " is a sine of its position");
  }
  return level / quantity.times;
}

void check_memory(const YamlNode& node, const run::LoadedScenario& loaded) {
  std::vector<std::string> known;
  if (loaded.controller) {
    for (const plumbline_port& port : loaded.controller->library.memory()) {
      known.emplace_back(port.name);
      if (known.back() == node.text()) {
        return;
      }
    }
  }
  node.refuse("a memory of the controller" + nearest_names(node.text(), known));
}

}  // namespace

std::optional<PoincareSection> read_section(const run::LoadedScenario& loaded) {
  const auto gait = run::section_of_scenario(loaded.scenario.file, "gait");
  const auto node = gait ? gait->find("section") : std::nullopt;
  if (!node) {
    return std::nullopt;
  }
  node->allow_keys({"rate_of", "position_of", "falls_through", "rises_through", "in_flight", "travel",
                    "travel_memory", "memory", "held"});
  PoincareSection section;
  section.rate = node->has("rate_of");
  const YamlNode of = node->at(section.rate ? "rate_of" : "position_of");
  const run::Quantity looked_at = position_named(of, loaded);
  section.position = looked_at.of;
  section.falling = node->has("falls_through");
  const YamlNode level = node->at(section.falling ? "falls_through" : "rises_through");
  section.level = level_of(level, looked_at, section.rate);
  if (const auto flight = node->find("in_flight")) {
    section.in_flight = flight->text() == "true";
  }
  const run::Quantity travel = position_named(node->at("travel"), loaded);
  section.travel = travel.of;
  if (const auto memory = node->find("travel_memory")) {
    const YamlNode name = memory->at("name");
    check_memory(name, loaded);
    section.travel_memory = name.text();
    section.per_memory = model::read_positive(*memory, memory->at("unit").text(), {"name"}) / travel.times;
  }
  if (const auto memory = node->find("memory")) {
    for (const YamlNode& name : memory->items()) {
      check_memory(name, loaded);
      section.memory.push_back(name.text());
    }
  }
  if (const auto held = node->find("held")) {
    for (const auto& [name, value] : held->entries()) {
      section.held.emplace_back(name, value.number());
    }
  }
  return section;
}

Orbit find_orbit(const run::LoadedScenario& loaded, const PoincareSection& section,
                 const OrbitOptions& options) {
  Orbit orbit;
  ReturnMap map(loaded, section, options);
  const std::vector<Passage> passages = map.run(orbit.why_not);
  if (!orbit.why_not.empty() || passages.size() < kAveraged) {
    return orbit;
  }
  orbit.settled = true;
  const auto memories = static_cast<Eigen::Index>(section.memory.size());
  Eigen::MatrixXd points(passages.back().state.size() + memories, static_cast<Eigen::Index>(kAveraged));
  Eigen::MatrixXd history =
      Eigen::MatrixXd::Zero(passages.back().history.rows(), passages.back().history.cols());
  for (std::size_t k = 0; k < kAveraged; ++k) {
    const Passage& passage = passages[passages.size() - kAveraged + k];
    points.col(static_cast<Eigen::Index>(k)) = map.vector_of(passage);
    history += passage.history / static_cast<double>(kAveraged);
  }
  const Eigen::VectorXd steps = steps_of(points, map.positions(), memories);
  const Eigen::VectorXd guess = points.rowwise().mean();
  const Runners runners{options.workers, options.stop};
  map.use_history(history);
  map.use_memory(passages.back().memory);
  map.deviations_from(guess.head(map.states(guess)));
  const Map with = [&](const Eigen::VectorXd& u) { return map(u); };
  const FixedPoint point = find_fixed_point(with, guess, steps, options.tolerance, options.rounds, runners);
  orbit.found = point.found;
  orbit.residual = point.residual;
  orbit.rounds = point.rounds;
  orbit.growth = point.growth;
  orbit.memory.assign(point.at.data() + map.states(point.at), point.at.data() + point.at.size());
  const auto wide = central_differences(with, point.at, 2.0 * steps, runners);
  orbit.growth_twice_step = wide ? growth_of(*wide) : 0.0;
  const Eigen::VectorXd held = map.hold(point.at);
  const auto without = central_differences(with, held, steps, runners);
  const auto without_wide = central_differences(with, held, 2.0 * steps, runners);
  orbit.growth_held = without ? growth_of(*without) : 0.0;
  orbit.growth_held_twice_step = without_wide ? growth_of(*without_wide) : 0.0;
  orbit.found = orbit.found && without && point.slope.size() > 0;
  return orbit;
}

}  // namespace plumbline::validation
