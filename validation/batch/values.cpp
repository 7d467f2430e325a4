#include "validation/batch/values.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <set>
#include <tuple>

#include "validation/batch/jobs.h"

namespace plumbline::batch {
namespace {

using nlohmann::json;

constexpr double kLevel = 0.05;
constexpr double kNormal = 1.959963984540054;  // 95 %, two-sided

double number_or(const json& of, const char* key, double other) {
  const auto found = of.find(key);
  return found != of.end() && found->is_number() ? found->get<double>() : other;
}

/// Two-sided quantile for this share of false alarms.
double student(double share, double freedom) {
  return boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), share / 2.0));
}
double normal(double share) {
  return boost::math::quantile(boost::math::complement(boost::math::normal(), share / 2.0));
}

bool has_deviations(const std::vector<RowValue>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const RowValue& one) { return one.deviation > 0.0; });
}

/// 1/deviation^2; all 1 where one is not known.
std::vector<double> weights_of(const std::vector<RowValue>& rows) {
  const bool known = has_deviations(rows);
  std::vector<double> weights;
  for (const RowValue& one : rows) {
    weights.push_back(known ? 1.0 / (one.deviation * one.deviation) : 1.0);
  }
  return weights;
}

/// Mean and its standard deviation where rows differ by this variance beyond what their deviations say.
std::pair<double, double> mean_with(double between, const std::vector<RowValue>& rows) {
  double sum = 0.0, all = 0.0;
  for (const RowValue& one : rows) {
    const double weight = 1.0 / (one.deviation * one.deviation + between);
    sum += weight * one.value;
    all += weight;
  }
  return {sum / all, std::sqrt(1.0 / all)};
}

void set_mean(ValueOverRows& value) {
  const std::vector<double> weights = weights_of(value.rows);
  double sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * value.rows[i].value;
    all += weights[i];
  }
  value.mean = sum / all;
  if (value.rows.size() == 1) {
    value.lower = value.rows.front().lower;
    value.upper = value.rows.front().upper;
    return;
  }
  double square = 0.0, squares = 0.0;  // about the mean; of the weights
  for (std::size_t i = 0; i < weights.size(); ++i) {
    square += weights[i] * std::pow(value.rows[i].value - value.mean, 2);
    squares += weights[i] * weights[i];
  }
  const double freedom = static_cast<double>(value.rows.size()) - 1.0;
  double deviation = std::sqrt(square / freedom / all), quantile = student(kLevel, freedom);
  if (has_deviations(value.rows)) {
    value.probability =
        boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), std::min(square, 1e6)));
    const double between = std::max(0.0, (square - freedom) / (all - squares / all));
    std::tie(value.mean, deviation) = mean_with(between, value.rows);
    quantile = between > 0.0 ? quantile : kNormal;
  }
  value.lower = value.mean - quantile * deviation;
  value.upper = value.mean + quantile * deviation;
}

/// Of the rows of one robot that have a day; nothing where no line can be told.
std::optional<Drift> drift_of(const std::string& robot, const std::vector<RowValue>& rows) {
  std::set<double> days;
  for (const RowValue& one : rows) {
    days.insert(*one.day);
  }
  const bool known = has_deviations(rows);
  if (days.size() < 2 || (!known && rows.size() < 3)) {
    return std::nullopt;
  }
  const std::vector<double> weights = weights_of(rows);
  double all = 0.0, mean_day = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    all += weights[i];
    mean_day += weights[i] * *rows[i].day;
    mean += weights[i] * rows[i].value;
  }
  mean_day /= all;
  mean /= all;
  double across = 0.0, along = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    across += weights[i] * (*rows[i].day - mean_day) * (rows[i].value - mean);
    along += weights[i] * std::pow(*rows[i].day - mean_day, 2);
  }
  Drift drift{robot, days.size(), across / along, std::sqrt(1.0 / along), mean_day, mean, 0.0};
  double square = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    square += weights[i] * std::pow(rows[i].value - mean - drift.slope * (*rows[i].day - mean_day), 2);
  }
  const double freedom = static_cast<double>(rows.size()) - 2.0;
  const double birge = freedom > 0.0 ? std::sqrt(square / freedom) : 0.0;
  const bool from_scatter = !known || birge > 1.0;
  drift.deviation *= from_scatter ? birge : 1.0;
  drift.limit = from_scatter ? -freedom : 0.0;  // set_limits() knows how many lines there are
  return drift;
}

void add_drifts(ValueOverRows& value) {
  std::vector<std::string> robots;
  for (const RowValue& one : value.rows) {
    if (one.day && std::find(robots.begin(), robots.end(), one.robot) == robots.end()) {
      robots.push_back(one.robot);
    }
  }
  for (const std::string& robot : robots) {
    std::vector<RowValue> own;
    std::copy_if(value.rows.begin(), value.rows.end(), std::back_inserter(own),
                 [&](const RowValue& one) { return one.day && one.robot == robot; });
    if (const std::optional<Drift> drift = drift_of(robot, own)) {
      value.drifts.push_back(*drift);
    }
  }
}

