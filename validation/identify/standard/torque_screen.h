// Which effect of the catalogue the torques of a measured motion ask for.
#pragma once

#include <string>
#include <vector>

#include "simulator/effects/catalogue.h"
#include "validation/identify/diagnose/screen.h"
#include "validation/identify/standard/torque_problem.h"

namespace plumbline::validation {

/// One effect at one place, at the values that suit the torques best together with the model's own.
struct TorqueCandidate {
  std::string law, at;
  std::vector<std::string> parameters;  ///< labels of those that were fitted
  FreeModel free;                       ///< the effect is the model's last
  int choices = 1;    ///< of constants that are chosen and not fitted (cycles a turn): as many were tried
  double gain = 0.0;  ///< fall of the Bayesian information criterion against the model's own numbers alone
  std::string label() const { return law + "@" + at; }
};

struct TorqueScreen {
  FreeModel own;  ///< numbers that the model states with an uncertainty, as the torques ask
  std::vector<TorqueCandidate> ranked;  ///< best first; those that gain nothing are left out
};

/// Equation error: instead of predicting the motion, which far from the right model says little, the torques
/// that the measured motion needs are held against the recorded ones (TorqueProblem), first with the model's
/// own stated numbers alone, then with each law at each place beside them. What is compared is the Bayesian
/// information criterion
///   BIC = cost + k log N + 2 log m,  N independent samples of all motors, k fitted values of the candidate,
/// m choices of what it does not fit, each as likely beforehand, whose noise is what is left of the torques,
/// so that a model that is wrong elsewhere makes no candidate certain. Laws with states of their own,
/// released ratios and sensors' errors cannot be asked so. A value at a limit of what the robot can be is
/// none: such a candidate is left out. `own` is searched first; what it names already is no candidate.
/// Source: Ljung, System Identification, 2nd ed. 1999, 7.2 (equation error); Schwarz, Estimating the
/// dimension of a model, Annals of Statistics 6(2), 1978.
TorqueScreen torque_screen(const TorqueProblem& problem, FreeModel own, const effects::Catalogue& catalogue,
                           const Data& data, const Progress& progress);

/// What the criterion charges for fitted values and choices.
double penalty_of(std::size_t fitted, int choices, const TorqueProblem& problem);

/// The model with every number open that states an uncertainty, at what is stated.
FreeModel own_numbers(const model::Model& model);

}  // namespace plumbline::validation
