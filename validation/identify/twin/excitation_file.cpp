#include "validation/identify/twin/excitation_file.h"

#include <cmath>
#include <stdexcept>

#include "simulator/trace/number_text.h"
#include "validation/identify/trial/physical_number.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;

/// Reads the keys of one shape; levels are multiplied by the factor of its `unit`.
class ShapeReader {
 public:
  ShapeReader(const YamlNode& node, double factor, const Sampling& sampling)
      : node_(node), factor_(factor), sampling_(sampling) {}

  void allow(std::vector<std::string> keys) const {
    keys.insert(keys.end(), {"kind", "unit"});
    node_.allow_keys(keys);
  }
  double level(const std::string& key) const { return factor_ * node_.at(key).number(); }
  std::vector<double> levels(const std::string& key) const {
    std::vector<double> values;
    for (const YamlNode& item : node_.at(key).items()) {
      values.push_back(factor_ * item.number());
    }
    return values;
  }
  double physical(const std::string& key, const std::string& unit) const {
    return one(node_.at(key), key, unit);
  }
  std::vector<double> physicals(const std::string& key, const std::string& unit) const {
    std::vector<double> values;
    for (const YamlNode& item : node_.at(key).items()) {
      values.push_back(one(item, key, unit));
    }
    return values;
  }
  int whole_number(const std::string& key) const {
    const double value = node_.at(key).number();
    if (value != std::floor(value) || value < 0.0 || value > 1e6) {
      node_.at(key).refuse("a whole number from 0 to 1000000");
    }
    return static_cast<int>(value);
  }
  /// `linear` or `logarithmic`; without the key logarithmic.
  bool linear(const std::string& key) const {
    const auto spacing = node_.find(key);
    if (spacing && spacing->text() != "linear" && spacing->text() != "logarithmic") {
      spacing->refuse("linear or logarithmic");
    }
    return spacing && spacing->text() == "linear";
  }
  /// Times of a list at which nothing could happen any more are mistakes.
  std::vector<double> times(const std::string& key) const {
    std::vector<double> values = physicals(key, "s");
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] >= sampling_.duration()) {
        node_.at(key).items()[i].refuse("a time before the end at " + number_text(sampling_.duration()) +
                                        " s");
      }
    }
    return values;
  }

 private:
  static double one(const YamlNode& node, const std::string& key, const std::string& unit) {
    return read_physical_text(node, unit, key);
  }

  const YamlNode& node_;
  double factor_;
  const Sampling& sampling_;
};

using Shape = std::unique_ptr<Excitation>;

Shape read_constant(const ShapeReader& in) {
  in.allow({"value"});
  return std::make_unique<Constant>(in.level("value"));
}

Shape read_stepped_chirp(const ShapeReader& in) {
  in.allow({"from", "to", "steps", "first_amplitude", "last_amplitude", "amplitude_spacing"});
  SteppedChirp::Options options;
  options.from = in.physical("from", "Hz");
  options.to = in.physical("to", "Hz");
  options.steps = in.whole_number("steps");
  options.first_amplitude = in.level("first_amplitude");
  options.last_amplitude = in.level("last_amplitude");
  options.linear_amplitude = in.linear("amplitude_spacing");
  return std::make_unique<SteppedChirp>(options);
}

Shape read_multisine(const ShapeReader& in) {
  in.allow({"frequencies", "amplitudes", "phases"});
  return std::make_unique<Multisine>(in.physicals("frequencies", "Hz"), in.levels("amplitudes"),
                                     in.physicals("phases", "rad"));
}

Shape read_steps(const ShapeReader& in) {
  in.allow({"times", "levels"});
  return std::make_unique<Steps>(in.times("times"), in.levels("levels"));
}

Shape read_ramp(const ShapeReader& in) {
  in.allow({"start", "end"});
  return std::make_unique<Ramp>(in.level("start"), in.level("end"));
}

Shape read_pulses(const ShapeReader& in) {
  in.allow({"times", "width", "level"});
  return std::make_unique<Pulses>(in.times("times"), in.physical("width", "s"), in.level("level"));
}

Shape read_filtered_noise(const ShapeReader& in) {
  in.allow({"deviation", "corner", "seed"});
  return std::make_unique<FilteredNoise>(in.level("deviation"), in.physical("corner", "Hz"),
                                         static_cast<std::uint64_t>(in.whole_number("seed")));
}

struct Kind {
  const char* name;
  Shape (*read)(const ShapeReader&);
};
constexpr Kind kKinds[] = {{"constant", read_constant},
                           {"stepped_chirp", read_stepped_chirp},
                           {"multisine", read_multisine},
                           {"steps", read_steps},
                           {"ramp", read_ramp},
                           {"pulses", read_pulses},
                           {"filtered_noise", read_filtered_noise}};

const Kind& find_kind(const YamlNode& node) {
  const std::string name = node.text();
  std::vector<std::string> known;
  for (const Kind& kind : kKinds) {
    if (name == kind.name) {
      return kind;
    }
    known.emplace_back(kind.name);
  }
  node.refuse("a kind of excitation" + nearest_names(name, known));
}

Shape read_shape(const YamlNode& node, const std::string& command_unit, const std::string& motor,
                 const Sampling& sampling) {
  const Kind& kind = find_kind(node.at("kind"));
  const YamlNode unit = node.at("unit");
  const double factor = unit_factor(unit.text(), command_unit, "the command of motor " + motor, unit.place());
  Shape shape;
  try {
    shape = kind.read(ShapeReader(node, factor, sampling));
  } catch (const std::invalid_argument& error) {
    node.refuse("an impossible " + std::string(kind.name), error.what());
  }
  const double highest = 0.5 / sampling.period;
  if (shape->highest_frequency() >= highest) {
    node.refuse("a frequency of " + number_text(shape->highest_frequency(), 6) + " Hz",
                "frequencies below " + number_text(highest, 6) + " Hz, half the sample rate");
  }
  return shape;
}

}  // namespace

Excitations read_excitations(const YamlNode& list, const std::string& command_unit, const std::string& motor,
                             const Sampling& sampling) {
  Excitations shapes;
  for (const YamlNode& item : list.items()) {
    shapes.push_back(read_shape(item, command_unit, motor, sampling));
  }
  if (shapes.empty()) {
    list.refuse("an empty list", "at least one excitation");
  }
  return shapes;
}

}  // namespace plumbline::validation
