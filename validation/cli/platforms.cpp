#include "validation/cli/platforms.h"

#include <stdexcept>
#include <string>

#include "simulator/trace/error.h"

namespace plumbline::cli {

contact::Terrain terrain_of(const Platforms& platforms) {
  std::vector<contact::Platform> standing;
  for (const auto& [from, to, height] : platforms) {
    standing.push_back({from, to, height});
  }
  try {
    return contact::Terrain(0.0, standing);
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string("--platform: ") + error.what());
  }
}

}  // namespace plumbline::cli
