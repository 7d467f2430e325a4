// The hopping controller with a fault that comes at a stated step: for the fault matrix. Its constants are
// those of the hopping controller, and two more.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <vector>

#include "controllers/controller.h"

// library.cpp of the hopping controller is compiled under this name.
extern "C" const plumbline_controller_api* hopping_controller(void);

namespace {

enum Fault { none, not_a_number, beyond_limit, too_quick, gives_up, hangs, crashes, ends, slow };

struct Faulty {
  void* hopping = nullptr;
  Fault fault = none;
  long at = 0, steps = 0;
};

std::vector<plumbline_port>& constant_ports() {
  static std::vector<plumbline_port> ports;
  return ports;
}

void* create(const plumbline_setup* setup, char* message, size_t size) {
  const std::size_t inner = hopping_controller()->constant_count;
  void* const hopping = hopping_controller()->create(setup, message, size);
  if (hopping == nullptr) return nullptr;
  auto* self = new Faulty;
  self->hopping = hopping;
  self->fault = static_cast<Fault>(static_cast<int>(setup->constants[inner]));
  self->at = static_cast<long>(setup->constants[inner + 1]);
  return self;
}

void reset(void* data) {
  auto* self = static_cast<Faulty*>(data);
  self->steps = 0;
  hopping_controller()->reset(self->hopping);
}

void take(long nanoseconds) {
  timespec begun{}, now{};
  clock_gettime(CLOCK_MONOTONIC, &begun);
  do {
    clock_gettime(CLOCK_MONOTONIC, &now);
  } while ((now.tv_sec - begun.tv_sec) * 1000000000L + now.tv_nsec - begun.tv_nsec < nanoseconds);
}

int step(void* data, const double* inputs, double* outputs, double* log) {
  auto* self = static_cast<Faulty*>(data);
  const int code = hopping_controller()->step(self->hopping, inputs, outputs, log);
  if (code != 0 || ++self->steps <= self->at) return code;
  switch (self->fault) {
    case not_a_number:
      outputs[1] = std::numeric_limits<double>::quiet_NaN();
      break;
    case beyond_limit:
      outputs[1] = 1e4;
      break;
    case too_quick:
      outputs[0] = outputs[0] > 0.0 ? -29.9 : 29.9;  // mLA_left; the leg shape swings through it by itself
      break;
    case gives_up:
      return 1;
    case hangs:
      while (true) {
        volatile int forever = 0;
        (void)forever;
      }
    case crashes:
      std::abort();
    case ends:
      std::_Exit(0);
    case slow:
      take(3000000);
      break;
    case none:
      break;
  }
  return 0;
}

const char* fault(int code) { return hopping_controller()->fault(code); }
void get_memory(const void* data, double* memory) {
  hopping_controller()->get_memory(static_cast<const Faulty*>(data)->hopping, memory);
}
void set_memory(void* data, const double* memory) {
  hopping_controller()->set_memory(static_cast<Faulty*>(data)->hopping, memory);
}
void destroy(void* data) {
  auto* self = static_cast<Faulty*>(data);
  if (self == nullptr) return;
  hopping_controller()->destroy(self->hopping);
  delete self;
}

}  // namespace

extern "C" const plumbline_controller_api* plumbline_controller(void) {
  static plumbline_controller_api api = *hopping_controller();
  if (constant_ports().empty()) {
    constant_ports().assign(api.constants, api.constants + api.constant_count);
    constant_ports().push_back({"fault", "1", PLUMBLINE_VALUE, 0.0, slow});
    constant_ports().push_back({"fault_step", "1", PLUMBLINE_VALUE, 0.0, 1e9});
    api.constants = constant_ports().data();
    api.constant_count = static_cast<std::uint32_t>(constant_ports().size());
    api.create = create;
    api.reset = reset;
    api.step = step;
    api.fault = fault;
    api.get_memory = get_memory;
    api.set_memory = set_memory;
    api.destroy = destroy;
  }
  return &api;
}
