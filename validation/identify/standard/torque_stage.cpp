#include "validation/identify/standard/torque_stage.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "validation/identify/diagnose/family.h"

namespace plumbline::validation {
namespace {

constexpr double kMotionCutoff = 100.0;  // Hz
constexpr std::size_t kContenders = 8;

TorqueBlocks joined(const TorqueBlocks& a, const TorqueBlocks& b) {
  TorqueBlocks all{Eigen::MatrixXd(a.squares.rows(), a.squares.cols() + b.squares.cols()), {}};
  all.samples = all.squares;
  all.squares << a.squares, b.squares;
  all.samples << a.samples, b.samples;
  return all;
}

/// Minus twice the logarithm of the likelihood of these blocks.
double misfit(const TorqueBlocks& blocks, const std::vector<Eigen::Index>& drawn, double independent) {
  const Eigen::VectorXd squares = blocks.squares(Eigen::all, drawn).rowwise().sum();
  const Eigen::VectorXd samples = blocks.samples(Eigen::all, drawn).rowwise().sum();
  double sum = 0.0;
  for (Eigen::Index m = 0; m < squares.size(); ++m) {
    if (samples[m] > 0.0 && squares[m] > 0.0) {
      sum += independent * samples[m] * std::log(squares[m] / samples[m]);
    }
  }
  return sum;
}

/// Logarithms of the motors' root mean squares; 0 where nothing is left, or nothing was recorded.
Eigen::VectorXd log_errors_of(const TorqueBlocks& blocks) {
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(blocks.squares.rows());
  for (Eigen::Index m = 0; m < errors.size(); ++m) {
    const double samples = blocks.samples.row(m).sum();
    const double squares = blocks.squares.row(m).sum();
    errors[m] = samples > 0.0 && squares > 0.0 ? 0.5 * std::log(squares / samples) : 0.0;
  }
  return errors;
}

struct Judgement {
  TorqueBlocks blocks;         ///< of all trials
  Eigen::VectorXd log_errors;  ///< of those that count, by motor
  double penalty = 0.0;
};

/// Train and held-out trials, cut into blocks.
class Judge {
 public:
  Judge(const model::Model& model, const Data& data, const Cutoffs& cutoffs, const TorqueProblem& train)
      : train_(train), length_(data.predict.window) {
    if (data.has(Role::held_out)) {
      held_out_.emplace_back(model, data, cutoffs, Role::held_out);
    }
  }

  /// With as many `further` values than the model's own numbers, and choices of what is not fitted.
  Judgement judged(const FreeModel& free, std::size_t further, int choices = 1) const {
    const model::Model model = identified(free);
    Judgement one;
    one.blocks = train_.blocks(model, length_);
    one.penalty = stated_misfit(free) + penalty_of(further, choices, train_);
    one.log_errors = log_errors_of(one.blocks);
    if (!held_out_.empty()) {
      const TorqueBlocks unseen = held_out_.front().blocks(model, length_);
      one.log_errors = log_errors_of(unseen);
      one.blocks = joined(one.blocks, unseen);
    }
    return one;
  }

  /// By model the share of the resamples in which it is the best.
  std::vector<double> shares(const std::vector<Judgement>& models, const Policy& policy) const {
    std::mt19937 random(policy.seed);
    const Eigen::Index count = models.front().blocks.squares.cols();
    std::uniform_int_distribution<Eigen::Index> any(0, count - 1);
    std::vector<double> shares(models.size());
    std::vector<Eigen::Index> drawn(static_cast<std::size_t>(count));
    for (int i = 0; i < policy.resamples; ++i) {
      std::generate(drawn.begin(), drawn.end(), [&] { return any(random); });
      std::size_t best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < models.size(); ++k) {
        const double one = misfit(models[k].blocks, drawn, train_.independent_share()) + models[k].penalty;
        if (one < least) {
          least = one;
          best = k;
        }
      }
      shares[best] += 1.0 / policy.resamples;
    }
    return shares;
  }

