#include <stdexcept>

#include "tests/battery/worlds/mujoco_rig.h"

namespace plumbline::battery::worlds {

bool has_mujoco() { return false; }

Motion run_in_mujoco(const Rig& /*rig*/, const std::string& /*robot*/,
                     const std::vector<std::string>& /*locked*/, const Vector& /*start*/,
                     Eigen::Index /*count*/, double /*period*/, const Commander& /*command*/) {
  throw std::runtime_error("built without MuJoCo: install libmujoco-dev and build again");
}

}  // namespace plumbline::battery::worlds
