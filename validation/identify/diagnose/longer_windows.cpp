#include "validation/identify/diagnose/longer_windows.h"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "simulator/trace/error.h"
#include "validation/identify/diagnose/judged.h"

namespace plumbline::validation {
namespace {

/// Independent positions that no channel of the trial shows.
Eigen::Index unseen(const model::Model& model, const Trial& trial) {
  const model::Plant plant(model, {});
  const std::vector<model::Observation> channels = start_observations(plant, trial);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(channels.size()), plant.positions());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    rows.row(static_cast<Eigen::Index>(c)) = channels[c].row;
  }
  return channels.empty() ? plant.positions() : plant.positions() - rows.colPivHouseholderQr().rank();
}

/// The trials in windows twice as long, as many samples of each role.
std::optional<Data> twice_as_long(const Data& data) {
  double longest = 0.0;
  for (const Window& window : data.windows) {
    const Trial& trial = data.trials[static_cast<std::size_t>(window.trial)];
    longest = std::max(longest, static_cast<double>(window.count) * trial.period);
  }
  PredictOptions options = data.predict;
  options.window = 2.0 * longest;
  try {
    Data longer(data.trials, options);
    longer.threads = data.threads;
    longer.stop = data.stop;
    const std::size_t most =
        std::max(data.windows_of(Role::train).size(), data.windows_of(Role::held_out).size());
    return longer.thinned((most + 1) / 2);
  } catch (const InputError&) {
    return std::nullopt;  // a trial is shorter than that
  }
}

/// Infinite where the model cannot be integrated that far.
double error_of(const model::Model& model, const Data& data) {
  PredictorPool pool(model, data);
  try {
    return judged(estimate_states(pool).scores, data);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

std::string short_lived(const Stage& stage, const Refit& refit, const Data& data, const Policy& policy) {
  const Stage found = after(refit);
  if (unseen(found.model, data.trials.front()) <= unseen(stage.model, data.trials.front())) {
    return "";
  }
  const std::optional<Data> longer = twice_as_long(data);
  if (!longer) {
    return "";
  }
  const double before = error_of(fitted_model(stage), *longer);
  const double behind = error_of(fitted_model(found), *longer);
  return behind < (1.0 - policy.material) * before
             ? ""
             : "short-lived: on windows twice as long it predicts no better, and what no sensor shows begins "
               "anew in each";
}

}  // namespace plumbline::validation
