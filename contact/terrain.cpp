#include "contact/terrain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace plumbline::contact {
namespace {

std::string words(const Platform& platform) {
  std::ostringstream out;
  out << "platform from " << platform.from << " to " << platform.to << " m, height " << platform.height
      << " m";
  return out.str();
}

void check(const Platform& platform) {
  if (!std::isfinite(platform.from) || !std::isfinite(platform.to) || !std::isfinite(platform.height)) {
    throw std::invalid_argument(words(platform) + ": expected finite numbers");
  }
  if (!(platform.from < platform.to)) {
    throw std::invalid_argument(words(platform) + ": expected it to end after it begins");
  }
}

}  // namespace

Terrain::Terrain(double floor, std::vector<Platform> platforms)
    : floor_(floor), platforms_(std::move(platforms)) {
  if (!std::isfinite(floor_)) {
    throw std::invalid_argument("floor: found a height of " + std::to_string(floor_) +
                                " m, expected a finite number");
  }
  std::for_each(platforms_.begin(), platforms_.end(), check);
  std::sort(platforms_.begin(), platforms_.end(),
            [](const Platform& a, const Platform& b) { return a.from < b.from; });
  for (std::size_t i = 1; i < platforms_.size(); ++i) {
    if (platforms_[i].from < platforms_[i - 1].to) {
      throw std::invalid_argument(words(platforms_[i]) + ": overlaps the " + words(platforms_[i - 1]));
    }
  }
}

double Terrain::height_at(double x) const {
  const auto next = std::upper_bound(platforms_.begin(), platforms_.end(), x,
                                     [](double at, const Platform& platform) { return at < platform.from; });
  if (next == platforms_.begin()) return floor_;
  const Platform& platform = *(next - 1);
  return x < platform.to ? platform.height : floor_;
}

std::vector<double> Terrain::edges() const {
  std::vector<double> edges;
  for (const Platform& platform : platforms_) {
    if (edges.empty() || edges.back() != platform.from) edges.push_back(platform.from);
    edges.push_back(platform.to);
  }
  return edges;
}

}  // namespace plumbline::contact