 private:
  const TorqueProblem& train_;
  std::vector<TorqueProblem> held_out_;
  double length_;
};

/// A mass that was added to a body, and a centre of mass that was shifted, are what something that hangs
/// there does: where a payload suits the torques as well, values not counted, it is the name.
struct Load {
  FreeModel free;
  double share = 0.0;  ///< of the resamples in which it suits them better than the other
};

std::optional<Load> payload_for(const TorqueCandidate& named, const TorqueProblem& problem,
                                const Judge& judge, const TorqueScreen& screen, const Policy& policy) {
  if (!may_be_payload(named.law)) {
    return {};
  }
  const auto found =
      std::find_if(screen.ranked.begin(), screen.ranked.end(),
                   [&](const TorqueCandidate& one) { return one.law == "payload" && one.at == named.at; });
  if (found == screen.ranked.end()) {
    return {};
  }
  Load load{found->free, 0.0};
  problem.search(load.free);
  if (std::any_of(load.free.values.begin(), load.free.values.end(),
                  [](const FreeValue& value) { return value.is_unphysical(); })) {
    return {};
  }
  load.share = judge.shares({judge.judged(load.free, 0), judge.judged(named.free, 0)}, policy).front();
  return load.share < policy.fair ? std::nullopt : std::optional<Load>(std::move(load));
}

/// One model with the effects that two candidates add to the same numbers.
FreeModel with_both(FreeModel a, const FreeModel& b, std::size_t common) {
  a.model.effects.push_back(b.model.effects.back());
  const int effect = static_cast<int>(a.model.effects.size()) - 1;
  for (std::size_t i = common; i < b.values.size(); ++i) {
    a.values.push_back(b.values[i]);
    a.values.back().id.effect = effect;
  }
  return a;
}

/// What a round says of its candidates, in the order of the screen.
struct Round {
  std::vector<LawShare> shares;
  std::vector<double> falls;  ///< of the error at the motor where it falls most, a share of it
  std::vector<Judgement> judged;
};

Round judged_round(const Judge& judge, const TorqueScreen& screen, const Policy& policy) {
  std::vector<Judgement> models{judge.judged(screen.own, 0)};
  const std::size_t count = std::min(kContenders, screen.ranked.size());
  for (std::size_t i = 0; i < count; ++i) {
    const FreeModel& free = screen.ranked[i].free;
    models.push_back(
        judge.judged(free, free.values.size() - screen.own.values.size(), screen.ranked[i].choices));
  }
  const std::vector<double> shares = judge.shares(models, policy);
  Round round;
  for (std::size_t i = 0; i < count; ++i) {
    LawShare one;
    one.effect = screen.ranked[i].law;
    one.at = screen.ranked[i].at;
    one.share = shares[i + 1];
    round.shares.push_back(one);
    const Eigen::VectorXd risen = models[i + 1].log_errors - models.front().log_errors;
    round.falls.push_back(1.0 - std::exp(risen.minCoeff()));
  }
  round.judged.assign(std::make_move_iterator(models.begin() + 1), std::make_move_iterator(models.end()));
  return round;
}

/// Two effects that are both there are no rivals, though each is the best in some resamples. The share of the
/// resamples that speak for candidate `index`: its own, and those of each other beside which it is needed as
/// well. Those are taken from `others`.
double needed_share(const TorqueProblem& problem, const Judge& judge, const TorqueScreen& screen,
                    const Round& round, std::size_t index, const Policy& policy,
                    std::vector<LawShare>& others) {
  const std::size_t own = screen.own.values.size();
  double share = round.shares[index].share;
  for (std::size_t i = 0; i < round.shares.size(); ++i) {
    const LawShare& other = round.shares[i];
    if (i == index || other.share < policy.fair) {
      continue;
    }
    FreeModel both = with_both(screen.ranked[i].free, screen.ranked[index].free, own);
    const std::size_t further = both.values.size() - own;
    problem.search(both);
    const int choices = screen.ranked[i].choices * screen.ranked[index].choices;
    if (judge.shares({judge.judged(both, further, choices), round.judged[i]}, policy).front() >=
        policy.stable) {
      share += other.share;
      others.erase(std::remove_if(others.begin(), others.end(),
                                  [&](const LawShare& one) { return one.label() == other.label(); }),
                   others.end());
    }
  }
  return share;
}

bool is_more_probable(const LawShare& a, const LawShare& b) { return a.share > b.share; }

}  // namespace

TorqueStage torque_stage(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                         double cutoff, const Policy& policy, const Progress& progress) {
  const Cutoffs cutoffs{kMotionCutoff, cutoff};
  const TorqueProblem problem(model, data, cutoffs);
  const Judge judge(model, data, cutoffs, problem);
  TorqueStage stage;
  stage.cutoff = problem.cutoff();
  FreeModel own = own_numbers(model);
  const std::size_t most = static_cast<std::size_t>(policy.most_effects) * problem.scales().size();
  for (std::size_t i = 0; i <= most; ++i) {
    const TorqueScreen screen = torque_screen(problem, own, catalogue, data, progress);
    if (i == 0) {
      stage.own = screen.own;
    }
    if (screen.ranked.empty()) {
      break;
    }
    const Round round = judged_round(judge, screen, policy);
    stage.open = round.shares;
    std::stable_sort(stage.open.begin(), stage.open.end(), is_more_probable);
    const auto best = std::min_element(round.shares.begin(), round.shares.end(), is_more_probable);
    const auto index = static_cast<std::size_t>(best - round.shares.begin());
    if (round.falls[index] < policy.material || i == most) {
      break;
    }
    std::vector<LawShare> others = stage.open;
    const double share = needed_share(problem, judge, screen, round, index, policy, others);
    if (share < policy.stable) {
      break;
    }
    TorqueFinding finding;
    finding.effect = best->effect;
    finding.at = best->at;
    finding.free = screen.ranked[index].free;
    finding.share = share;
    std::copy_if(others.begin() + 1, others.end(), std::back_inserter(finding.rivals),
                 [&](const LawShare& one) { return one.share >= policy.fair; });
    if (std::optional<Load> load = payload_for(screen.ranked[index], problem, judge, screen, policy)) {
      LawShare other = *best;
      other.share = share * (1.0 - load->share);
      if (other.share >= policy.fair) {
        finding.rivals.insert(finding.rivals.begin(), other);
      }
      finding.effect = "payload";
      finding.free = std::move(load->free);
      finding.share *= load->share;
    }
    own = finding.free;
    stage.named.push_back(std::move(finding));
    stage.open.clear();
  }
  return stage;
}

}  // namespace plumbline::validation
