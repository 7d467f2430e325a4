#include "controllers/host/loaded_controller.h"

#include <dlfcn.h>
#include <openssl/evp.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace plumbline::controllers {
namespace {

std::string one_line(std::string text) {
  for (char& c : text) {
    c = c == '\n' || c == '\r' ? ' ' : c;
  }
  return text;
}

[[noreturn]] void refuse(const std::string& path, const std::string& found, const std::string& expected) {
  throw ControllerError(path + ": found " + one_line(found) + ", expected " + expected);
}

std::shared_ptr<void> open_library(const std::string& path) {
  // With a slash, or dlopen would look in the system's folders.
  const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* why = dlerror();
    refuse(path, std::string("a library that does not load (") + (why != nullptr ? why : "unknown") + ")",
           "a controller's shared library");
  }
  return {handle, [](void* library) { dlclose(library); }};
}

const plumbline_controller_api* api_of(void* library, const std::string& path) {
  void* symbol = dlsym(library, PLUMBLINE_CONTROLLER_SYMBOL);
  if (symbol == nullptr) {
    refuse(path, "no function " PLUMBLINE_CONTROLLER_SYMBOL, "a controller's shared library");
  }
  using Function = const plumbline_controller_api* (*)();
  const plumbline_controller_api* api = reinterpret_cast<Function>(symbol)();
  if (api == nullptr) {
    refuse(path, "a controller that says nothing of itself", "an interface");
  }
  if (api->interface_version != PLUMBLINE_CONTROLLER_INTERFACE) {
    refuse(path, "interface version " + std::to_string(api->interface_version),
           "version " + std::to_string(PLUMBLINE_CONTROLLER_INTERFACE) +
               ": build the controller with this program's controllers/controller.h");
  }
  return api;
}

void check_ports(const std::string& path, const char* what, const plumbline_port* first, std::uint32_t count,
                 bool values_only) {
  if (count > 0 && first == nullptr) {
    refuse(path, std::string("a list of ") + what + " that is not there", "the ports");
  }
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    const plumbline_port& port = first[i];
    if (port.name == nullptr || port.unit == nullptr) {
      refuse(path, std::string("a port without name or unit among the ") + what, "both");
    }
    const std::string name = port.name;
    const std::string of = "among the " + std::string(what);
    if (name.empty() ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") !=
            std::string::npos) {
      refuse(path, "a port named \"" + name + "\" " + of, "letters, digits and underscores");
    }
    if (!names.insert(name).second) {
      refuse(path, "port " + name + " twice " + of, "each name once");
    }
    if (!(port.lower <= port.upper)) {
      refuse(path, "port " + name + " " + of + " with limits out of order", "lower <= upper");
    }
    if (port.kind < PLUMBLINE_COUNT || port.kind > PLUMBLINE_VALUE ||
        (values_only && port.kind != PLUMBLINE_VALUE)) {
      refuse(path, "port " + name + " " + of + " of a kind that is not allowed there", "a value");
    }
  }
}

void check(const std::string& path, const plumbline_controller_api& api) {
  if (api.name == nullptr || api.version == nullptr) {
    refuse(path, "a controller without name or version", "both");
  }
  if (api.create == nullptr || api.reset == nullptr || api.step == nullptr || api.fault == nullptr ||
      api.destroy == nullptr || api.get_memory == nullptr || api.set_memory == nullptr) {
    refuse(path, "a controller that lacks a function", "all seven of them");
  }
  check_ports(path, "inputs", api.inputs, api.input_count, false);
  check_ports(path, "outputs", api.outputs, api.output_count, true);
  check_ports(path, "constants", api.constants, api.constant_count, true);
  check_ports(path, "log", api.log, api.log_count, true);
  check_ports(path, "memory", api.memory, api.memory_count, true);
}

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

void* create(const LoadedController& library, double period, const std::vector<double>& constants,
             const std::vector<double>& scales) {
  const plumbline_controller_api& api = library.api();
  if (constants.size() != api.constant_count || scales.size() != api.input_count) {
    refuse(library.path(), "another number of constants or inputs", "as many as the controller has");
  }
  for (std::size_t c = 0; c < constants.size(); ++c) {
    const plumbline_port& port = api.constants[c];
    if (!(constants[c] >= port.lower && constants[c] <= port.upper)) {
      refuse(library.path(), std::string("constant ") + port.name + " = " + text_of(constants[c]),
             text_of(port.lower) + " to " + text_of(port.upper) + " " + port.unit);
    }
  }
  const plumbline_setup setup{period, constants.data(), scales.data()};
  std::array<char, 512> message{};
  void* self = api.create(&setup, message.data(), message.size());
  message.back() = '\0';
  if (self == nullptr) {
    throw ControllerError(library.path() + ": controller " + api.name +
                          " refuses its constants: " + one_line(message.data()));
  }
  return self;
}

}  // namespace

std::string sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    refuse(path, "no file that can be read", "a controller's shared library");
  }
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  bool good = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::array<char, 65536> block{};
  while (good && file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    good = EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(file.gcount())) == 1;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (!good || file.bad() || EVP_DigestFinal_ex(context.get(), digest.data(), &length) != 1) {
    refuse(path, "a file that could not be read to its end", "a controller's shared library");
  }
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += kDigits[digest[i] >> 4U];
    text += kDigits[digest[i] & 15U];
  }
  return text;
}

LoadedController::LoadedController(const std::string& path)
    : path_(path),
      sha256_(sha256_of_file(path)),
      library_(open_library(path)),
      api_(api_of(library_.get(), path)) {
  check(path_, *api_);
}

ControllerInstance::ControllerInstance(const LoadedController& library, double period,
                                       const std::vector<double>& constants,
                                       const std::vector<double>& input_scales)
    : library_(library), self_(create(library, period, constants, input_scales), library.api().destroy) {
  reset();
}

std::vector<double> ControllerInstance::memory() const {
  std::vector<double> values(library_.api().memory_count);
  library_.api().get_memory(self_.get(), values.data());
  return values;
}

void ControllerInstance::set_memory(const std::vector<double>& memory) {
  if (memory.size() != library_.api().memory_count) {
    refuse(library_.path(), "another number of memory values", "as many as the controller has");
  }
  library_.api().set_memory(self_.get(), memory.data());
}

namespace {

/// Where they are installed, from where the program is.
std::string installed_controllers() {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  return none ? "" : (program.parent_path().parent_path() / "lib/plumbline/controllers").string();
}

}  // namespace

std::string find_controller(const std::string& name) {
  const char* given = std::getenv("PLUMBLINE_CONTROLLERS");
  std::istringstream folders(std::string(given != nullptr ? given : "") + ":" + PLUMBLINE_CONTROLLERS + ":" +
                             installed_controllers());
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string path = folder + "/" + name + ".so";
    if (!folder.empty() && std::ifstream(path)) {
      return path;
    }
  }
  return "";
}

}  // namespace plumbline::controllers
