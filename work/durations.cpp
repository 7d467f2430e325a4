#include "work/durations.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace plumbline::work {

Durations::Durations(const std::string& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t comma = line.rfind(',');
    std::istringstream number(comma == std::string::npos ? "" : line.substr(comma + 1));
    double seconds = 0.0;
    if (number >> seconds) {
      add(line.substr(0, comma), seconds);
    }
  }
}

double Durations::of(const std::string& name) const {
  const auto found = known_.find(name);
  return found == known_.end() ? 0.0 : found->second;
}

void Durations::add(const std::string& name, double seconds) { known_[name] = std::max(seconds, of(name)); }

std::string Durations::text(const std::string& head) const {
  std::ostringstream text;
  text << head << ",seconds\n";
  for (const auto& [name, seconds] : known_) {
    text << name << ',' << std::to_string(seconds) << '\n';
  }
  return text.str();
}

}  // namespace plumbline::work
