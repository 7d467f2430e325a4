#include "controllers/driver/udp.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/ip.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

#include "controllers/driver/json.h"

namespace plumbline::driver {

Udp::Udp(const std::string& host, const std::string& port, Side side) : side_(side) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const std::string name = "udp:" + host + ":" + port;
  const int code = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (code != 0) throw DriverError(name + ": " + gai_strerror(code) + ", expected udp:HOST:PORT");
  std::memcpy(&peer_, found->ai_addr, sizeof peer_);
  freeaddrinfo(found);
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int delay = IPTOS_LOWDELAY;
  const int yes = 1;
  if (socket_ >= 0) setsockopt(socket_, IPPROTO_IP, IP_TOS, &delay, sizeof delay);
  if (socket_ >= 0) setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &yes, sizeof yes);
  const int done = socket_ < 0 ? -1
                   : side == Side::driver
                       ? connect(socket_, reinterpret_cast<const sockaddr*>(&peer_), sizeof peer_)
                       : bind(socket_, reinterpret_cast<const sockaddr*>(&peer_), sizeof peer_);
  if (done != 0) {
    const std::string why = std::strerror(errno);
    if (socket_ >= 0) close(socket_);
    throw DriverError(name + ": " + why);
  }
  peer_known_ = side == Side::driver;
}

Udp::~Udp() { close(socket_); }

bool Udp::send(const std::uint8_t* data, std::size_t size) noexcept {
  if (!peer_known_) return false;
  // A refused port shows up as an error of the next send: the peer is not there yet, or no more.
  const ssize_t sent = side_ == Side::driver
                           ? ::send(socket_, data, size, MSG_DONTWAIT)
                           : sendto(socket_, data, size, MSG_DONTWAIT,
                                    reinterpret_cast<const sockaddr*>(&peer_), sizeof peer_);
  return sent == static_cast<ssize_t>(size);
}

std::size_t Udp::receive(std::uint8_t* buffer, std::size_t size) noexcept {
  sockaddr_in from{};
  iovec part{buffer, size};
  alignas(cmsghdr) char control[128];
  msghdr message{};
  message.msg_name = &from;
  message.msg_namelen = sizeof from;
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t n = recvmsg(socket_, &message, MSG_DONTWAIT);
  if (n <= 0) return 0;
  arrived_ = monotonic_now();
  const cmsghdr* const head = CMSG_FIRSTHDR(&message);
  if (head != nullptr && head->cmsg_level == SOL_SOCKET && head->cmsg_type == SCM_TIMESTAMPNS) {
    timespec stamp{}, now{};  // of the wall clock, as the kernel has it
    std::memcpy(&stamp, CMSG_DATA(head), sizeof stamp);
    clock_gettime(CLOCK_REALTIME, &now);
    const std::int64_t waited =
        (now.tv_sec - stamp.tv_sec) * std::int64_t{1000000000} + now.tv_nsec - stamp.tv_nsec;
    if (waited > 0) arrived_ -= waited;
  }
  if (side_ == Side::robot) {
    peer_ = from;
    peer_known_ = true;
  }
  return static_cast<std::size_t>(n);
}

bool Udp::wait(std::int64_t deadline) noexcept {
  while (true) {
    const std::int64_t left = deadline - monotonic_now();
    pollfd one{socket_, POLLIN, 0};
    timespec time{};
    if (left > 0) {
      time.tv_sec = left / 1000000000;
      time.tv_nsec = left % 1000000000;
    }
    const int ready = ppoll(&one, 1, &time, nullptr);
    if (ready > 0 && (one.revents & POLLIN) != 0) return true;
    if (ready > 0) {  // an error is pending: reading takes it away
      char none = 0;
      recv(socket_, &none, 1, MSG_DONTWAIT);
    }
    if (left <= 0) return false;
    if (ready < 0 && errno == EINTR) return false;
  }
}

int Udp::port() const {
  sockaddr_in own{};
  socklen_t length = sizeof own;
  getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &length);
  return ntohs(own.sin_port);
}

}  // namespace plumbline::driver
