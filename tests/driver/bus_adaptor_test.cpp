// The worked example of docs/driving.md against a bus that is only pretended: a session runs through it.
#include "controllers/driver/examples/bus_adaptor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "controllers/driver/session.h"
#include "controllers/driver/signature.h"
#include "tests/driver/small_plan.h"

namespace plumbline::driver {
namespace {

/// One axis whose encoder is about to wrap, and swings.
class StubBus : public ProcessBus {
 public:
  bool exchange(const std::int16_t* outputs, std::int32_t* inputs) noexcept override {
    torque_ = outputs[0];
    ++cycles_;
    const std::int64_t count =
        2147483600LL + std::llround(100.0 * std::sin(0.1 * static_cast<double>(cycles_)));
    inputs[0] = static_cast<std::int32_t>(static_cast<std::uint32_t>(count));
    return cycles_ % 50 != 0;  // now and then a frame is lost
  }
  void enable(bool on) noexcept override { on_ = on; }
  bool enabled() const noexcept override { return on_; }
  std::int16_t torque_ = 0;
  long cycles_ = 0;
  bool on_ = false;
};

Plan one_axis() {
  Plan plan = small_plan();
  plan.channels.resize(1);
  // The stub controller has three ports; two are fixed here.
  plan.inputs[1].from.clear();
  plan.inputs[2].from.clear();
  plan.workspace.clear();
  plan.handover.clear();
  plan.packets.lost = 1000;
  plan.channels[0].rest = kNone;
  plan.commands[0].limit = 1e7;
  plan.commands[0].slew = kNone;
  return plan;
}

TEST(BusAdaptor, ASessionRunsThroughIt) {
  StubBus bus;
  const Plan plan = one_axis();
  BusAdaptor adaptor(bus, {{20e6}}, layout_of(plan.channel_names(), plan.command_names()), 1000000);
  ControllerProcess controller(DRIVE_PROGRAM, plan, read_bytes(STUB_CONTROLLER), Schedule());
  SessionOptions options;
  options.session = 7;
  Session session(plan, adaptor, controller, nullptr, options);
  const auto turns = [&](int n) {
    for (int k = 0; k < n; ++k) session.turn();
  };
  turns(30);
  EXPECT_EQ(session.state(), State::idle);
  session.ask(Request::arm);
  turns(10);
  EXPECT_EQ(session.state(), State::holding);
  session.ask(Request::go);
  turns(120);
  EXPECT_EQ(session.state(), State::running) << session.supervisor().fault().detail;
  EXPECT_NE(bus.torque_, 0);
  EXPECT_GE(session.counts().lost, 2U);
  session.ask(Request::stop);
  turns(3);
  EXPECT_EQ(session.state(), State::stopped);
  EXPECT_EQ(bus.torque_, 0);
  EXPECT_FALSE(bus.on_);
}

}  // namespace
}  // namespace plumbline::driver
