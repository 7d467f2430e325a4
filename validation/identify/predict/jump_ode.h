// A plant that the integrator stops only where its forces jump.
#pragma once

#include <vector>

#include "simulator/integrate/plant_ode.h"

namespace plumbline::validation {

class JumpOde : public integrate::PlantOde {
 public:
  JumpOde(model::Plant& plant, const std::vector<model::Plant::Jump>& jumps)
      : PlantOde(plant, false, true), jumps_(jumps), all_(plant.switch_count()) {}

  int switch_count() const override { return static_cast<int>(jumps_.size()); }
  void switches(double t, const double* x, double* g) override {
    PlantOde::switches(t, x, all_.data());
    for (std::size_t i = 0; i < jumps_.size(); ++i) {
      g[i] = all_[jumps_[i].index];
    }
  }

 private:
  const std::vector<model::Plant::Jump>& jumps_;
  Eigen::VectorXd all_;
};

}  // namespace plumbline::validation
