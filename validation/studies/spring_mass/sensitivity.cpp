#include "validation/studies/spring_mass/sensitivity.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include "simulator/trace/error.h"

namespace plumbline::spring_mass {
namespace {

SensitivityRow row(const std::string& parameter, const std::string& value, double Disturbance::*what,
                   double size) {
  SensitivityRow result{parameter, value, {}, parameter != "t"};
  result.disturbance.*what = size;
  return result;
}

double measured(const Trail& trail, Measure measure) {
  switch (measure) {
    case Measure::steady_apex:
      return 100.0 * trail.last_apex_error();
    case Measure::rms_apex:
      return 100.0 * trail.rms_apex();
    case Measure::worst_apex:
      return 100.0 * trail.worst_apex();
    case Measure::rms_deflection:
      return trail.rms_deflection() / degree;
    case Measure::worst_deflection:
      break;
  }
  return trail.worst_deflection() / degree;
}

std::array<Cell, measures> run_cells(const DeadbeatLaw& law, const TrailSettings& wanted, int trails) {
  std::array<Cell, measures> cells;
  TrailSettings settings = wanted;
  settings.straight = true;
  settings.first_apex = law.target();
  const Trail straight = run_trail(law, Tiles::flat(), settings);
  cells[0] = {measured(straight, Measure::steady_apex), 0.0, 0.0, straight.ending != Ending::apex ? 1 : 0};
  cells[0].least = cells[0].most = cells[0].mean;
  settings.straight = false;
  for (int n = 0; n < trails; ++n) {
    settings.seed = static_cast<std::uint64_t>(n) + 1;
    const Trail trail = run_trail(law, Tiles::flat(), settings);
    for (int m = 1; m < measures; ++m) {
      Cell& cell = cells[static_cast<std::size_t>(m)];
      const double value = measured(trail, static_cast<Measure>(m));
      cell.least = n == 0 ? value : std::min(cell.least, value);
      cell.most = n == 0 ? value : std::max(cell.most, value);
      cell.mean += value / trails;
      cell.fallen += trail.ending != Ending::apex ? 1 : 0;
    }
  }
  return cells;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::stringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');) {
    words.push_back(word);
  }
  if (!line.empty() && line.back() == ',') {
    words.emplace_back();
  }
  return words;
}

}  // namespace

std::vector<SensitivityRow> sensitivity_rows(const Body& body) {
  std::vector<SensitivityRow> rows{{"none", "0", {}, true}};
  for (const auto& [text, share] :
       {std::pair{"-10%", -0.10}, {"-5%", -0.05}, {"+5%", 0.05}, {"+10%", 0.10}}) {
    rows.push_back(row("E", text, &Disturbance::energy, share));
  }
  for (const auto& [text, share] :
       {std::pair{"-10%", -0.10}, {"-5%", -0.05}, {"+5%", 0.05}, {"+10%", 0.10}}) {
    rows.push_back(row("k", text, &Disturbance::stiffness, share));
  }
  for (const auto& [text, angle] :
       {std::pair{"-2deg", -2.0}, {"-1deg", -1.0}, {"+1deg", 1.0}, {"+2deg", 2.0}}) {
    rows.push_back(row("alpha", text, &Disturbance::attack, angle * degree));
  }
  rows.push_back(row("beta", "+-1deg", &Disturbance::splay, degree));
  rows.push_back(row("beta", "+-2deg", &Disturbance::splay, 2.0 * degree));
  rows.push_back(row("t", "15 ms", &Disturbance::delay, 0.015));
  rows.push_back(row("t", "30 ms", &Disturbance::delay, 0.030));
  for (const auto& [text, rise] : {std::pair{"-10%", 0.22}, {"-5%", 0.11}, {"+5%", -0.11}, {"+10%", -0.22}}) {
    rows.push_back(
        row("E of ground", text, &Disturbance::energy, -body.mass * body.gravity * rise / body.energy));
  }
  return rows;
}

std::vector<SensitivityResult> sensitivity(const DeadbeatLaw& law, int trails, int steps,
                                           const std::function<void(double)>& progress) {
  std::vector<SensitivityResult> results;
  for (const SensitivityRow& one : sensitivity_rows(law.behaviour().body())) {
    results.push_back({one, {}});
  }
  TrailSettings settings;
  settings.steps = steps;
  settings.gain = matched_gain(law.behaviour().body(), law.target());
  const int jobs = static_cast<int>(results.size()) * laws;
  std::atomic<int> next{0}, done{0};
  const auto work = [&](bool tells) {
    for (int job = next++; job < jobs; job = next++) {
      SensitivityResult& result = results[static_cast<std::size_t>(job / laws)];
      TrailSettings own = settings;
      own.law = static_cast<LawKind>(job % laws);
      own.policy_step = law.behaviour().grid().splay_step;  // the thesis does not state its table's
      own.disturbance = result.row.disturbance;
      if (own.law != LawKind::classical || result.row.with_classical) {
        result.cells[static_cast<std::size_t>(job % laws)] = run_cells(law, own, trails);
      }
      ++done;
      if (tells && progress) {
        progress(static_cast<double>(done) / jobs);
      }
    }
  };
  std::vector<std::thread> workers;
  for (unsigned t = 1; t < std::max(1U, std::thread::hardware_concurrency()); ++t) {
    workers.emplace_back(work, false);
  }
  work(true);
  for (std::thread& worker : workers) {
    worker.join();
  }
  return results;
}

std::vector<PublishedRow> read_published_table(const std::string& file) {
  std::ifstream in(file);
  if (!in) {
    throw InputError({file, 0, ""}, "no such file", "the published table");
  }
  std::vector<PublishedRow> rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    while (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    if (number == 1 || line.empty()) {
      continue;
    }
    const std::vector<std::string> words = split(line);
    if (words.size() != 2 + laws * measures) {
      throw InputError({file, number, ""}, fmt::format("{} columns", words.size()), "17 columns");
    }
    PublishedRow one{words[0], words[1], {}};
    for (int m = 0; m < measures; ++m) {
      for (int l = 0; l < laws; ++l) {
        const std::string& word = words[static_cast<std::size_t>(2 + m * laws + l)];
        double value = std::numeric_limits<double>::quiet_NaN();
        try {
          value = word.empty() ? value : std::stod(word);
        } catch (const std::exception&) {
          throw InputError({file, number, ""}, "\"" + word + "\"", "a number or nothing");
        }
        one.cells[static_cast<std::size_t>(l)][static_cast<std::size_t>(m)] = value;
      }
    }
    rows.push_back(one);
  }
  return rows;
}

std::string verdict(const Cell& cell, double published) {
  constexpr double half_unit = 0.05 + 1e-9;
  if (cell.fallen > 0 && !std::isnan(published)) {
    return "x";
  }
  if (std::isnan(published)) {
    return "";
  }
  if (std::abs(cell.mean - published) <= half_unit) {
    return "=";
  }
  return published >= cell.least - half_unit && published <= cell.most + half_unit ? "~" : "x";
}

}  // namespace plumbline::spring_mass
