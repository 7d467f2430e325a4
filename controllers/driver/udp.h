// Datagrams of UDP over IPv4.
#pragma once

#include <netinet/in.h>

#include "controllers/driver/transport.h"

namespace plumbline::driver {

class Udp : public Transport {
 public:
  /// The driver's side takes any free port of its own and hears only what the robot's address sends. The
  /// robot's side binds to the address, and answers to whoever sent last.
  Udp(const std::string& host, const std::string& port, Side side);
  ~Udp() override;
  Udp(const Udp&) = delete;
  Udp& operator=(const Udp&) = delete;

  bool send(const std::uint8_t* data, std::size_t size) noexcept override;
  std::size_t receive(std::uint8_t* buffer, std::size_t size) noexcept override;
  bool wait(std::int64_t deadline) noexcept override;
  std::int64_t arrived() const noexcept override { return arrived_; }
  /// The port that this side is bound to.
  int port() const;

 private:
  int socket_ = -1;
  Side side_;
  sockaddr_in peer_{};
  bool peer_known_ = false;
  std::int64_t arrived_ = 0;
};

}  // namespace plumbline::driver
