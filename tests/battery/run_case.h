// One case from the hidden effect to the verdict.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/battery/cases.h"
#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/predict/kept_results.h"

namespace plumbline::battery {

constexpr double kVisible = 1.15;      ///< held-out error, in floors, from which an effect must be found
constexpr std::size_t kMostNames = 2;  ///< a set of more names is no answer

/// Who makes the data: the simulator that is tested (own), or equations of motion by hand with an integrator,
/// a friction and a contact of their own (lagrangian), or MuJoCo.
enum class World { own, lagrangian, mujoco };
std::string to_string(World world);

/// A fitted value of a rightly named effect, beside the one that was hidden; SI.
struct Recovered {
  std::string name;
  double truth = 0.0, value = 0.0, deviation = 0.0;
  bool is_inside() const;  ///< its 95 % interval holds the truth
};

struct Result {
  Case one;
  std::string with;      ///< what was hidden, as `plumbline twin --with` reads it, joined by spaces
  double bare = 0.0;     ///< held-out error of the model as it is, in floors; nothing fitted
  bool visible = false;  ///< `before` is at least kVisible
  /// What is hidden shows that far at best, in floors, by the foreign world alone (worlds/visibility.h); 0:
  /// data of our own, `before` decides.
  double shown = 0.0;
  std::string verdict;
  std::string first;   ///< first effect named, "coulomb@mLA"; empty: none
  std::string others;  ///< further accepted effects, joined by spaces
  int set_size = 0;    ///< the first name and its rivals, without those that are the same force on the robot
  int invented = 0;    ///< accepted names that are neither hidden nor, in a lab, scattered
  /// hidden: named first, or in a set of at most kMostNames; pair: so for both, and nothing else;
  /// none: nothing named; removed, foreign: no verdict "missing"
  bool right = false;
  bool in_set = false;  ///< hidden: named, in a set of whatever size
  bool alone = false;   ///< right without the help of a rival set: every hidden effect named itself
  /// Held-out error before anything was named: what the hidden effect does beyond what an honest change of
  /// the model's own numbers can do, where these were freed.
  double before = 0.0;
  double after = 0.0;              ///< held-out error with all that was accepted
  double seconds = 0.0;            ///< wall time
  double processor_seconds = 0.0;  ///< of all threads together
  std::vector<Recovered> recovered;
  std::vector<validation::PairRow> pairs;           ///< tried together
  std::vector<validation::RankRow> ranking, leads;  ///< first round's candidates; the last round's rejected
  std::string error;                                ///< why the case could not be run; empty otherwise
};

struct RunOptions {
  std::uint64_t seed = 1;
  World world = World::own;
  bool lab = false;         ///< numbers without a stated uncertainty are scattered, too; foreign worlds only
  bool tolerances = false;  ///< the model that is diagnosed states how well it knows them
  bool bare_only = false;   ///< held-out trials only and no diagnosis
  bool as_stated =
      false;            ///< the robot's own numbers are exactly those of the model, not scattered about them
  std::string write{};  ///< folder into which each case's trials are written, nothing diagnosed; empty: none
  bool timing = false;  ///< what the diagnosis does, and when, to the standard error
  validation::Policy policy{};
  std::shared_ptr<validation::KeptResults>
      kept{};  ///< of diagnoses of the same case; none: of this one alone
};

/// Why the world does not play the case; empty: it does.
std::string why_not(const Case& one, World world);

/// Never throws for a case that fails: the reason is in Result::error.
Result run_case(const Case& one, const RunOptions& options);

/// Trials of a real machine, of which nothing is known but what they show: folders, with the model that the
/// first of them names.
struct Measured {
  std::vector<std::string> trials;
  std::string data_folder;  ///< in place of that of the trials' files; empty: as they say
};

/// The same of measurements: nothing is right or wrong.
Result run_measured(const Measured& measured, const RunOptions& options);

}  // namespace plumbline::battery
