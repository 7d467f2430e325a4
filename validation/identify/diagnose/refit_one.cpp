#include "validation/identify/diagnose/refit_one.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "simulator/effects/parameters.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/predict/carried_states.h"

namespace plumbline::validation {
namespace {

/// From what the hypothesis promises, or a share of the way there.
Refit refit_from(double share, const Stage& stage, const Candidate& candidate, Hypothesis hypothesis,
                 const Data& data, const Effort& effort) {
  hypothesis.step *= share;
  if (share < 1.0) {
    hypothesis.x0 = hypothesis.x0.empty() ? hypothesis.x0 : stage.estimate.x0;
  }
  Refit result;
  result.candidate = hypothesis.candidate;
  result.extended = extend(stage, candidate, hypothesis.start);
  result.own = static_cast<int>(result.extended.parameters.size() - stage.parameters.size());
  result.added = {static_cast<int>(result.extended.model.effects.size()) - 1};
  const Eigen::VectorXd theta = promised_theta(result.extended, hypothesis);
  // The promised values decide whether states are added, so the model must hold them before it is built.
  result.extended.model = with_values(result.extended.model, result.extended.parameters, theta);
  PredictorPool pool(result.extended.model, data);
  // In the midst of a contact the states that a straight line promises may be none that can be.
  const std::vector<Eigen::VectorXd> x0 =
      data.has_segments()
          ? carried_states(fitted_model(stage), result.extended.model, data, stage.estimate.x0)
          : hypothesis.x0;
  // The way over the windows' beginnings is for the law that is new; what was there has gone it.
  const bool by_parts = effort.by_parts && jumps(result.extended.model.effects.back());
  result.estimate =
      gauss_newton(pool, result.extended.parameters, theta, x0, {effort.iterations, 5e-3, by_parts});
  result.extended.theta = result.estimate.theta;
  return result;
}

/// Every third window of either role, and what the stage, the hypothesis and a refit have for them.
class EveryThird {
 public:
  explicit EveryThird(const Data& data) : data_(data) {
    data_.windows.clear();
    for (const Role role : {Role::train, Role::held_out}) {
      const std::vector<int> all = data.windows_of(role);
      for (std::size_t i = 0; i < all.size(); i += 3) {
        kept_.push_back(static_cast<std::size_t>(all[i]));
        data_.windows.push_back(data.windows[kept_.back()]);
      }
    }
  }
  const Data& data() const { return data_; }
  Stage of(Stage stage) const {
    Estimate& estimate = stage.estimate;
    estimate.x0 = some(estimate.x0);
    estimate.square = some(estimate.square);
    estimate.scores = score(data_, estimate.square);
    estimate.predicted.square = some(estimate.predicted.square);
    estimate.predicted.scores = score(data_, estimate.predicted.square);
    return stage;
  }
  Hypothesis of(Hypothesis hypothesis) const {
    hypothesis.x0 = some(hypothesis.x0);
    return hypothesis;
  }
  double square_of(const Refit& refit) const {
    return score(data_, some(refit.estimate.predicted.square)).square();
  }

