// What the torques name, one effect after another.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/standard/torque_screen.h"

namespace plumbline::validation {

struct TorqueFinding : Named {
  FreeModel free;  ///< the model with it; it is the last effect
  double share = 0.0;
  std::vector<LawShare> rivals;  ///< with at least Policy::fair of the resamples
};

struct TorqueStage {
  FreeModel own;  ///< the model's own numbers alone
  std::vector<TorqueFinding> named;
  std::vector<LawShare> open;  ///< of the round after the last finding, most probable first
  double cutoff = 0.0;         ///< Hz
};

/// Rounds of torque_screen(), at most Policy::most_effects for each place that moves. Of its best candidates,
/// each fitted to the train trials, the one is named that is best in at least Policy::stable of block
/// resamples of train and held-out samples (by the likelihood of TorqueProblem, what is stated included, with
/// the penalty of torque_screen), with the model's own numbers alone among them, if by it the error of the
/// torque at some motor (rms on the held-out trials; on train, where there are none) falls by
/// Policy::material at least. Where another is the best, it is a rival only if it makes the first
/// superfluous: resamples count for the first, too, whose best is one beside which it is needed in
/// Policy::stable of them. Blocks are as long as the windows. Throws InputError as TorqueProblem does. Source
/// of the resampling by blocks: Kuensch, The jackknife and the bootstrap for general stationary observations,
/// Annals of Statistics 17(3), 1989.
TorqueStage torque_stage(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                         double cutoff, const Policy& policy, const Progress& progress);

}  // namespace plumbline::validation
