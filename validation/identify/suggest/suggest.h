// Which experiment would tell two explanations of the same trials apart, and how much of it that takes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/suggest/proposals.h"

namespace plumbline::validation {

/// An explanation of the trials: an effect, its values there and the error that it leaves.
struct Explanation {
  std::string name;  ///< "coulomb@mLA"
  model::Model model;
  std::vector<FreeParameter> parameters;  ///< the effect's own, free when it is held against other data
  Eigen::VectorXd theta;
  Scores scores;
};

/// Two explanations, by their places in the list, and how an experiment tells them apart.
struct PairSeparation {
  std::size_t one = 0, other = 0;
  double error = 0.0;    ///< what the wrong one leaves after a refit, floors (1: cannot be told)
  double seconds = 0.0;  ///< of such data until the mean difference is three standard errors; infinite: never
};

/// How an experiment tells explanations apart: of the pairs that any experiment separates, the worst counts.
struct Separation {
  std::string name, text;  ///< of the proposal; text: its file
  double share = 0.0;      ///< of the reach that the motion's range allowed
  std::vector<PairSeparation> pairs;
  double error = 0.0;    ///< what the wrong explanation leaves after a refit, floors (1: cannot be told)
  double seconds = 0.0;  ///< of such data until the mean difference is three standard errors; infinite: never
};

struct Suggestions {
  std::vector<Explanation> explanations;
  std::vector<Separation> experiments;  ///< best first
  /// Pairs of names that no experiment separates: one answer under two names.
  std::vector<std::pair<std::string, std::string>> inseparable;
  int refused = 0;  ///< proposals that would leave the range of the motion
};

/// Explains the trials by each of the named effects ("coulomb@mLA"), plays every proposal on each explanation
/// as a twin, and refits the others to what its sensors show. Throws InputError when a name is unknown, when
/// the trials cannot show such an effect, and when fewer than two are named.
Suggestions suggest(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                    const std::vector<std::string>& names, const Progress& progress);

}  // namespace plumbline::validation
