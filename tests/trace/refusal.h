// The text of the InputError that an action throws.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "simulator/trace/error.h"

namespace plumbline::test {

/// The one line of the InputError; a failure, and an empty text, when the action throws none.
inline std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "no InputError but: " << error.what();
    return "";
  }
  ADD_FAILURE() << "accepted";
  return "";
}

}  // namespace plumbline::test
