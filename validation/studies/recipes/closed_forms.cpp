// Steps that are the paper's own equations.
#include <algorithm>
#include <cmath>

#include "simulator/sensing/differentiation.h"
#include "validation/identify/fit/fit.h"
#include "validation/studies/recipes/estimators.h"
#include "validation/studies/recipes/methods.h"

namespace plumbline::validation {
namespace {

constexpr double kArxPeriod = 0.01;  // s: long against the encoder's noise, short against motor and command

IdentifiedValue finding_of(const std::string& unknown, double value, double deviation, double quantile) {
  return {unknown, value, deviation, value - quantile * deviation, value + quantile * deviation, true};
}

void add_findings(const std::vector<std::string>& unknowns, const Regression& regression, double quantile,
                  StepResult& result) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (!unknowns[i].empty()) {
      result.findings.push_back(
          finding_of(unknowns[i], regression.values[k], std::sqrt(regression.covariance(k, k)), quantile));
    }
  }
}

const Eigen::VectorXd& values_of(const Trial& trial, const std::string& sensor) {
  return std::find_if(trial.measured.begin(), trial.measured.end(),
                      [&](const Measured& channel) { return channel.sensor == sensor; })
      ->values;
}

Regression arx_of(const ArxMethod& method, const Trial& trial) {
  const Eigen::VectorXd velocity = sensing::differentiate(values_of(trial, method.sensor), trial.period,
                                                          sensing::DifferentiationOptions::acausal());
  const auto command = std::find_if(trial.commands.begin(), trial.commands.end(),
                                    [&](const Command& one) { return one.motor == method.motor; });
  const auto every = std::max<Eigen::Index>(1, std::lround(kArxPeriod / trial.period));
  return first_order_arx(every_nth(velocity, every), group_means(command->values, every),
                         static_cast<double>(every) * trial.period);
}

}  // namespace

StepResult arx(const Recipe& recipe, const Step& step, const std::vector<Trial>& trials,
               const MethodOptions& options) {
  (void)recipe;
  Regression mean;
  mean.values = Eigen::Vector3d::Zero();
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  StepResult result;
  result.step = step.name;
  for (const Trial& trial : trials) {
    const Regression one = arx_of(step.arx, trial);
    const Eigen::Vector3d weight = one.covariance.diagonal().cwiseInverse();
    mean.values += weight.cwiseProduct(one.values);
    weights += weight;
    mean.degrees_of_freedom += one.degrees_of_freedom;
    result.windows += one.degrees_of_freedom + 3;
  }
  mean.values = mean.values.cwiseQuotient(weights);
  mean.covariance = weights.cwiseInverse().asDiagonal();
  add_findings({step.arx.bias, step.arx.inertia, step.arx.friction}, mean,
               student_quantile(options.confidence, mean.degrees_of_freedom), result);
  return result;
}

StepResult equation_14(const Step& step, const KnowledgeMap& knowledge, const MethodOptions& options) {
  const Equation14Method& method = step.equation_14;
  const auto n = static_cast<Eigen::Index>(method.rows.size());
  Eigen::VectorXd pulleys(n);
  Eigen::VectorXd lumped(n);
  Eigen::VectorXd deviations(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Equation14Method::Row& row = method.rows[static_cast<std::size_t>(i)];
    pulleys[i] = row.pulleys;
    lumped[i] = knowledge.at(row.lumped).value;
    deviations[i] = knowledge.at(row.lumped).deviation;
  }
  StepResult result;
  result.step = step.name;
  result.windows = static_cast<int>(n);
  // The lumped inertias' deviations come from many windows each: a normal quantile.
  add_findings({method.torque_factor, method.rotor_factor},
               equation_14(method.rotor_inertia, pulleys, lumped, deviations),
               student_quantile(options.confidence, 1000), result);
  return result;
}

StepResult equation_22(const Recipe& recipe, const Step& step, const PostureReadings& readings,
                       const MethodOptions& options) {
  const model::Model& model = recipe.model(step.model).model;
  const Equation22Method& method = step.equation_22;
  const Eigen::VectorXd shape = 0.5 * readings.sensors.row(model.sensor_index(method.knee)).transpose();
  const Eigen::VectorXd spring = readings.sensors.row(model.sensor_index(method.spring)).transpose();
  const Regression regression = equation_22(shape, spring, readings.weight, method.ratio);
  StepResult result;
  result.step = step.name;
  result.windows = static_cast<int>(spring.size());
  add_findings({method.stiffness, method.preload}, regression,
               student_quantile(options.confidence, regression.degrees_of_freedom), result);
  return result;
}

}  // namespace plumbline::validation