/// The share of false alarms is that of all values, and of all lines, together.
void set_limits(std::vector<ValueOverRows>& values) {
  std::size_t lines = 0, compared = 0;
  for (const ValueOverRows& value : values) {
    lines += value.drifts.size();
    compared += value.rows.size() > 1 && has_deviations(value.rows) ? 1 : 0;
  }
  for (ValueOverRows& value : values) {
    value.differs = value.probability < kLevel / static_cast<double>(std::max<std::size_t>(compared, 1));
    for (Drift& drift : value.drifts) {
      const double share = kLevel / static_cast<double>(lines);
      const double quantile = drift.limit < 0.0 ? student(share, -drift.limit) : normal(share);
      drift.limit = quantile * drift.deviation;
    }
  }
}

/// What is the same of all values of a row.
RowValue value_of(const json& row, std::size_t index) {
  RowValue value;
  value.row = index;
  value.robot = row.value("robot", "");
  const std::string day = row.value("day", "");
  if (!day.empty()) {
    value.day = days_of(day) ? days_of(day) : std::optional<double>(std::strtod(day.c_str(), nullptr));
  }
  return value;
}

void add_named(const json& row, const RowValue& blank, std::vector<NamedValue>& values) {
  for (const json& finding : row.at("result").at("accepted")) {
    for (const json& parameter : finding.at("parameters")) {
      RowValue value = blank;
      value.value = number_or(parameter, "value", NAN);
      const double deviation = number_or(parameter, "standard_deviation", 0.0);
      value.deviation = parameter.value("chosen", false) || !std::isfinite(deviation) ? 0.0 : deviation;
      value.lower = value.value - kNormal * value.deviation;
      value.upper = value.value + kNormal * value.deviation;
      values.push_back(
          {finding.value("effect", "") + "@" + finding.value("at", "") + ":" + parameter.value("name", ""),
           parameter.value("unit", ""), value});
    }
  }
}

void add_fitted(const json& row, const RowValue& blank, std::vector<NamedValue>& values) {
  for (const json& parameter : row.at("result").at("parameters")) {
    RowValue value = blank;
    value.value = number_or(parameter, "after", NAN);
    value.deviation = number_or(parameter, "standard_deviation", 0.0);
    const json& interval = parameter.at("interval");
    value.lower = interval.at(0).is_number() ? interval.at(0).get<double>() : value.value;
    value.upper = interval.at(1).is_number() ? interval.at(1).get<double>() : value.value;
    values.push_back({parameter.value("label", ""), parameter.value("unit", ""), value});
  }
}

void add_errors(const json& row, const RowValue& blank, std::vector<NamedValue>& values) {
  for (const char* role : {"train", "held_out"}) {
    RowValue value = blank;
    value.value = number_or(row.at("errors"), role, 0.0);
    value.lower = value.upper = value.value;
    if (value.value > 0.0) {
      values.push_back({role == std::string("train") ? "train error" : "held-out error", "floors", value});
    }
  }
}

void add_place(const json& of, std::size_t row, bool named, std::vector<EffectOverRows>& effects) {
  const std::string effect = of.value("effect", ""), at = of.value("at", "");
  auto found = std::find_if(effects.begin(), effects.end(),
                            [&](const EffectOverRows& one) { return one.effect == effect && one.at == at; });
  if (found == effects.end()) {
    effects.push_back({effect, at, {}, {}});
    found = effects.end() - 1;
  }
  (named ? found->named : found->rival).push_back(row);
}

}  // namespace

std::vector<NamedValue> values_of(const json& row, std::size_t index) {
  std::vector<NamedValue> values;
  if (row.value("status", "") != "done") {
    return values;
  }
  const RowValue blank = value_of(row, index);
  const std::string mode = row.value("mode", "");
  if (mode == to_string(Mode::diagnose)) {
    add_named(row, blank, values);
  } else if (mode == to_string(Mode::fit)) {
    add_fitted(row, blank, values);
  } else {
    add_errors(row, blank, values);
  }
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](const NamedValue& one) { return !std::isfinite(one.value.value); }),
               values.end());
  return values;
}

std::vector<ValueOverRows> values_over(const std::vector<json>& rows) {
  std::vector<ValueOverRows> values;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const NamedValue& one : values_of(rows[r], r)) {
      auto found = std::find_if(values.begin(), values.end(), [&](const ValueOverRows& other) {
        return other.name == one.name && other.unit == one.unit;
      });
      if (found == values.end()) {
        values.emplace_back();
        found = values.end() - 1;
        found->name = one.name;
        found->unit = one.unit;
      }
      found->rows.push_back(one.value);
    }
  }
  for (ValueOverRows& value : values) {
    set_mean(value);
    add_drifts(value);
  }
  set_limits(values);
  return values;
}

std::vector<EffectOverRows> effects_over(const std::vector<json>& rows) {
  std::vector<EffectOverRows> effects;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].value("status", "") != "done" || rows[r].value("mode", "") != to_string(Mode::diagnose)) {
      continue;
    }
    for (const json& finding : rows[r].at("result").at("accepted")) {
      add_place(finding, r, true, effects);
      for (const json& rival : finding.at("rivals")) {
        add_place(rival, r, false, effects);
      }
    }
  }
  std::stable_sort(effects.begin(), effects.end(),
                   [](const EffectOverRows& one, const EffectOverRows& other) {
                     return one.named.size() > other.named.size();
                   });
  return effects;
}

}  // namespace plumbline::batch
