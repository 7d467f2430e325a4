#include "controllers/driver/cause.h"

namespace plumbline::driver {

const char* to_string(Cause cause) noexcept {
  static constexpr const char* kNames[kCauses] = {"none",
                                                  "not a number",
                                                  "command limit",
                                                  "slew limit",
                                                  "stopping position",
                                                  "workspace",
                                                  "count jump",
                                                  "frozen sensor",
                                                  "stale",
                                                  "lost packets",
                                                  "duplicated packets",
                                                  "reordered packets",
                                                  "corrupt packets",
                                                  "wrong layout",
                                                  "late cycle",
                                                  "controller overrun",
                                                  "controller crash",
                                                  "controller gave up",
                                                  "emergency stop",
                                                  "power cut",
                                                  "expired certificate"};
  const auto index = static_cast<int>(cause);
  return index < kCauses ? kNames[index] : "";
}

}  // namespace plumbline::driver
