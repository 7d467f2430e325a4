// Something that hangs on a link, and a link whose matter sits elsewhere: which of the two is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"

namespace plumbline::validation {
namespace {

using testing::Contains;

Diagnosis diagnosed(const std::string& hidden) {
  return diagnose(pendulum_drive(), some_laws({"added_mass", "com_shift", "payload"}),
                  pendulum_twins({hidden}), {}, silent);
}

std::vector<std::string> rivals_of(const Finding& finding) {
  std::vector<std::string> labels;
  for (const Rival& rival : finding.rivals) {
    labels.push_back(rival.name.label());
  }
  return labels;
}

// One joint feels the first two moments of what it swings, which a centre of mass of two coordinates has,
// too.
TEST(PayloadName, WhatAPayloadExplainsAsWellIsAPayload) {
  const Diagnosis d = diagnosed("payload@arm:mass=0.12,x=0,y=0,z=-0.5");
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.accepted.front().label(), "payload@arm");
  EXPECT_LT(d.accepted.front().held_out_after, 1.1);
  if (d.accepted.front().selected_share < 0.95) {
    EXPECT_THAT(rivals_of(d.accepted.front()), Contains("com_shift@arm"));
  }
}

// Matter that moves towards the axis takes inertia away, as a lighter link does and no payload.
TEST(PayloadName, WhatNoPayloadExplainsKeepsItsName) {
  const Diagnosis d = diagnosed("com_shift@arm:x=0,y=0,z=0.06");
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_THAT(d.accepted.front().effect, testing::AnyOf("added_mass", "com_shift"));
}

}  // namespace
}  // namespace plumbline::validation
