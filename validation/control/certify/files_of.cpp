#include <algorithm>
#include <filesystem>

#include "validation/control/certify/certify.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

void add(std::vector<NamedFile>& files, const std::string& path, const std::string& role) {
  const std::string plain = fs::path(path).lexically_normal().string();
  for (const NamedFile& one : files) {
    if (one.path == plain) {
      return;
    }
  }
  files.push_back({plain, role});
}

/// A YAML file and all that it stands on.
void add_chain(std::vector<NamedFile>& files, std::string path, const std::string& role) {
  for (int depth = 0; depth < 32; ++depth) {
    add(files, path, role);
    const auto base = model::YamlNode::load(path).find("base");
    if (!base) {
      return;
    }
    path = (fs::path(path).parent_path() / base->text()).string();
  }
}

}  // namespace

std::vector<NamedFile> files_of(const Requirements& requirements, const run::LoadedScenario& loaded) {
  std::vector<NamedFile> files;
  add(files, loaded.controller->library.path(), "controller library");
  add_chain(files, loaded.controller->file, "constants and wiring");
  add_chain(files, loaded.scenario.file, "scenario");
  for (const std::string& file : loaded.model.lineage) {
    add(files, file, "model");
  }
  add(files, loaded.model.file, "model");
  add(files, loaded.model.skeleton.file, "skeleton");
  add_chain(files, requirements.file, "requirements");
  for (const std::string& file : requirements.reference) {
    add(files, file, "reference data");
  }
  std::sort(files.begin(), files.end(),
            [](const NamedFile& a, const NamedFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace plumbline::validation
