#include "validation/identify/diagnose/own_parameters.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>

#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/diagnose/physical_limits.h"
#include "validation/identify/predict/foretell.h"

namespace plumbline::validation {
namespace {

/// A use of a law with one parameter at its null value, known within `deviation`.
model::EffectUse open_number(const std::string& law, const std::string& at, double deviation,
                             const std::string& source) {
  model::EffectUse use;
  use.law = effects::Catalogue::all().find(law);
  use.at = at;
  model::Quantity quantity;
  quantity.value = use.law->null_values().front();
  quantity.uncertainty = deviation;
  quantity.source = source;
  use.values.push_back(quantity);
  return use;
}

/// Normal equations of a few parameters.
struct Equations {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

/// The equations of the last parameters after the first `count` have moved as the others ask.
Equations without_first(const Equations& all, Eigen::Index count) {
  const Eigen::Index rest = all.g.size() - count;
  Equations left{all.H.bottomRightCorner(rest, rest), all.g.tail(rest)};
  if (count > 0) {
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> first(all.H.topLeftCorner(count, count));
    const Eigen::MatrixXd cross = all.H.bottomLeftCorner(rest, count);
    left.H -= cross * first.solve(cross.transpose());
    left.g -= cross * first.solve(all.g.head(count));
  }
  return left;
}

/// A stage with its own numbers open, where they stand: its other parameters first.
struct OpenNumbers {
  model::Model model;
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd theta;
  Eigen::Index own = 0;
};

bool is_own(const FreeParameter& parameter) { return std::isfinite(parameter.deviation); }

OpenNumbers open_numbers(const Stage& stage, double width) {
  OpenNumbers open{fitted_model(stage), stage.parameters, {}};
  const auto first_own = std::stable_partition(open.parameters.begin(), open.parameters.end(),
                                               [](const FreeParameter& one) { return !is_own(one); });
  if (first_own == open.parameters.end()) {
    open.model = with_stated_errors(open.model);
    const std::vector<FreeParameter> own = stated_parameters(open.model, width);
    open.parameters.insert(open.parameters.end(), own.begin(), own.end());
  }
  open.own = std::count_if(open.parameters.begin(), open.parameters.end(), is_own);
  open.theta = values_of(open.model, open.parameters);
  return open;
}

double inertia_deviation(const model::Model& model, const model::Motor& motor) {
  double square = std::pow(motor.rotor_inertia.uncertainty, 2);
  for (const model::Inertia& inertia : model.inertias) {
    square += inertia.at == motor.name ? std::pow(inertia.value.uncertainty, 2) : 0.0;
  }
  return std::sqrt(square);
}

}  // namespace

model::Model with_stated_errors(const model::Model& model, std::size_t named) {
  std::vector<model::EffectUse> uses;
  const auto add = [&](const std::string& law, const std::string& at, double deviation,
                       const std::string& what) {
    const bool identified = std::any_of(model.effects.begin(), model.effects.end(), [&](const auto& use) {
      return use.at == at && use.law->declaration().name == law;
    });
    if (deviation > 0.0 && !identified) {
      uses.push_back(open_number(law, at, deviation, "stated uncertainty of the " + what));
    }
  };
  for (const model::Motor& motor : model.motors) {
    const model::Quantity& constant = motor.torque_constant;
    add("torque_constant_error", motor.name,
        constant.value > 0.0 ? constant.uncertainty / constant.value : 0.0, "torque constant");
    add("rotor_inertia", motor.name, inertia_deviation(model, motor), "rotor inertia");
  }
  for (const model::Body& body : model.skeleton.bodies) {
    add("added_mass", body.name, body.mass_uncertainty, "mass");
  }
  model::Model open = model;
  open.effects.insert(open.effects.end() - static_cast<std::ptrdiff_t>(named), uses.begin(), uses.end());
  return open;
}

std::vector<FreeParameter> stated_parameters(const model::Model& model, double width) {
  std::vector<FreeParameter> free;
  const auto together = std::make_shared<const model::Correlations>(model.correlations);
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const model::EffectUse& use = model.effects[e];
    const bool angular = model.place_is_angular(model.resolve(*use.law, use.at), use.at);
    for (FreeParameter& parameter : free_parameters_of(use, static_cast<int>(e), {}, angular)) {
      const model::Quantity& quantity = use.values[static_cast<std::size_t>(parameter.id.parameter)];
      if (quantity.uncertainty <= 0.0) {
        continue;
      }
      keep_physical(model, use, parameter);
      parameter.lower = std::max(parameter.lower, quantity.value - width * quantity.uncertainty);
      parameter.upper = std::min(parameter.upper, quantity.value + width * quantity.uncertainty);
      parameter.mean = quantity.value;
      parameter.deviation = quantity.uncertainty;
      parameter.typical = std::max(std::abs(quantity.value), quantity.uncertainty);
      parameter.together = together;
      free.push_back(parameter);
    }
  }
  return free;
}

std::vector<FreeParameter> noticeable_parameters(PredictorPool& pool,
                                                 const std::vector<FreeParameter>& parameters,
                                                 const std::vector<Eigen::VectorXd>& x0) {
  constexpr double kShareOfFloor = 0.1;
  const Data& data = pool.data();
  const std::vector<int> windows = data.windows_of(Role::train);
  const Eigen::VectorXd theta = values_of(pool.model(), parameters);
  const Eigen::VectorXd units = search_units(parameters, theta);
  const Sum train = sum_of(reduce(pool, windows, parameters, theta, x0, units), windows, data, Role::train);
  const Eigen::VectorXd slopes = search_slopes(parameters, units, theta);
  std::vector<FreeParameter> kept;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    const double deviation = parameters[p].deviation / std::abs(slopes[i]);  // in search units
    if (deviation * std::sqrt(train.H(i, i) / train.samples) > kShareOfFloor) {
      kept.push_back(parameters[p]);
    }
  }
  return kept;
}

