// From a C++ class to the C interface of a controller (controllers/controller.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>

#include "controllers/controller.h"

namespace plumbline::controllers {

/// Ports of one list: a constant array and its length.
template <std::size_t N>
struct Ports {
  const plumbline_port* first;
  static constexpr std::uint32_t count = static_cast<std::uint32_t>(N);
};
template <std::size_t N>
constexpr Ports<N> ports(const plumbline_port (&list)[N]) {
  return {list};
}

/// The functions of the C interface for a class that has
///   explicit Controller(const plumbline_setup&);   may throw std::exception, whose what() is one line
///   void reset() noexcept;
///   int step(const double* inputs, double* outputs, double* log) noexcept;
///   static const char* fault(int code) noexcept;
///   void get_memory(double*) const noexcept;  void set_memory(const double*) noexcept;
template <class Controller>
struct CFunctions {
  static Controller* of(void* self) noexcept { return static_cast<Controller*>(self); }
  static const Controller* of(const void* self) noexcept { return static_cast<const Controller*>(self); }

  static void* create(const plumbline_setup* setup, char* message, std::size_t size) {
    try {
      return new Controller(*setup);
    } catch (const std::exception& error) {
      std::snprintf(message, size, "%s", error.what());
    } catch (...) {
      std::snprintf(message, size, "the controller could not be made");
    }
    return nullptr;
  }
  static void reset(void* self) { of(self)->reset(); }
  static int step(void* self, const double* inputs, double* outputs, double* log) {
    return of(self)->step(inputs, outputs, log);
  }
  static const char* fault(int code) { return Controller::fault(code); }
  static void get_memory(const void* self, double* memory) { of(self)->get_memory(memory); }
  static void set_memory(void* self, const double* memory) { of(self)->set_memory(memory); }
  static void destroy(void* self) { delete of(self); }

  /// Everything that plumbline_controller() returns.
  template <std::size_t I, std::size_t O, std::size_t C, std::size_t L, std::size_t M>
  static constexpr plumbline_controller_api api(const char* name, const char* version, Ports<I> inputs,
                                                Ports<O> outputs, Ports<C> constants, Ports<L> log,
                                                Ports<M> memory) {
    return {PLUMBLINE_CONTROLLER_INTERFACE,
            name,
            version,
            inputs.first,
            inputs.count,
            outputs.first,
            outputs.count,
            constants.first,
            constants.count,
            log.first,
            log.count,
            memory.first,
            memory.count,
            &CFunctions::create,
            &CFunctions::reset,
            &CFunctions::step,
            &CFunctions::fault,
            &CFunctions::get_memory,
            &CFunctions::set_memory,
            &CFunctions::destroy};
  }
};

}  // namespace plumbline::controllers
