// A MuJoCo model from its XML.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace plumbline::benchmarks {

struct MujocoDelete {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MujocoModel = std::unique_ptr<mjModel, MujocoDelete>;
using MujocoData = std::unique_ptr<mjData, MujocoDelete>;

/// Throws std::runtime_error with MuJoCo's reason.
MujocoModel compile(const std::string& xml);

}  // namespace plumbline::benchmarks
