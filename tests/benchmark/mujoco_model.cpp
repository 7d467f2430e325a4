#include "tests/benchmark/mujoco_model.h"

#include <cstring>
#include <stdexcept>

namespace plumbline::benchmarks {

MujocoModel compile(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), "model.xml")], xml.data(), xml.size());
  char reason[1000] = "";
  MujocoModel model(mj_loadXML("model.xml", files.get(), reason, sizeof(reason)));
  mj_deleteVFS(files.get());
  if (!model) {
    throw std::runtime_error(std::string("MuJoCo: ") + reason);
  }
  return model;
}

}  // namespace plumbline::benchmarks
