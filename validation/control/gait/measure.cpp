#include "validation/control/gait/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "simulator/model/plain_number.h"
#include "simulator/trace/error.h"
#include "simulator/trace/units.h"

namespace plumbline::validation {
namespace {

using Kind = Measure::Kind;
using model::YamlNode;

struct Word {
  const char* word;
  Kind kind;
  bool channels;  // takes one or more
  bool several;
};
constexpr std::array<Word, 18> kWords{{{"duration", Kind::duration, false, false},
                                       {"change", Kind::change, true, false},
                                       {"at_end", Kind::at_end, true, false},
                                       {"mean", Kind::mean, true, false},
                                       {"largest", Kind::largest, true, true},
                                       {"swing", Kind::swing, true, false},
                                       {"rate", Kind::rate, true, false},
                                       {"rms", Kind::rms, true, false},
                                       {"integral", Kind::integral, true, true},
                                       {"positive_work", Kind::positive_work, true, true},
                                       {"cost_of_transport", Kind::cost_of_transport, true, true},
                                       {"time_at_limit", Kind::time_at_limit, true, true},
                                       {"touchdown_gap", Kind::touchdown_gap, false, false},
                                       {"share_down", Kind::share_down, true, false},
                                       {"cycles", Kind::cycles, false, false},
                                       {"growth", Kind::growth, false, false},
                                       {"growth_held", Kind::growth_held, false, false},
                                       {"joint_of_stretch", Kind::joint_of_stretch, true, false}}};

/// Powers, and for a cost of transport a travel behind them.
std::string unit_of_work(const Measure& measure, const Channels& channels, const Place_in_file& where) {
  const bool cost = measure.kind == Kind::cost_of_transport;
  for (std::size_t c = 0; c < measure.channels.size(); ++c) {
    const char* expected = cost && c + 1 == measure.channels.size() ? "m" : "W";
    const std::string& found = channels.unit(static_cast<std::size_t>(channels.index(measure.channels[c])));
    if (!units_agree(found, expected)) {
      throw InputError(where, "\"" + measure.channels[c] + "\" in " + found,
                       std::string("a channel in ") + expected);
    }
  }
  return cost ? "1" : "J";
}

const Word& word_of(const YamlNode& node, const std::string& text) {
  std::vector<std::string> known;
  for (const Word& word : kWords) {
    known.emplace_back(word.word);
    if (text == word.word) {
      return word;
    }
  }
  node.refuse(model::quote(text), "a known measure" + nearest_names(text, known));
}

std::vector<std::string> read_channels(const YamlNode& node, bool several) {
  if (node.found() != "a list") {
    return {node.text()};
  }
  std::vector<std::string> names;
  for (const YamlNode& item : node.items()) {
    names.push_back(item.text());
  }
  if (names.empty() || (names.size() > 1 && !several)) {
    node.refuse("a list of " + std::to_string(names.size()), several ? "channels" : "one channel");
  }
  return names;
}

double mean_of(const Eigen::VectorXd& time, const Eigen::VectorXd& values, bool over_time) {
  double sum = 0.0;
  for (Eigen::Index k = 1; k < time.size(); ++k) {
    sum += 0.5 * (time[k] - time[k - 1]) * (values[k] + values[k - 1]);
  }
  return over_time ? sum : sum / (time[time.size() - 1] - time[0]);
}

/// Source: Sreenath et al. (2011), equations 40 and 41: only what motors put in counts.
double positive_work(const Measure& measure, const Channels& channels, const CycleSamples& cycle) {
  const std::size_t powers = measure.channels.size() - (measure.kind == Kind::cost_of_transport ? 1 : 0);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(cycle.time.size());
  for (std::size_t c = 0; c < powers; ++c) {
    sum += cycle.rows.col(channels.index(measure.channels[c])).cwiseMax(0.0);
  }
  return mean_of(cycle.time, sum, true);
}

double at_limit(const CycleSamples& cycle, const Eigen::VectorXd& values, double limit) {
  double time = 0.0;
  for (Eigen::Index k = 1; k < values.size(); ++k) {
    time += std::abs(values[k]) >= limit ? cycle.time[k] - cycle.time[k - 1] : 0.0;
  }
  return time;
}

}  // namespace

Measure::Of Measure::of() const {
  switch (kind) {
    case Kind::cycles:
      return Of::run;
    case Kind::growth:
    case Kind::growth_held:
      return Of::orbit;
    case Kind::joint_of_stretch:
      return Of::model;
    default:
      return Of::cycle;
  }
}

Measure read_measure(const YamlNode& node) {
  Measure measure;
  if (!node.is_map()) {
    const Word& word = word_of(node, node.text());
    if (word.channels) {
      node.refuse(node.text() + " alone", std::string("{") + word.word + ": CHANNEL}");
    }
    measure.kind = word.kind;
    measure.text = word.word;
    return measure;
  }
  const auto entries = node.entries();
  if (entries.empty()) {
    node.refuse("an empty map", "a measure");
  }
  const Word& word = word_of(entries.front().second, entries.front().first);
  if (!word.channels) {
    node.refuse("a map", word.word);
  }
  measure.kind = word.kind;
  measure.channels = read_channels(entries.front().second, word.several);
  measure.text = std::string(word.word) + " of " + measure.channels.front() +
                 (measure.channels.size() > 1 ? ", ..." : "");
  node.allow_keys({word.word, "limit", "travel", "weight"});
  if (measure.kind == Kind::cost_of_transport) {
    measure.channels.push_back(node.at("travel").text());
    measure.weight = model::read_positive(node.at("weight"), "N");
  } else if (node.has("travel") || node.has("weight")) {
    node.at(node.has("travel") ? "travel" : "weight").refuse("neither travel nor weight here");
  }
  if (measure.kind == Kind::time_at_limit) {
    const YamlNode limit = node.at("limit");
    measure.limit = model::read_positive(limit, limit.at("unit").text());
  } else if (node.has("limit")) {
    node.at("limit").refuse("no limit here");
  }
  if (measure.kind == Kind::share_down) {
    measure.channels.front() = "contact_" + measure.channels.front();
  }
  return measure;
}

std::string unit_of(const Measure& measure, const Channels& channels, const Place_in_file& where) {
  switch (measure.kind) {
    case Kind::duration:
    case Kind::touchdown_gap:
    case Kind::time_at_limit:
      return "s";
    case Kind::share_down:
    case Kind::cycles:
    case Kind::growth:
    case Kind::growth_held:
    case Kind::joint_of_stretch:
      return "1";
    case Kind::positive_work:
    case Kind::cost_of_transport:
      return unit_of_work(measure, channels, where);
    default:
      break;
  }
  std::string unit;
  for (const std::string& name : measure.channels) {
    const std::string& one = channels.unit(static_cast<std::size_t>(channels.index(name)));
    if (!unit.empty() && !units_agree(unit, one)) {
      throw InputError(where, "channels in " + unit + " and " + one, "channels of one unit");
    }
    unit = one;
  }
  return measure.kind == Kind::rate ? unit + "/s" : measure.kind == Kind::integral ? unit + " s" : unit;
}

double value_of(const Measure& measure, const Channels& channels, const CycleSamples& cycle) {
  const Eigen::VectorXd& time = cycle.time;
  const Eigen::Index last = time.size() - 1;
  const double duration = time[last] - time[0];
  const auto column = [&](std::size_t k) -> Eigen::VectorXd {
    return cycle.rows.col(channels.index(measure.channels[k]));
  };
  switch (measure.kind) {
    case Kind::duration:
      return duration;
    case Kind::change:
      return column(0)[last] - column(0)[0];
    case Kind::rate:
      return (column(0)[last] - column(0)[0]) / duration;
    case Kind::at_end:
      return column(0)[last];
    case Kind::share_down:
    case Kind::mean:
      return mean_of(time, column(0), false);
    case Kind::rms:
      return std::sqrt(mean_of(time, column(0).cwiseAbs2(), false));
    case Kind::positive_work:
      return positive_work(measure, channels, cycle);
    case Kind::cost_of_transport: {
      const Eigen::VectorXd travel = column(measure.channels.size() - 1);
      return positive_work(measure, channels, cycle) / (measure.weight * std::abs(travel[last] - travel[0]));
    }
    case Kind::swing:
      return column(0).maxCoeff() - column(0).minCoeff();
    case Kind::touchdown_gap: {
      const auto [first, latest] = std::minmax_element(cycle.touchdowns.begin(), cycle.touchdowns.end());
      return *latest - *first;
    }
    default:
      break;
  }
  double total = 0.0;
  for (std::size_t c = 0; c < measure.channels.size(); ++c) {
    const Eigen::VectorXd values = column(c);
    if (measure.kind == Kind::largest) {
      total = std::max(total, values.tail(last).cwiseAbs().maxCoeff());
    } else if (measure.kind == Kind::integral) {
      total += mean_of(time, values, true);
    } else if (measure.kind == Kind::time_at_limit) {
      total += at_limit(cycle, values, measure.limit);
    } else {
      throw std::invalid_argument(measure.text + " is not measured cycle by cycle");
    }
  }
  return total;
}

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  spread.count = static_cast<long>(values.size());
  const double n = static_cast<double>(values.size());
  for (const double value : values) {
    spread.mean += value / n;
  }
  for (const double value : values) {
    spread.deviation += (value - spread.mean) * (value - spread.mean);
  }
  spread.deviation = values.size() > 1 ? std::sqrt(spread.deviation / (n - 1.0)) : 0.0;
  return spread;
}

}  // namespace plumbline::validation
