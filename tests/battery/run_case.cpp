#include "tests/battery/run_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/battery/draw.h"
#include "tests/battery/foreign_laws.h"
#include "tests/battery/foreign_told.h"
#include "tests/battery/truth.h"
#include "tests/battery/worlds/lab.h"
#include "tests/battery/worlds/play.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/trial/write_trial.h"
#include "validation/identify/twin/twin.h"
#include "work/workers.h"

namespace plumbline::battery {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// In foreign worlds the friction of a loaded drive follows what its gear passes on: of the catalogue's two
/// laws for it either is its name.
bool names(const model::EffectUse& truth, const std::string& effect, const std::string& at) {
  const std::string& hidden = truth.law->declaration().name;
  return truth.at == at && (hidden == effect || (hidden == "load_friction" && effect == "gear_friction"));
}

/// The finding and its rivals; what is one force under two names on the robot counts once.
std::size_t set_size(const validation::Finding& finding) {
  return 1 +
         static_cast<std::size_t>(std::count_if(finding.rivals.begin(), finding.rivals.end(),
                                                [](const validation::Rival& rival) { return !rival.same; }));
}

/// Is the truth what the finding names, or one of a set of at most so many?
bool finds(const validation::Finding& finding, const model::EffectUse& truth, std::size_t most_names) {
  return names(truth, finding.effect, finding.at) ||
         std::any_of(finding.rivals.begin(), finding.rivals.end(), [&](const validation::Rival& rival) {
           return (rival.same || set_size(finding) <= most_names) &&
                  names(truth, rival.name.effect, rival.name.at);
         });
}

void recover(const validation::Finding& finding, const model::EffectUse& truth, Result& result) {
  for (const validation::ParameterValue& fitted : finding.parameters) {
    if (!fitted.chosen) {
      const auto index = static_cast<std::size_t>(truth.law->parameter_index(fitted.name));
      result.recovered.push_back(
          {finding.label() + ":" + fitted.name, truth.values[index].value, fitted.value, fitted.deviation});
    }
  }
}

/// Is it among what is hidden, itself or as a name that the data or the robot cannot tell from it?
bool is_of(const std::vector<model::EffectUse>& hidden, const validation::Finding& finding) {
  return std::any_of(hidden.begin(), hidden.end(),
                     [&](const model::EffectUse& truth) { return finds(finding, truth, kMostNames); });
}

/// In a lab more is off than what is hidden, and to say so is right.
int count_invented(const validation::Diagnosis& diagnosis, const std::vector<model::EffectUse>& hidden,
                   bool lab) {
  return static_cast<int>(std::count_if(
      diagnosis.accepted.begin(), diagnosis.accepted.end(), [&](const validation::Finding& finding) {
        return !is_of(hidden, finding) && !(lab && worlds::is_of_the_lab(finding.effect));
      }));
}

bool names_itself(const validation::Diagnosis& diagnosis, const model::EffectUse& truth) {
  return std::any_of(
      diagnosis.accepted.begin(), diagnosis.accepted.end(),
      [&](const validation::Finding& finding) { return names(truth, finding.effect, finding.at); });
}

bool is_right(const validation::Diagnosis& diagnosis, const std::vector<model::EffectUse>& hidden, Kind kind,
              bool lab) {
  const auto is_found = [&](const model::EffectUse& truth) {
    return std::any_of(diagnosis.accepted.begin(), diagnosis.accepted.end(),
                       [&](const validation::Finding& finding) { return finds(finding, truth, kMostNames); });
  };
  const bool nothing_invented = count_invented(diagnosis, hidden, lab) == 0;
  switch (kind) {
    case Kind::none:
      return nothing_invented;
    case Kind::removed:
    case Kind::foreign:
      return diagnosis.verdict != validation::Verdict::missing;
    case Kind::pair:
      return nothing_invented && diagnosis.accepted.size() >= 2 &&
             std::all_of(hidden.begin(), hidden.end(), is_found) && (lab || diagnosis.accepted.size() == 2);
    case Kind::hidden:
      break;
  }
  return lab ? nothing_invented && is_found(hidden.front())
             : !diagnosis.accepted.empty() && finds(diagnosis.accepted.front(), hidden.front(), kMostNames);
}

void judge(const validation::Diagnosis& diagnosis, const std::vector<model::EffectUse>& hidden,
           const RunOptions& options, Result& result) {
  result.verdict = to_string(diagnosis.verdict);
  // Values that the held-out trials have helped to choose predict them no more.
  const bool open = std::any_of(diagnosis.accepted.begin(), diagnosis.accepted.end(),
                                [](const validation::Finding& finding) { return finding.open_in_train; });
  const validation::Rung& last = diagnosis.ladder.back();
  result.after = open ? last.foretold() : last.held_out();
  result.before = diagnosis.bare().foretold();
  result.visible = (options.world == World::own ? result.before : result.shown) >= kVisible;
  result.ranking = diagnosis.ranking;
  result.leads = diagnosis.leads;
  result.pairs = diagnosis.pairs;
  result.right = is_right(diagnosis, hidden, result.one.kind, options.lab);
  result.invented = count_invented(diagnosis, hidden, options.lab);
  result.alone = result.right && std::all_of(hidden.begin(), hidden.end(), [&](const model::EffectUse& one) {
                   return names_itself(diagnosis, one);
                 });
  result.in_set = result.one.kind == Kind::hidden && !diagnosis.accepted.empty() &&
                  finds(diagnosis.accepted.front(), hidden.front(), set_size(diagnosis.accepted.front()));
  for (std::size_t i = 0; i < diagnosis.accepted.size(); ++i) {
    const validation::Finding& finding = diagnosis.accepted[i];
    const std::string name = finding.label();
    if (i == 0) {
      result.first = name;
      result.set_size = static_cast<int>(set_size(finding));
    } else {
      result.others += (i > 1 ? " " : "") + name;
    }
    for (const model::EffectUse& one : hidden) {
      if (names(one, finding.effect, finding.at) && one.law->declaration().source != "test only") {
        recover(finding, one, result);
      }
    }
  }
}

effects::Catalogue catalogue_of(const Case& one) {
  effects::Catalogue catalogue = model::known_effects();
  for (const std::string& law : one.removed) {
    catalogue = catalogue.without(law);
  }
  return catalogue;
}

/// Each line once, with the seconds since now.
validation::Progress timed_lines() {
  return [start = Clock::now(), last = std::string()](const std::string& what, double /*fraction*/) mutable {
    if (what != last) {
      fmt::print(stderr, "{:8.1f} {}\n", seconds_since(start), what);
      last = what;
    }
  };
}

void print_ladder(const validation::Diagnosis& diagnosis) {
  for (const validation::Rung& rung : diagnosis.ladder) {
    fmt::print(stderr,
               "{:8.3f} floors in train, {:.3f} held out ({:.3f} foretold) on windows of {:.3g} s: {}\n",
               rung.train(), rung.held_out(), rung.foretold(), rung.length, rung.name);
  }
}

/// The trials of the case, by whoever makes them.
std::vector<validation::Trial> made(const RunOptions& options, const model::Model& bare, Draw& draw,
                                    std::vector<model::EffectUse>& hidden, Result& result) {
  const Case& one = result.one;
  const std::string reason = why_not(one, options.world);
  if (!reason.empty()) {
    throw std::invalid_argument(reason);
  }
  if (options.world == World::own) {
    const Truth truth = truth_of(one, bare, draw, options);
    hidden = truth.hidden;
    result.with = truth.text;
    return trials_of(one, bare, truth, draw, options);
  }
  const model::Model places = one.kind == Kind::foreign ? with_foreign_places(bare) : bare;
  std::vector<std::string> texts;
  for (const Row& row : one.rows) {
    texts.push_back(drawn_effect(row, one.strength, every_law(), draw));
    hidden.push_back(validation::parse_effect(texts.back(), places, every_law()));
  }
  worlds::Played played = worlds::play(
      one, bare, texts, draw,
      {options.seed, options.bare_only, options.as_stated, options.lab, options.world == World::mujoco});
  result.with = played.text;
  result.shown = played.visible;
  return std::move(played.trials);
}

/// FOLDER/pendulum_coulomb@drive_weak/1 and so on, as `plumbline diagnose` reads them.
void write(const std::string& folder, const Case& one, const model::Model& bare,
           const std::vector<validation::Trial>& trials) {
  std::string name = one.name;
  std::replace(name.begin(), name.end(), '/', '_');
  for (std::size_t t = 0; t < trials.size(); ++t) {
    std::filesystem::create_directories(folder + "/" + name);
    validation::write_trial(trials[t], bare, folder + "/" + name + "/" + std::to_string(t + 1));
  }
}

void diagnose_all(const model::Model& bare, std::vector<validation::Trial> trials,
                  const std::vector<model::EffectUse>& hidden, const RunOptions& options, Result& result) {
  const Case& one = result.one;
  validation::Data data(std::move(trials), {});
  data.threads = work::cores();
  data.kept = options.kept;
  result.bare = validation::compare(bare, data).scores.held_out;
  if (!options.bare_only) {
    const validation::Progress silent = [](const std::string& /*what*/, double /*fraction*/) {};
    const validation::Progress progress = options.timing ? timed_lines() : silent;
    const validation::Diagnosis diagnosis =
        validation::diagnose(options.tolerances ? worlds::with_tolerances(bare) : bare, catalogue_of(one),
                             data, options.policy, progress);
    if (options.timing) {
      print_ladder(diagnosis);
    }
    judge(diagnosis, hidden, options, result);
  }
}

void run(const RunOptions& options, Result& result) {
  const Case& one = result.one;
  const model::Model bare =
      model::read_model(std::string(PLUMBLINE_ROOT) + "/" + robot_of(one).model, model::known_effects());
  Draw draw(one, options.seed);
  std::vector<model::EffectUse> hidden;
  std::vector<validation::Trial> trials = made(options, bare, draw, hidden, result);
  if (!options.write.empty()) {
    write(options.write, one, bare, trials);
    return;
  }
  diagnose_all(bare, std::move(trials), hidden, options, result);
}

Result timed(const Case& one, const std::function<void(Result&)>& work) {
  Result result;
  result.one = one;
  const Clock::time_point start = Clock::now();
  const std::clock_t processor = std::clock();
  try {
    work(result);
  } catch (const std::exception& error) {
    result.error = error.what();
  }
  result.seconds = seconds_since(start);
  result.processor_seconds = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace

std::string to_string(World world) {
  return world == World::own ? "own" : world == World::lagrangian ? "lagrangian" : "mujoco";
}

bool Recovered::is_inside() const {
  constexpr double kDeviations = 1.96;
  return std::abs(value - truth) <= kDeviations * deviation;
}

std::string why_not(const Case& one, World world) {
  if (world != World::own) {
    return worlds::why_not(one, world == World::mujoco);
  }
  const auto told =
      std::find_if(one.rows.begin(), one.rows.end(), [](const Row& row) { return is_told(row.effect); });
  return told == one.rows.end() ? "" : "only the foreign worlds have " + told->effect;
}

Result run_case(const Case& one, const RunOptions& options) {
  return timed(one, [&](Result& result) { run(options, result); });
}

Result run_measured(const Measured& measured, const RunOptions& options) {
  Case one;
  one.kind = Kind::foreign;
  one.name = measured.trials.front();
  return timed(one, [&](Result& result) {
    const model::Model model =
        model::read_model(validation::model_of_trial(measured.trials.front()), model::known_effects());
    validation::TrialOptions how;
    how.data_folder = measured.data_folder;
    std::vector<validation::Trial> trials;
    for (const std::string& path : measured.trials) {
      trials.push_back(validation::read_trial(path, model, how));
    }
    diagnose_all(model, std::move(trials), {}, options, result);
  });
}

}  // namespace plumbline::battery
