// The leg bench and its experiment, as the limit tests use them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::limits {

/// Left leg of robots/mabel.
model::Model leg_bench();

/// Both motors at once (experiments/mimo.yaml), its first `duration` seconds.
validation::Experiment both_motors(const model::Model& model, double duration);

/// The model with one effect more.
model::Model with_effect(model::Model model, const std::shared_ptr<const effects::Law>& law,
                         const std::string& at, const effects::Values& values);
model::Model with_effect(const model::Model& model, const std::string& law, const std::string& at,
                         const effects::Values& values);

/// explicit_rk at a relative tolerance, absolute tolerance a hundredth of it.
run::CommandedOptions options_at(double relative_tolerance);

run::CommandedRun simulate(const model::Model& model, const validation::Experiment& experiment,
                           const run::CommandedOptions& options);

/// The linear map from the plant's independent coordinates to named ones: named = offset + map * z.
struct NamedMap {
  Eigen::MatrixXd map;
  Eigen::VectorXd offset;
};
NamedMap named_map(const model::Plant& plant, const std::vector<std::string>& names);

/// Largest difference of a sensor's course between two runs.
double largest_difference(const run::CommandedRun& one, const run::CommandedRun& other);

/// Typical magnitudes at a place from a run of the model without the effect.
effects::Scales scales_of(const model::Model& model, const run::CommandedRun& run, effects::Place place,
                          const std::string& at);

/// A value for every parameter: the law's first start, with amplitudes that are null there at a tenth of
/// their typical value.
effects::Values tenth_of_typical(const effects::Law& law, const effects::Scales& scales);

}  // namespace plumbline::limits
