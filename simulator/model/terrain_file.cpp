#include "simulator/model/terrain_file.h"

#include <stdexcept>
#include <vector>

#include "simulator/model/plain_number.h"

namespace plumbline::model {

contact::Terrain read_terrain(const YamlNode& node) {
  node.allow_keys({"floor", "platforms"});
  const auto floor = node.find("floor");
  std::vector<contact::Platform> platforms;
  if (const auto list = node.find("platforms")) {
    for (const YamlNode& item : list->items()) {
      item.allow_keys({"from", "to", "height"});
      platforms.push_back({read_number(item.at("from"), "m"), read_number(item.at("to"), "m"),
                           read_number(item.at("height"), "m")});
    }
  }
  try {
    return contact::Terrain(floor ? read_number(*floor, "m") : 0.0, platforms);
  } catch (const std::invalid_argument& error) {
    node.refuse(error.what(), "platforms that can stand");
  }
}

}  // namespace plumbline::model
