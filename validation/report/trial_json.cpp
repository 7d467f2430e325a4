#include "validation/report/trial_json.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "validation/identify/compare/phases.h"
#include "validation/report/encode.h"
#include "validation/report/spectrum.h"
#include "validation/report/traces.h"

namespace plumbline::validation {
namespace {

using nlohmann::json;

/// Shorter in the page; nobody reads more digits off a picture.
double four_digits(double value) {
  if (value == 0.0 || !std::isfinite(value)) {
    return 0.0;
  }
  const double unit = std::pow(10.0, 3.0 - std::floor(std::log10(std::abs(value))));
  return std::round(value * unit) / unit;
}

/// Sums of squared residuals of a window's channels; those of contact switches behind them are left out.
Eigen::VectorXd channel_squares(const Stage& stage, const Data& data, std::size_t w) {
  const Trial& trial = data.trials[static_cast<std::size_t>(data.windows[w].trial)];
  return stage.estimate.square[w].head(static_cast<Eigen::Index>(trial.measured.size()));
}

/// Root mean square over the channels of a window, in units of the floor.
double window_ratio(const Stage& stage, const Data& data, std::size_t w) {
  return std::sqrt(channel_squares(stage, data, w).mean() / static_cast<double>(data.windows[w].count));
}

/// Indices of a trial's windows (of all trials when it is negative), those with the largest error first.
std::vector<std::size_t> worst_windows(const Stage& stage, const Data& data, int trial) {
  std::vector<std::size_t> order;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    if (trial < 0 || data.windows[w].trial == trial) {
      order.push_back(w);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return window_ratio(stage, data, a) > window_ratio(stage, data, b);
  });
  return order;
}

/// The windows' errors for each drawn model: over all channels, and channel by channel.
json windows_json(const Data& data, std::size_t trial, const std::vector<Drawn>& drawn) {
  json list = json::array();
  const Trial& of = data.trials[trial];
  for (const std::size_t w : windows_in_time(data, trial)) {
    const Window& window = data.windows[w];
    json ratios = json::array();
    json channels = json::array();
    for (const Drawn& one : drawn) {
      ratios.push_back(four_digits(window_ratio(*one.stage, data, w)));
      json by_channel = json::array();
      for (const double square : channel_squares(*one.stage, data, w)) {
        by_channel.push_back(four_digits(std::sqrt(square / static_cast<double>(window.count))));
      }
      channels.push_back(by_channel);
    }
    list.push_back({{"from", of.time[window.first]},
                    {"to", of.time[window.first + window.count - 1]},
                    {"ratio", ratios},
                    {"channels", channels}});
  }
  return list;
}

/// Error of one channel in one phase, and the window that has the largest part of it.
json phase_json(const Eigen::VectorXd& residual, double floor, const std::vector<Eigen::Index>& members,
                const std::vector<Span>& spans) {
  double sum = 0.0;
  double count = 0.0;
  double most = -1.0;
  std::size_t worst = 0;
  std::size_t w = 0;
  double in_window = 0.0;
  for (const Eigen::Index k : members) {
    while (w + 1 < spans.size() && k >= spans[w + 1].first) {
      ++w;
      in_window = 0.0;
    }
    if (!std::isfinite(residual[k])) {
      continue;
    }
    const double square = residual[k] * residual[k];
    sum += square;
    count += 1.0;
    in_window += square;
    if (in_window > most) {
      most = in_window;
      worst = w;
    }
  }
  return {four_digits(std::sqrt(sum / std::max(1.0, count)) / floor), worst};
}

json heat_json(const PhaseTable& table, const Eigen::VectorXd& residual, double floor,
               const std::vector<Span>& spans) {
  json cells = json::array();
  for (const std::vector<Eigen::Index>& members : table.members) {
    cells.push_back(phase_json(residual, floor, members, spans));
  }
  return cells;
}

json shares_json(const PhaseTable& table, Eigen::Index samples) {
  json shares = json::array();
  for (const std::vector<Eigen::Index>& members : table.members) {
    shares.push_back(four_digits(static_cast<double>(members.size()) / static_cast<double>(samples)));
  }
  return shares;
}

/// The place of a trial's first channel in Comparison::channels.
std::size_t first_channel(const Data& data, std::size_t trial) {
  std::size_t first = 0;
  for (std::size_t t = 0; t < trial; ++t) {
    first += data.trials[t].measured.size() + data.trials[t].switches.size();
  }
  return first;
}

json channel_json(const Data& data, std::size_t trial, std::size_t channel, const std::vector<Drawn>& drawn,
                  const std::vector<Block>& blocks) {
  const Trial& of = data.trials[trial];
  const Measured& measured = of.measured[channel];
  const std::vector<Span> spans = spans_of(data, trial);
  const PhaseTable phases = phases_of(of, measured);
  const std::size_t place = first_channel(data, trial) + channel;
  const ChannelError& about = drawn.front().comparison.channels[place];
  json out{{"sensor", measured.sensor}, {"unit", about.unit},
           {"floor", about.floor},      {"measured", packed(thinned(measured.values, blocks), blocks)},
           {"phases", json::array()},   {"shares", shares_json(phases, of.samples())},
           {"models", json::array()}};
  for (const Phase& phase : phases.phases) {
    out["phases"].push_back({phase.group, phase.name});
  }
  for (const Drawn& one : drawn) {
    const Eigen::VectorXd predicted = one.predicted[trial].col(static_cast<Eigen::Index>(channel));
    const Eigen::VectorXd residual = measured.values - predicted;
    const Spectrum lines = spectrum(residual, spans, of.period);
    out["floor_density"] = density_of_floor(about.floor, of.period);
    out["models"].push_back({{"rms", one.comparison.channels[place].rms},
                             {"ratio", one.comparison.channels[place].ratio},
                             {"predicted", packed(thinned(predicted, blocks), blocks)},
                             {"residual", packed(thinned(residual, blocks), blocks)},
                             {"heat", heat_json(phases, residual, about.floor, spans)},
                             {"frequency_step", lines.frequency_step},
                             {"density", floats(lines.density)}});
  }
  return out;
}

/// Errors of the instants at which contact switches close and open.
json switches_json(const Data& data, std::size_t trial, const std::vector<Drawn>& drawn) {
  const Trial& of = data.trials[trial];
  json list = json::array();
  for (std::size_t r = 0; r < of.switches.size(); ++r) {
    const std::size_t place = first_channel(data, trial) + of.measured.size() + r;
    json one{{"sensor", of.switches[r].name},
             {"unit", "s"},
             {"floor", drawn.front().comparison.channels[place].floor},
             {"models", json::array()}};
    for (const Drawn& model : drawn) {
      one["models"].push_back(
          {{"rms", model.comparison.channels[place].rms}, {"ratio", model.comparison.channels[place].ratio}});
    }
    list.push_back(one);
  }
  return list;
}

json contacts_json(const Trial& trial) {
  json list = json::array();
  for (const ContactEvent& event : trial.contact_events) {
    list.push_back({{"time", event.time},
                    {"contact_switch", trial.switches[static_cast<std::size_t>(event.record)].name},
                    {"kind", event.touchdown ? "touchdown" : "lift-off"}});
  }
  return list;
}

}  // namespace

