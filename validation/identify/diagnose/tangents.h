// One linearisation for all laws that can be linearised at their null value.
#pragma once

#include <utility>
#include <vector>

#include "validation/identify/diagnose/promise.h"
#include "validation/identify/diagnose/screen.h"

namespace plumbline::validation {

/// Two hypotheses together, and what they promise.
struct PairHypothesis {
  Hypothesis first, second;
  double promised_train = 0.0, promised_held_out = 0.0;  ///< mean squares in floor units
  Eigen::VectorXd step;  ///< stage parameters, then the first's, then the second's (search units)
  double promised() const { return promised_train + promised_held_out; }
};

/// One model with every candidate in it at its null value predicts as the stage does, and one linearisation
/// serves all of them, alone and in company.
class Tangents {
 public:
  /// `hypotheses` start at null values of laws without states and without coordinates of their own.
  Tangents(const Stage& stage, const std::vector<Candidate>& candidates,
           const std::vector<Hypothesis>& hypotheses, const Data& data);

  /// What each promises alone; without those that hardly move the prediction.
  std::vector<Hypothesis> promises() const;

  /// The `most` pairs of candidates that promise most together, best first, each from its best starts.
  std::vector<PairHypothesis> pairs(std::size_t most) const;

 private:
  struct Solution {
    std::vector<Eigen::Index> chosen;
    Promise promise;
  };
  Solution solve(const std::vector<std::size_t>& some) const;
  Hypothesis promised(std::size_t h) const;
  std::vector<Eigen::VectorXd> states_after(const Solution& solution) const;
  Eigen::VectorXd full_step(const Solution& solution, const std::vector<std::size_t>& some) const;
  std::vector<std::pair<std::size_t, std::size_t>> shortlist(std::size_t most) const;

  const Stage& stage_;
  std::vector<Hypothesis> hypotheses_;
  int threads_;
  std::vector<std::vector<Eigen::Index>> own_;     // columns of each hypothesis
  std::vector<std::vector<Eigen::Index>> moving_;  // those of them that matter
  std::vector<Reduced> reduced_;                   // by window
  LinearProblem problem_;
};

/// What each of the hypotheses promises alone, as Tangents::promises(), in lots of at most kMostColumns
/// parameters: a linearisation's cost grows with the square of what it holds.
std::vector<Hypothesis> promises_of(const Stage& stage, const std::vector<Candidate>& candidates,
                                    const std::vector<Hypothesis>& hypotheses, const Data& data);

/// Of hypotheses, the most promising first, as many as one linearisation holds: the best start of each
/// candidate, then the others.
std::vector<Hypothesis> first_lot(const std::vector<Candidate>& candidates,
                                  std::vector<Hypothesis> hypotheses);

/// A law that can be linearised at its null value: it brings no state and no coordinate.
bool has_tangent(const Candidate& candidate, const effects::Values& start);

}  // namespace plumbline::validation
