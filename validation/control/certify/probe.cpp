#include "validation/control/certify/probe.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "controllers/driver/json.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

constexpr long kSteps = 20000;

void write(std::ofstream& out, double value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_input(const std::string& file, const driver::Plan& plan, const Eigen::MatrixXd& channels) {
  std::ofstream out(file, std::ios::binary);
  write(out, plan.period);
  write(out, static_cast<double>(plan.constants.size()));
  write(out, static_cast<double>(plan.inputs.size()));
  write(out, static_cast<double>(channels.cols()));
  write(out, static_cast<double>(kSteps));
  for (const double value : plan.constants) {
    write(out, value);
  }
  for (const driver::Plan::Input& input : plan.inputs) {
    write(out, input.scale);
  }
  for (Eigen::Index k = 0; k < channels.cols(); ++k) {
    for (const driver::Plan::Input& input : plan.inputs) {
      double value = input.fixed;
      for (const int channel : input.from) {
        value = input.from.size() > 1 ? std::max(value, channels(channel, k)) : channels(channel, k);
      }
      write(out, value);
    }
  }
}

/// A file that is gone when this is.
struct Temporary {
  Temporary() : path((fs::temp_directory_path() / fmt::format("plumbline-probe-{}", getpid())).string()) {}
  ~Temporary() { fs::remove(path); }
  std::string path;
};

}  // namespace

Probed probe_controller(const std::string& library, const driver::Plan& plan,
                        const Eigen::MatrixXd& channels) {
  const Temporary input;
  write_input(input.path, plan, channels);
  const std::string command = fmt::format("'{}' '{}' '{}'", PLUMBLINE_PROBE, library, input.path);
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) {
    throw std::runtime_error("the controller's probe cannot be started");
  }
  char text[1024] = "";
  const std::size_t n = std::fread(text, 1, sizeof text - 1, pipe);
  text[n] = '\0';
  if (pclose(pipe) != 0) {
    throw std::runtime_error(library + ": crashed or could not be made while its steps were timed");
  }
  const driver::Json json = driver::parse_json(std::string(text));
  Probed probed;
  probed.steps = static_cast<long>(json.at("steps").number());
  probed.allocations = static_cast<long>(json.at("allocations").number());
  probed.p50 = json.at("p50").number();
  probed.p999 = json.at("p999").number();
  probed.largest = json.at("largest").number();
  probed.fault = static_cast<int>(json.at("fault").number());
  return probed;
}

}  // namespace plumbline::validation
