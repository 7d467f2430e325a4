#include "validation/studies/recipes/linked.h"

#include <algorithm>
#include <cmath>

#include "simulator/trace/error.h"
#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/fit/free_parameters.h"

namespace plumbline::validation {
namespace {

const FreeParameter& labelled(const std::vector<FreeParameter>& parameters, const std::string& label) {
  return *std::find_if(parameters.begin(), parameters.end(),
                       [&](const FreeParameter& one) { return one.label == label; });
}

void add_linked(const LinkedModel& linked, const std::string& unknown, const std::vector<FreeParameter>& all,
                const Knowledge* known, std::vector<LinkedParameter>& list) {
  const auto before = list.size();
  for (const Link& link : linked.links) {
    if (link.unknown != unknown) {
      continue;
    }
    if (list.size() > before) {
      const Link& first = list.back().link;
      if (link.times != first.times || link.plus != first.plus || link.power != first.power) {
        throw InputError(link.place, "a second parameter of \"" + unknown + "\" that differs from the first",
                         "equal `times`, `plus` and `power` for parameters that a step moves together");
      }
      list.back().parameter.also.push_back(labelled(all, link.label).id);
      continue;
    }
    LinkedParameter one{labelled(all, link.label), link, known == nullptr};
    if (known != nullptr) {
      one.parameter.mean = link.parameter(known->value);
      one.parameter.deviation = std::abs(link.slope(known->value)) * known->deviation;
    }
    list.push_back(one);
  }
}

}  // namespace

model::Model with_unknowns(const LinkedModel& linked, const std::map<std::string, double>& values) {
  const std::vector<FreeParameter> all = free_parameters(linked.model);
  std::vector<FreeParameter> parameters;
  std::vector<double> theta;
  for (const Link& link : linked.links) {
    const auto value = values.find(link.unknown);
    if (value != values.end()) {
      parameters.push_back(labelled(all, link.label));
      theta.push_back(link.parameter(value->second));
    }
  }
  const Eigen::Map<const Eigen::VectorXd> numbers(theta.data(), static_cast<Eigen::Index>(theta.size()));
  return with_values(linked.model, parameters, numbers);
}

std::vector<LinkedParameter> linked_parameters(const LinkedModel& linked, const Step& step,
                                               const KnowledgeMap& knowledge) {
  const std::vector<FreeParameter> all = free_parameters(linked.model);
  std::vector<LinkedParameter> list;
  for (const std::string& unknown : step.free) {
    add_linked(linked, unknown, all, nullptr, list);
  }
  for (const std::string& unknown : step.known) {
    const Knowledge& known = knowledge.at(unknown);
    if (known.deviation > 0.0) {
      add_linked(linked, unknown, all, &known, list);
    }
  }
  return list;
}

std::vector<FreeParameter> parameters_of(const std::vector<LinkedParameter>& linked) {
  std::vector<FreeParameter> parameters;
  parameters.reserve(linked.size());
  for (const LinkedParameter& one : linked) {
    parameters.push_back(one.parameter);
  }
  return parameters;
}

std::map<std::string, double> known_values(const Step& step, const KnowledgeMap& knowledge) {
  std::map<std::string, double> values;
  for (const std::string& unknown : step.known) {
    values[unknown] = knowledge.at(unknown).value;
  }
  return values;
}

}  // namespace plumbline::validation