 private:
  std::vector<Eigen::VectorXd> some(const std::vector<Eigen::VectorXd>& all) const {
    std::vector<Eigen::VectorXd> few;
    for (const std::size_t w : kept_) {
      if (!all.empty()) {
        few.push_back(all[w]);
      }
    }
    return few;
  }
  Data data_;
  std::vector<std::size_t> kept_;  // indices of the windows
};

void continue_refit(Refit& refit, const Data& data, int iterations, double tolerance = kRefitTolerance) {
  PredictorPool pool(refit.extended.model, data);
  refit.estimate = gauss_newton(pool, refit.extended.parameters, refit.estimate.theta, refit.estimate.x0,
                                {iterations, tolerance, false});
  refit.extended.theta = refit.estimate.theta;
}

/// Where the sensors' noise is all that is left, a change of one in the sum of squares tells laws apart.
void settle_answer(Refit& refit, const Data& data) {
  constexpr int kIterations = 8;
  continue_refit(refit, data, kIterations, 1.0 / std::max(1.0, refit.estimate.cost));
}

/// The smoothing speed of a new friction, free beside the refit's parameters within what is slow against the
/// motion; none where its law has none.
std::optional<FreeParameter> smoothing_of(const Refit& refit, const effects::Scales& scales) {
  constexpr double kSlowest = 1e-4;  // of the motion's rms speed
  constexpr double kFastest = 0.3;   // faster it is viscous friction
  const auto e = static_cast<std::size_t>(refit.added.front());
  const model::EffectUse& use = refit.extended.model.effects[e];
  const std::vector<effects::Parameter>& parameters = use.law->declaration().parameters;
  const auto p = static_cast<std::size_t>(
      std::find_if(parameters.begin(), parameters.end(), effects::is_smoothing_speed) - parameters.begin());
  if (p == parameters.size() || refit.added.size() != 1) {
    return std::nullopt;
  }
  FreeParameter free;
  free.id = {refit.added.front(), static_cast<int>(p)};
  free.label = use.label() + ":" + parameters[p].name;
  free.scale = effects::Scale::logarithm;
  free.lower = kSlowest * scales.velocity;
  free.upper = kFastest * scales.velocity;
  free.typical = use.values[p].value;
  return free;
}

/// Where a motion rests, how friction fades towards standstill decides how far it creeps, and no start knows
/// that. It is fitted beside the others, kept where the cost falls by much, and a constant from then on: most
/// motions say nothing of it.
void fit_smoothing(Refit& refit, const FreeParameter& smoothing, const Data& data) {
  constexpr int kIterations = 10;
  constexpr double kMuch = 0.8;
  Refit wider = refit;
  wider.extended.parameters.push_back(smoothing);
  Eigen::VectorXd& theta = wider.estimate.theta;
  theta.conservativeResize(theta.size() + 1);
  theta[theta.size() - 1] = smoothing.typical;
  continue_refit(wider, data, kIterations);
  if (wider.estimate.cost > kMuch * refit.estimate.cost) {
    return;
  }
  Refit settled = refit;
  settled.extended.model = with_values(settled.extended.model, {smoothing}, wider.estimate.theta.tail(1));
  settled.estimate.x0 = wider.estimate.x0;
  settled.estimate.theta = wider.estimate.theta.head(wider.estimate.theta.size() - 1);
  continue_refit(settled, data, kIterations);
  if (settled.estimate.cost < refit.estimate.cost) {
    refit = std::move(settled);
  }
}

}  // namespace

bool jumps(const model::EffectUse& use) {
  const auto* law = dynamic_cast<const effects::ForceLaw*>(use.law.get());
  return law != nullptr && law->jumps(use.numbers().data()) > 0;
}

Refit refit_one(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                const Data& data, const Effort& effort) {
  constexpr double kWorse = 1.02;
  constexpr double kNear = 0.1;
  std::optional<Refit> best;
  std::string reason;
  for (const double share : {1.0, kNear}) {
    try {
      Refit one = refit_from(share, stage, candidate, hypothesis, data, effort);
      if (!best || one.estimate.cost < best->estimate.cost) {
        best = std::move(one);
      }
      if (!(best->estimate.scores.train > kWorse * stage.estimate.scores.train)) {
        break;
      }
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error& error) {
      reason = error.what();
    }
  }
  if (!best) {
    throw std::runtime_error(reason);
  }
  return *best;
}

double square_on_some(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                      const Data& data, const Effort& effort) {
  const EveryThird some(data);
  try {
    return refit_one(some.of(stage), candidate, some.of(hypothesis), some.data(), effort).square();
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
}

bool is_better_on_some(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                       const Data& data, const Effort& effort, const Refit& best) {
  return square_on_some(stage, candidate, hypothesis, data, effort) < EveryThird(data).square_of(best);
}

void finish_one(Refit& one, double square_before, const Candidate& candidate, const Data& data,
                const Policy& policy, const Progress& progress) {
  constexpr double kLeft = 0.1;   // of the squared error: what else is missing does not decide how it fades
  constexpr int kIterations = 8;  // and as many again
  constexpr double kStillFalls = 0.7;
  const std::optional<FreeParameter> smoothing = smoothing_of(one, candidate.scales);
  const bool is_answer = is_below(policy.finished, one.estimate, data);
  if (one.is_full || (one.estimate.converged && !smoothing && !is_answer)) {
    return;
  }
  progress("finishing " + candidate.label(), 0.9);
  one.is_full = true;
  Refit further = one;
  try {
    if (!one.estimate.converged) {
      continue_refit(further, data, kIterations);
    }
    // Where much else is missing the last values mean little.
    if (!further.estimate.converged &&
        (is_below(policy.far, further.estimate, data) || further.square() < kStillFalls * one.square())) {
      continue_refit(further, data, kIterations);
    }
    if (is_below(policy.finished, further.estimate, data)) {
      settle_answer(further, data);
    }
    one = std::move(further);
    const bool explains = one.square() < kLeft * square_before || is_below(policy.far, one.estimate, data);
    if (smoothing && explains && !data.has_segments() && !is_below(policy.at_floor, one.estimate, data)) {
      fit_smoothing(one, *smoothing, data);
    }
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return;  // where the fit would go it cannot be integrated: it stays where it is
  }
}

}  // namespace plumbline::validation
