// Estimates of chosen parameters, how sure they are, and what the data cannot tell.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/screen.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {

struct FitOptions {
  int iterations = 40;
  double tolerance = 1e-7;  ///< relative change of the cost at which it stops
  double confidence = 0.95;
  double uncertain = 0.5;  ///< standard deviation as a share of the value from which a value is doubted
  double tied = 0.98;      ///< correlation from which two parameters are called inseparable
  double explained = 1.2;  ///< train error, floors, above which more is missing than values
  bool whole = false;      ///< recordings in one piece, without derivatives (whole_fit.h)
};

/// Why a value should not be taken at its word.
struct Doubt {
  std::string kind;  ///< "unseen", "uncertain", "tied", "at_bound", "few_windows"
  std::string text;  ///< in plain words
};

struct FittedParameter {
  std::string label, unit;
  double before = 0.0, after = 0.0;
  double deviation = 0.0;           ///< one standard deviation, held against the cost (profile.h)
  double lower = 0.0, upper = 0.0;  ///< confidence interval
  std::string partner;              ///< the parameter with the strongest correlation; empty: none
  double correlation = 0.0;
  double degrees_of_freedom = 0.0;  ///< behind its deviation
  std::vector<Doubt> doubts;
  bool seen() const;  ///< false: the data do not depend on it, and the value was left as it was
};

struct Fit {
  Scores before, after;
  std::vector<FittedParameter> parameters;
  model::Correlations together{};  ///< how their deviations hang together
  int windows = 0;                 ///< train windows
  int iterations = 0;
  bool converged = false;
  bool whole = false;  ///< of fit_whole: `windows` are recordings, `iterations` generations
};

/// Fits the parameters on the train trials and predicts the held-out ones and the tests. The interval is
///   after - t * below to after + t * above, t = t(confidence, degrees of freedom),
/// taken along the line on which the parameter is searched (its value, logarithm or reciprocal), so that it
/// stays physical, with deviations to either side that are held against the cost (predict/profile.h). Source
/// of t: W. S. Gosset ("Student"), Biometrika 6 (1908) 1-25, by Boost.Math. Throws InputError when there is
/// no train trial or a parameter cannot leave its null value.
Fit fit(const model::Model& model, const Data& data, std::vector<FreeParameter> parameters,
        const FitOptions& options, const Progress& progress);

/// Two-sided quantile of Student's t; infinite for less than one degree of freedom.
double student_quantile(double confidence, double degrees_of_freedom);

/// The numbers of a fit that its doubts rest on.
struct FitNumbers {
  Eigen::VectorXd before, after;
  Precision precision;
};

/// What speaks against taking the value at its word; `seen`: the data depend on it.
void add_doubts(const FreeParameter& parameter, bool seen, const FitOptions& options,
                FittedParameter& fitted);

/// Intervals, partners and doubts.
std::vector<FittedParameter> judge(const std::vector<FreeParameter>& parameters, const FitNumbers& numbers,
                                   const FitOptions& options);

}  // namespace plumbline::validation
