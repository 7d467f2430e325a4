#include "validation/report/temperatures.h"

#include "simulator/model/plant.h"
#include "validation/report/encode.h"

namespace plumbline::validation {

std::vector<Temperature> temperatures(const model::Model& model, const Trial& trial) {
  const model::Plant plant(as_recorded(model, trial), trial.locks, trial.terrain);
  const std::vector<std::string> names = plant.state_names();
  std::vector<Temperature> list;
  std::vector<int> states;
  for (const int i : plant.carried_states()) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    if (name.find("temperature of ") != std::string::npos) {
      states.push_back(i);
      list.push_back({name, Eigen::VectorXd(trial.samples())});
    }
  }
  if (list.empty()) {
    return list;
  }
  const Eigen::MatrixXd commands = command_samples(model, trial.commands, trial.samples());
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(2 * plant.positions());  // heat follows commands alone
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  plant.settle(commands.col(0).data(), x.data());
  for (Eigen::Index k = 0; k < trial.samples(); ++k) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      list[i].values[k] = x[states[i]];
    }
    plant.carry_states(still.data(), still.data(), commands.col(k).data(), trial.period, x.data());
  }
  return list;
}

nlohmann::json temperatures_json(const model::Model& model, const Trial& trial,
                                 const std::vector<Block>& blocks) {
  nlohmann::json list = nlohmann::json::array();
  for (const Temperature& one : temperatures(model, trial)) {
    list.push_back(
        {{"state", one.state}, {"unit", "K"}, {"values", packed(thinned(one.values, blocks), blocks)}});
  }
  return list;
}

}  // namespace plumbline::validation
