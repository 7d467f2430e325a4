#include "controllers/driver/shared_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "controllers/driver/futex.h"
#include "controllers/driver/json.h"

namespace plumbline::driver {
namespace {

constexpr std::uint32_t kMagic = 0x31424C50U;

}  // namespace

SharedMemory::SharedMemory(const std::string& name, Side side) : name_("/" + name), side_(side) {
  if (name.empty() || name.find('/') != std::string::npos) {
    throw DriverError("shm:" + name + ": expected shm:NAME without a slash");
  }
  const bool make = side == Side::robot;
  if (make) shm_unlink(name_.c_str());
  const int file = shm_open(name_.c_str(), make ? O_RDWR | O_CREAT | O_EXCL : O_RDWR, 0600);
  const auto give_up = [&](const char* why) {
    if (file >= 0) close(file);
    throw DriverError("shm:" + name + ": " + why);
  };
  if (file < 0) give_up(errno == ENOENT ? "no robot has made this shared memory" : std::strerror(errno));
  if (make && ftruncate(file, sizeof(SharedQueues)) != 0) give_up(std::strerror(errno));
  struct stat info {};
  if (fstat(file, &info) != 0 || info.st_size != static_cast<off_t>(sizeof(SharedQueues))) {
    give_up("the memory has another size: another version of the program made it");
  }
  void* memory = mmap(nullptr, sizeof(SharedQueues), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) give_up(std::strerror(errno));
  close(file);
  memory_ = static_cast<SharedQueues*>(memory);
  if (make) {
    memory_->magic.store(kMagic, std::memory_order_release);
  } else if (memory_->magic.load(std::memory_order_acquire) != kMagic) {
    munmap(memory, sizeof(SharedQueues));
    throw DriverError("shm:" + name + ": not a robot's shared memory");
  }
  out_ = make ? &memory_->to_driver : &memory_->to_robot;
  in_ = make ? &memory_->to_robot : &memory_->to_driver;
  in_->read.store(in_->written.load());  // what an earlier driver left behind is nobody's
}

SharedMemory::~SharedMemory() {
  munmap(memory_, sizeof(SharedQueues));
  if (side_ == Side::robot) shm_unlink(name_.c_str());
}

bool SharedMemory::send(const std::uint8_t* data, std::size_t size) noexcept {
  const std::uint32_t next = out_->written.load(std::memory_order_relaxed);
  if (next - out_->read.load(std::memory_order_acquire) >= SharedQueues::slots || size > Packet::largest) {
    return false;
  }
  SharedQueues::Slot& slot = out_->slot[next % SharedQueues::slots];
  slot.size = static_cast<std::uint32_t>(size);
  slot.time = monotonic_now();
  std::memcpy(slot.bytes, data, size);
  out_->written.store(next + 1, std::memory_order_release);
  futex_wake(out_->written);
  return true;
}

std::size_t SharedMemory::receive(std::uint8_t* buffer, std::size_t size) noexcept {
  const std::uint32_t next = in_->read.load(std::memory_order_relaxed);
  if (in_->written.load(std::memory_order_acquire) == next) return 0;
  const SharedQueues::Slot& slot = in_->slot[next % SharedQueues::slots];
  const std::size_t n = std::min({static_cast<std::size_t>(slot.size), size, Packet::largest});
  std::memcpy(buffer, slot.bytes, n);
  arrived_ = slot.time;
  in_->read.store(next + 1, std::memory_order_release);
  return n;
}

bool SharedMemory::wait(std::int64_t deadline) noexcept {
  const std::uint32_t seen = in_->read.load(std::memory_order_relaxed);
  if (in_->written.load(std::memory_order_acquire) != seen) return true;
  if (monotonic_now() >= deadline) return false;
  futex_wait(in_->written, seen, deadline);
  return in_->written.load(std::memory_order_acquire) != seen;
}

}  // namespace plumbline::driver
