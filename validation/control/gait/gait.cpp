#include "validation/control/gait/gait.h"

#include <algorithm>

#include "simulator/model/plain_number.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;

Gait::Cycle read_cycle(const YamlNode& node) {
  for (const Gait::Cycle cycle : {Gait::Cycle::hop, Gait::Cycle::step, Gait::Cycle::stride}) {
    if (to_string(cycle) == node.text()) {
      return cycle;
    }
  }
  node.refuse("hop, step or stride");
}

int read_foot(const YamlNode& node, const model::Model& model) {
  std::vector<std::string> known;
  for (std::size_t f = 0; f < model.feet.size(); ++f) {
    known.push_back(model.feet[f].name);
    if (known.back() == node.text()) {
      return static_cast<int>(f);
    }
  }
  node.refuse("a foot of the model" + nearest_names(node.text(), known));
}

long read_count(const YamlNode& node) {
  const double number = node.number();
  if (!(number >= 0.0 && number <= 1e6) || number != static_cast<double>(static_cast<long>(number))) {
    node.refuse(number_text(number), "a whole number from 0 to 1000000");
  }
  return static_cast<long>(number);
}

}  // namespace

std::string to_string(Gait::Cycle cycle) {
  switch (cycle) {
    case Gait::Cycle::hop:
      return "hop";
    case Gait::Cycle::step:
      return "step";
    case Gait::Cycle::stride:
      break;
  }
  return "stride";
}

std::optional<Gait> read_gait(const run::LoadedScenario& loaded) {
  const auto node = run::section_of_scenario(loaded.scenario.file, "gait");
  if (!node) {
    return std::nullopt;
  }
  node->allow_keys({"cycle", "feet", "shortest_flight", "settle", "before_fall", "section"});
  Gait gait;
  gait.cycle = read_cycle(node->at("cycle"));
  if (const auto feet = node->find("feet")) {
    for (const YamlNode& foot : feet->items()) {
      gait.feet.push_back(read_foot(foot, loaded.model));
    }
  } else {
    for (std::size_t f = 0; f < loaded.model.feet.size(); ++f) {
      gait.feet.push_back(static_cast<int>(f));
    }
  }
  if (gait.feet.empty()) {
    node->refuse("a gait without feet", "a model with feet");
  }
  if (const auto shortest = node->find("shortest_flight")) {
    gait.shortest = model::read_positive(*shortest, "s");
  }
  if (const auto settle = node->find("settle")) {
    gait.settle = read_count(*settle);
  }
  if (const auto fall = node->find("before_fall")) {
    gait.before_fall = read_count(*fall);
  }
  return gait;
}

CycleFinder::CycleFinder(const Gait& gait, std::size_t feet)
    : gait_(gait), down_(feet, false), since_(gait.feet.size(), 0.0), up_since_(gait.feet.size(), -1e9) {}

bool CycleFinder::look(double t, const std::vector<model::Touch>& touches) {
  bool any_touchdown = false;
  bool first_touchdown = false;
  bool all_down = true;
  bool all_up = true;
  for (std::size_t i = 0; i < gait_.feet.size(); ++i) {
    const auto f = static_cast<std::size_t>(gait_.feet[i]);
    const bool down = touches[f].depth > 0.0;
    if (down && !down_[f]) {
      const bool touchdown = t - up_since_[i] >= gait_.shortest;
      any_touchdown = any_touchdown || touchdown;
      first_touchdown = first_touchdown || (touchdown && i == 0);
      foot_ = touchdown ? static_cast<int>(i) : foot_;
      since_[i] = t;
    }
    if (!down && down_[f]) {
      up_since_[i] = t;
    }
    down_[f] = down;
    all_down = all_down && down;
    all_up = all_up && !down;
  }
  if (all_up && !in_flight_) {
    flight_since_ = t;
  }
  in_flight_ = all_up;
  flown_ = flown_ || (all_up && t - flight_since_ >= gait_.shortest);
  switch (gait_.cycle) {
    case Gait::Cycle::hop:
      if (all_down && flown_) {
        flown_ = false;
        return true;
      }
      return false;
    case Gait::Cycle::step:
      return any_touchdown;
    case Gait::Cycle::stride:
      break;
  }
  return first_touchdown;
}

}  // namespace plumbline::validation
