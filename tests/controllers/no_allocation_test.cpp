// Counts this program's allocations, to see that controllers make none once they are built.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <new>

#include "controllers/blocks/cascade_pd.h"
#include "controllers/mabel_hopping/hopping.h"
#include "tests/controllers/hopping_example.h"

namespace {

long allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace plumbline::controllers {
namespace {

TEST(NoAllocation, TheCounterCounts) {
  const long before = allocations;
  ::operator delete(::operator new(8));  // unlike a new expression, never optimised away
  EXPECT_EQ(allocations - before, 1);
}

TEST(NoAllocation, HoppingThroughAllPhases) {
  Hopping controller(hopping_example());
  HoppingSample sample;
  bool seen[7] = {};
  const long before = allocations;
  for (int k = 0; k < 4000; ++k) {
    const int t = k % 400;  // ms of a hop: in the air, down, kicked off, one foot up, both up
    sample.left_contact = t >= 100 && t < 250;
    sample.right_contact = t >= 105 && t < (k < 2000 ? 255 : 245);
    sample.boom_pitch += t < 180 ? -3 : 2;
    sample.tower -= 9;
    sample.left.thigh += 5;
    controller.command(sample);
    seen[static_cast<int>(controller.phase())] = true;
  }
  controller.reset();
  EXPECT_EQ(allocations - before, 0);
  for (int phase = 1; phase <= 6; ++phase) EXPECT_TRUE(seen[phase]) << phase;
}

TEST(NoAllocation, CascadePd) {
  CascadePd controller({4.0, 10.0, 6.0, 1e-3, 2});
  const long before = allocations;
  for (int k = 0; k < 100; ++k) controller.command(1.0, 0.01 * k);
  EXPECT_EQ(allocations - before, 0);
}

}  // namespace
}  // namespace plumbline::controllers