std::vector<std::vector<Span>> detailed_spans(const Data& data, const std::vector<Drawn>& drawn,
                                              const DrawingOptions& options) {
  std::set<std::size_t> chosen;
  for (const Drawn& one : drawn) {
    const std::vector<std::size_t> worst = worst_windows(*one.stage, data, -1);
    chosen.insert(worst.begin(),
                  worst.begin() + static_cast<std::ptrdiff_t>(std::min(worst.size(), options.worst)));
    for (std::size_t t = 0; t < data.trials.size(); ++t) {
      const std::vector<std::size_t> here = worst_windows(*one.stage, data, static_cast<int>(t));
      chosen.insert(here.begin(), here.begin() + (here.empty() ? 0 : 1));
    }
  }
  std::vector<std::vector<Span>> spans(data.trials.size());
  for (const std::size_t w : chosen) {
    const Window& window = data.windows[w];
    spans[static_cast<std::size_t>(window.trial)].push_back({window.first, window.count});
  }
  return spans;
}

Eigen::Index points_of_curve(const Data& data, std::size_t drawn, const DrawingOptions& options) {
  std::size_t curves = 0;
  for (const Trial& trial : data.trials) {
    curves += trial.measured.size() * (1 + 2 * drawn);
  }
  const Eigen::Index share = options.all_points / static_cast<Eigen::Index>(std::max<std::size_t>(1, curves));
  return std::clamp(share, options.least_points, options.points);
}

json trial_json(const Data& data, std::size_t trial, const std::vector<Drawn>& drawn,
                const std::vector<Block>& blocks) {
  const Trial& of = data.trials[trial];
  json points = json::array();
  for (const Block& block : blocks) {
    points.push_back(block.points());
  }
  json out{{"name", of.name},
           {"title", of.title},
           {"role", to_string(of.role)},
           {"period", of.period},
           {"samples", of.samples()},
           {"events", of.events},
           {"contact_events", contacts_json(of)},
           {"switches", switches_json(data, trial, drawn)},
           {"points", points},
           {"time", floats(thinned_time(of.time, blocks))},
           {"windows", windows_json(data, trial, drawn)},
           {"channels", json::array()}};
  for (std::size_t c = 0; c < of.measured.size(); ++c) {
    out["channels"].push_back(channel_json(data, trial, c, drawn, blocks));
  }
  return out;
}

}  // namespace plumbline::validation
