// The process that the controller runs in.
#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "controllers/controller.h"
#include "controllers/driver/controller_process.h"
#include "controllers/driver/futex.h"
#include "controllers/driver/real_time.h"
#include "controllers/driver/transport.h"

namespace plumbline::driver {
namespace {

constexpr std::size_t kMost = Mailbox::most;

/// The loaded controller, or the reason in the mailbox why there is none.
class Loaded {
 public:
  explicit Loaded(Mailbox& box) : box_(box) { good_ = load() && ports_agree() && make(); }

  bool good() const { return good_; }
  const plumbline_controller_api& api() const { return *api_; }
  void* self() const { return self_; }

 private:
  template <typename... Arguments>
  bool refuse(const char* format, Arguments... arguments) {
    std::snprintf(box_.message, sizeof box_.message, format, arguments...);
    return false;
  }

  bool load() {
    void* const library = dlopen("/proc/self/fd/4", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return refuse("cannot be loaded: %.180s", dlerror());
    const auto entry =
        reinterpret_cast<decltype(&plumbline_controller)>(dlsym(library, PLUMBLINE_CONTROLLER_SYMBOL));
    api_ = entry == nullptr ? nullptr : entry();
    if (api_ == nullptr) return refuse("exports no plumbline_controller()");
    if (api_->interface_version != PLUMBLINE_CONTROLLER_INTERFACE) {
      return refuse("found interface %u, expected %d", api_->interface_version,
                    PLUMBLINE_CONTROLLER_INTERFACE);
    }
    if (std::strcmp(api_->name, box_.name) != 0 || std::strcmp(api_->version, box_.version) != 0) {
      return refuse("found controller %.40s %.40s, the certificate is of %s %s", api_->name, api_->version,
                    box_.name, box_.version);
    }
    return true;
  }

  bool list_agrees(const char* what, const plumbline_port* ports, std::uint32_t count, std::size_t first,
                   std::uint32_t wanted) {
    if (count != wanted) return refuse("found %u %s, the certificate has %u", count, what, wanted);
    for (std::uint32_t k = 0; k < count; ++k) {
      const char* const expected = box_.names[first + k];
      if (std::strcmp(ports[k].name, expected) != 0) {
        return refuse("found %s \"%.60s\", the certificate has \"%s\" there", what, ports[k].name, expected);
      }
    }
    return true;
  }

  bool ports_agree() {
    return list_agrees("inputs", api_->inputs, api_->input_count, 0, box_.input_count) &&
           list_agrees("outputs", api_->outputs, api_->output_count, kMost, box_.output_count) &&
           list_agrees("logged values", api_->log, api_->log_count, 2 * kMost, box_.log_count) &&
           list_agrees("constants", api_->constants, api_->constant_count, 3 * kMost, box_.constant_count);
  }

  bool make() {
    for (std::uint32_t k = 0; k < api_->constant_count; ++k) {
      const plumbline_port& port = api_->constants[k];
      const double value = box_.constants[k];
      if (!(value >= port.lower && value <= port.upper)) {
        return refuse("constant %s: found %g, expected %g to %g", port.name, value, port.lower, port.upper);
      }
    }
    const plumbline_setup setup = {box_.period, box_.constants, box_.scales};
    self_ = api_->create(&setup, box_.message, sizeof box_.message);
    return self_ != nullptr;
  }

  Mailbox& box_;
  const plumbline_controller_api* api_ = nullptr;
  void* self_ = nullptr;
  bool good_ = false;
};

void do_step(Mailbox& box, const Loaded& loaded) {
  const std::int64_t begun = monotonic_now();
  box.result = loaded.api().step(loaded.self(), box.inputs, box.outputs, box.log);
  box.nanoseconds = static_cast<std::uint64_t>(monotonic_now() - begun);
  if (box.result != 0) {
    std::snprintf(box.message, sizeof box.message, "%s", loaded.api().fault(box.result));
  }
}

}  // namespace

int controller_main(int argc, char** argv) {
  if (argc != 4) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != std::atoi(argv[0])) return 1;  // the driver has ended already
  signal(SIGINT, SIG_IGN);                        // a terminal's Ctrl-C is the driver's
  signal(SIGTERM, SIG_IGN);
  void* memory = mmap(nullptr, sizeof(Mailbox), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, 3, 0);
  if (memory == MAP_FAILED) return 1;
  Mailbox& box = *static_cast<Mailbox*>(memory);
  const Loaded loaded(box);
  RealTime wanted;
  wanted.priority = std::atoi(argv[1]);
  wanted.core = std::atoi(argv[2]);
  if (wanted.priority > 0) make_real_time(wanted);
  std::uint32_t done = 0;
  while (true) {
    while (box.request.load(std::memory_order_acquire) == done) futex_wait(box.request, done, -1);
    done = box.request.load(std::memory_order_acquire);
    if (!loaded.good()) {
      box.result = -1;
    } else if (box.task == Mailbox::step) {
      do_step(box, loaded);
    } else if (box.task == Mailbox::reset) {
      loaded.api().reset(loaded.self());
      box.result = 0;
    } else {
      loaded.api().destroy(loaded.self());
    }
    const bool last = box.task == Mailbox::end;
    box.answer.store(done, std::memory_order_release);
    futex_wake(box.answer);
    if (last) return 0;
  }
}

}  // namespace plumbline::driver