Stage with_open_numbers(const Stage& stage, std::size_t named, double width, const Data& data) {
  const model::Model given = fitted_model(stage);
  const bool has_own = std::any_of(stage.parameters.begin(), stage.parameters.end(), is_own);
  Stage open{has_own ? given : with_stated_errors(given, named), {}, stage.estimate};
  const auto first = static_cast<int>(given.effects.size() - named);
  const auto further = static_cast<int>(open.model.effects.size() - given.effects.size());
  const auto move = [&](model::ParameterId& id) { id.effect += id.effect >= first ? further : 0; };
  std::vector<FreeParameter> before = stage.parameters;
  for (FreeParameter& parameter : before) {
    move(parameter.id);
    std::for_each(parameter.also.begin(), parameter.also.end(), move);
  }
  std::vector<FreeParameter> own = stated_parameters(open.model, width);
  const auto is_open = [&](const FreeParameter& one) {
    return std::any_of(before.begin(), before.end(), [&](const FreeParameter& other) {
      return other.id.effect == one.id.effect && other.id.parameter == one.id.parameter;
    });
  };
  own.erase(std::remove_if(own.begin(), own.end(), is_open), own.end());
  PredictorPool pool(open.model, data);
  open.parameters = noticeable_parameters(pool, own, stage.estimate.x0);
  open.parameters.insert(open.parameters.end(), before.begin(), before.end());
  return open;
}

double evidence_for_stated(const Stage& stage, const Data& data, double width) {
  const OpenNumbers open = open_numbers(stage, width);
  const Eigen::VectorXd units = search_units(open.parameters, open.theta);
  PredictorPool pool(open.model, data);
  Equations sum{Eigen::MatrixXd::Zero(units.size(), units.size()), Eigen::VectorXd::Zero(units.size())};
  for (const Reduced& one :
       reduce(pool, data.all_windows(), open.parameters, open.theta, stage.estimate.x0, units)) {
    sum.H += one.H;
    sum.g += one.g;
  }
  const Eigen::Index own = open.own;
  Equations left = without_first(sum, units.size() - own);
  const Eigen::VectorXd slopes = search_slopes(open.parameters, units, open.theta).tail(own);
  Eigen::VectorXd shift(own);
  for (Eigen::Index p = 0; p < own; ++p) {
    const FreeParameter& parameter =
        open.parameters[open.parameters.size() - static_cast<std::size_t>(own - p)];
    const double deviation = parameter.deviation / slopes[p];
    left.g[p] *= deviation;
    left.H.row(p) *= deviation;
    left.H.col(p) *= deviation;
    shift[p] = (open.theta.tail(own)[p] - parameter.mean) / parameter.deviation;
  }
  const Eigen::LDLT<Eigen::MatrixXd> stated(known_correlation(open.parameters));
  const Eigen::LDLT<Eigen::MatrixXd> known(left.H + stated.solve(Eigen::MatrixXd::Identity(own, own)));
  const Eigen::VectorXd pull = left.g + left.H * shift;
  return 0.5 * (known.vectorD().array().abs().log().sum() + stated.vectorD().array().abs().log().sum() -
                pull.dot(known.solve(pull)));
}

std::vector<OwnParameter> own_values(const Stage& stage) {
  std::vector<OwnParameter> own;
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    const FreeParameter& one = stage.parameters[p];
    if (is_own(one)) {
      own.push_back(
          {one.label, one.unit, one.mean, one.deviation, stage.estimate.theta[static_cast<Eigen::Index>(p)]});
    }
  }
  return own;
}

}  // namespace plumbline::validation
