#include "validation/diagnose/own_parameters.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "validation/diagnose/candidates.h"

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

double inertia_deviation(const model::Model& model, const model::Motor& motor) {
  double square = std::pow(motor.rotor_inertia.uncertainty, 2);
  for (const model::Inertia& inertia : model.inertias) {
    square += inertia.at == motor.name ? std::pow(inertia.value.uncertainty, 2) : 0.0;
  }
  return std::sqrt(square);
}

}  // namespace

model::Model with_stated_errors(const model::Model& model) {
  model::Model open = model;
  const auto add = [&](const std::string& law, const std::string& at, double deviation,
                       const std::string& what) {
    if (deviation > 0.0) {
      open.effects.push_back(open_number(law, at, deviation, "stated uncertainty of the " + what));
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
  return open;
}

std::vector<FreeParameter> stated_parameters(const model::Model& model, double width) {
  std::vector<FreeParameter> free;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const model::EffectUse& use = model.effects[e];
    const bool angular = model.place_is_angular(model.resolve(*use.law, use.at), use.at);
    for (FreeParameter& parameter : free_parameters_of(use, static_cast<int>(e), {}, angular)) {
      const model::Quantity& quantity = use.values[static_cast<std::size_t>(parameter.id.parameter)];
      if (quantity.uncertainty <= 0.0) {
        continue;
      }
      parameter.lower = std::max(parameter.lower, quantity.value - width * quantity.uncertainty);
      parameter.upper = std::min(parameter.upper, quantity.value + width * quantity.uncertainty);
      parameter.mean = quantity.value;
      parameter.deviation = quantity.uncertainty;
      parameter.typical = quantity.value != 0.0 ? std::abs(quantity.value) : quantity.uncertainty;
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
  Eigen::VectorXd square = Eigen::VectorXd::Zero(units.size());
  double samples = 0.0;
  for (const Reduced& one : reduce(pool, windows, parameters, theta, x0, units)) {
    square += one.H.diagonal();
  }
  for (const int w : windows) {
    const Window& window = data.windows[static_cast<std::size_t>(w)];
    samples += static_cast<double>(window.count) *
               static_cast<double>(data.trials[static_cast<std::size_t>(window.trial)].measured.size());
  }
  const Eigen::VectorXd slopes = search_slopes(parameters, units, theta);
  std::vector<FreeParameter> kept;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    const double deviation = parameters[p].deviation / std::abs(slopes[i]);  // in search units
    if (deviation * std::sqrt(square[i] / samples) > kShareOfFloor) {
      kept.push_back(parameters[p]);
    }
  }
  return kept;
}

double evidence_for_stated(const Stage& stage, const Data& data, double width) {
  const std::vector<FreeParameter>& fitted = stage.parameters;
  const model::Model open = with_stated_errors(with_values(stage.model, fitted, stage.estimate.theta));
  std::vector<FreeParameter> parameters = fitted;
  for (const FreeParameter& own : stated_parameters(open, width)) {
    parameters.push_back(own);
  }
  const auto first = static_cast<Eigen::Index>(fitted.size());
  const auto own = static_cast<Eigen::Index>(parameters.size()) - first;
  const Eigen::VectorXd theta = values_of(open, parameters);
  const Eigen::VectorXd units = search_units(parameters, theta);
  PredictorPool pool(open, data);
  Equations sum{Eigen::MatrixXd::Zero(theta.size(), theta.size()), Eigen::VectorXd::Zero(theta.size())};
  for (const Reduced& one : reduce(pool, data.all_windows(), parameters, theta, stage.estimate.x0, units)) {
    sum.H += one.H;
    sum.g += one.g;
  }
  Equations left = without_first(sum, first);
  const Eigen::VectorXd slopes = search_slopes(parameters, units, theta).tail(own).cwiseAbs();
  for (Eigen::Index p = 0; p < own; ++p) {
    const double deviation = parameters[static_cast<std::size_t>(first + p)].deviation / slopes[p];
    left.g[p] *= deviation;
    left.H.row(p) *= deviation;
    left.H.col(p) *= deviation;
  }
  const Eigen::LDLT<Eigen::MatrixXd> known(left.H + Eigen::MatrixXd::Identity(own, own));
  return 0.5 * (known.vectorD().array().abs().log().sum() - left.g.dot(known.solve(left.g)));
}

std::vector<OwnParameter> own_values(const Stage& stage) {
  std::vector<OwnParameter> own;
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    const FreeParameter& one = stage.parameters[p];
    if (std::isfinite(one.deviation)) {
      own.push_back(
          {one.label, one.unit, one.mean, one.deviation, stage.estimate.theta[static_cast<Eigen::Index>(p)]});
    }
  }
  return own;
}

}  // namespace plumbline::validation
