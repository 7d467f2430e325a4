#include "controllers/driver/transport.h"

#include <ctime>

#include "controllers/driver/json.h"
#include "controllers/driver/shared_memory.h"
#include "controllers/driver/udp.h"

namespace plumbline::driver {

std::int64_t monotonic_now() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1000000000 + now.tv_nsec;
}

std::unique_ptr<Transport> open_transport(const std::string& address, Side side) {
  const std::size_t colon = address.find(':');
  const std::string kind = address.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : address.substr(colon + 1);
  if (kind == "udp") {
    const std::size_t last = rest.rfind(':');
    if (last == std::string::npos) throw DriverError(address + ": expected udp:HOST:PORT");
    return std::make_unique<Udp>(rest.substr(0, last), rest.substr(last + 1), side);
  }
  if (kind == "shm") return std::make_unique<SharedMemory>(rest, side);
  throw DriverError(address + ": unknown kind of connection, expected udp:HOST:PORT or shm:NAME");
}

}  // namespace plumbline::driver
