// Loads a controller's library: what simulator and driver share. No simulator in here.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "controllers/controller.h"

namespace plumbline::controllers {

/// A library that cannot be used, or a controller that refuses its constants. what() is one line.
struct ControllerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// SHA-256 of a file, 64 hexadecimal digits. Throws ControllerError when it cannot be read.
std::string sha256_of_file(const std::string& path);

/// A controller's library, loaded and looked through: it loads, exports plumbline_controller(), speaks this
/// interface's version, every function is there, and the ports of each list have names of their own and
/// limits in order. Copies share the library; it is closed with the last one.
class LoadedController {
 public:
  /// Throws ControllerError (one line) otherwise.
  explicit LoadedController(const std::string& path);

  const std::string& path() const { return path_; }
  /// Of the file as it was when it was loaded: the controller's identity.
  const std::string& sha256() const { return sha256_; }
  const plumbline_controller_api& api() const { return *api_; }

  std::vector<plumbline_port> inputs() const { return list(api_->inputs, api_->input_count); }
  std::vector<plumbline_port> outputs() const { return list(api_->outputs, api_->output_count); }
  std::vector<plumbline_port> constants() const { return list(api_->constants, api_->constant_count); }
  std::vector<plumbline_port> log() const { return list(api_->log, api_->log_count); }
  std::vector<plumbline_port> memory() const { return list(api_->memory, api_->memory_count); }

 private:
  static std::vector<plumbline_port> list(const plumbline_port* first, std::uint32_t count) {
    return count == 0 ? std::vector<plumbline_port>() : std::vector<plumbline_port>(first, first + count);
  }

  std::string path_, sha256_;
  std::shared_ptr<void> library_;
  const plumbline_controller_api* api_ = nullptr;
};

/// One controller at work. After construction no call allocates. Not thread-safe: one for each thread.
class ControllerInstance {
 public:
  /// As just reset. Throws ControllerError when a constant is outside its port's limits or the controller
  /// refuses. `constants` and `input_scales` are in the order of the ports, in their units.
  ControllerInstance(const LoadedController& library, double period, const std::vector<double>& constants,
                     const std::vector<double>& input_scales);

  void reset() { library_.api().reset(self_.get()); }
  /// One sample; what the controller's step() returns. `log` may be nullptr.
  int step(const double* inputs, double* outputs, double* log) {
    return library_.api().step(self_.get(), inputs, outputs, log);
  }
  std::string fault(int code) const { return library_.api().fault(code); }
  std::vector<double> memory() const;
  void set_memory(const std::vector<double>& memory);
  const LoadedController& library() const { return library_; }

 private:
  LoadedController library_;
  std::unique_ptr<void, void (*)(void*)> self_;
};

/// The file of a library by its plain name ("mabel_hopping"): in the folders of the environment variable
/// PLUMBLINE_CONTROLLERS (separated by colons), then where the build leaves them, then where they are
/// installed beside the program
/// (../lib/plumbline/controllers). Empty when there is none.
std::string find_controller(const std::string& name);

}  // namespace plumbline::controllers
