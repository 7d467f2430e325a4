// A recipe for the pendulum of tests/robots, small enough to be changed in a test.
#pragma once

#include <string>

#include "tests/trace/temporary_folder.h"

namespace plumbline::test {

inline std::string pendulum_robot(const std::string& file) {
  return std::string(PLUMBLINE_ROOT) + "/tests/robots/pendulum/" + file;
}

inline std::string pendulum_recipe() {
  return "plumbline: recipe/1\n"
         "title: A pendulum\n"
         "unknowns:\n"
         "  friction:\n"
         "    title: of the drive\n"
         "    unit: N m s/rad\n"
         "    stated: {value: 1.0e-4, unit: N m s/rad, uncertainty: 30 %, source: a test}\n"
         "    target: 2 %\n"
         "  lump:\n"
         "    title: never estimated\n"
         "    unit: kg m^2\n"
         "models:\n"
         "  bench:\n"
         "    file: " +
         pendulum_robot("model.yaml") +
         "\n"
         "    links:\n"
         "      viscous@drive:damping: friction\n"
         "steps:\n"
         "  - step: chirp\n"
         "    title: Friction from a chirp\n"
         "    source: a test\n"
         "    method: window_fit\n"
         "    model: bench\n"
         "    experiments: [" +
         pendulum_robot("experiments/chirp.yaml") +
         "]\n"
         "    free: [friction]\n";
}

/// The text with the first `what` replaced.
inline std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? "no such text: " + what : text.replace(at, what.size(), by);
}

}  // namespace plumbline::test
