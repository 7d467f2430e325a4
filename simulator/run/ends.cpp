#include "simulator/run/ends.h"

#include <fmt/core.h>

#include <algorithm>

#include "simulator/trace/error.h"

namespace plumbline::run {

EndWatch::EndWatch(const std::vector<End>& ends, const WiredController* controller)
    : controller_(controller) {
  for (const End& end : ends) {
    Watched one;
    one.end = end;
    if (end.kind == End::Kind::unchanged) {
      one.log = controller == nullptr ? -1 : controller->log_index(end.watched);
      if (one.log < 0) {
        throw InputError("ends: found \"" + end.watched + "\", expected a value that the controller logs");
      }
    }
    ends_.push_back(one);
  }
}

std::string EndWatch::look(const Simulation& simulation) {
  const double now = simulation.time();
  const auto& touches = simulation.touches();
  const bool down = std::any_of(touches.begin(), touches.end(),
                                [](const model::Touch& touch) { return touch.depth > 0.0; });
  flown_ = flown_ || (stood_ && !down);
  stood_ = stood_ || down;
  last_flight_ = down ? last_flight_ : now;
  if (controller_ != nullptr && controller_->fault() != 0 && faulted_ < 0.0) {
    faulted_ = now;
    fault_ = controller_->fault_text();
  }
  const std::string end = reason(simulation);
  if (end.empty() || faulted_ < 0.0) {
    return end;
  }
  return fmt::format("{} at {:.3f} s; {}", fault_, faulted_, end);
}

std::string EndWatch::reason(const Simulation& simulation) {
  if (!simulation.outputs().allFinite()) {
    return fmt::format("the state is not finite at {:.3f} s", simulation.time());
  }
  std::string first;
  for (Watched& one : ends_) {
    const std::string words = look_at(one, simulation);
    if (first.empty()) {
      first = words;
    }
  }
  return first;
}

std::string EndWatch::look_at(Watched& one, const Simulation& simulation) const {
  const double now = simulation.time();
  const End& end = one.end;
  const auto position = [&] {
    return simulation.plant().position_of(end.watched, simulation.state().data());
  };
  switch (end.kind) {
    case End::Kind::above:
      return position() > end.limit ? fmt::format("{} at {:.3f} s", end.words, now) : "";
    case End::Kind::below:
      return position() < end.limit ? fmt::format("{} at {:.3f} s", end.words, now) : "";
    case End::Kind::on_ground:
      return faulted_ < 0.0 && now - last_flight_ > end.limit
                 ? fmt::format("{} the ground, on it since {:.3f} s",
                               flown_ ? "does not leave" : "never leaves", last_flight_)
                 : "";
    case End::Kind::unchanged: {
      const double value = controller_->log()[static_cast<std::size_t>(one.log)];
      if (!one.known || value != one.last) {
        one.known = true;
        one.last = value;
        one.since = now;
      }
      return faulted_ < 0.0 && now - one.since > end.limit
                 ? fmt::format("stays in {} {:g} at {:.3f} s", end.watched, value, now)
                 : "";
    }
    case End::Kind::after_fault:
      return faulted_ >= 0.0 && now - faulted_ > end.limit ? "lies" : "";
  }
  return "";
}

}  // namespace plumbline::run
