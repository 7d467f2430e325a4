// Random input for everything of the driver that reads what others have written.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "controllers/controller.h"

namespace plumbline::driver {

/// One input after the other; what comes out must hold, or std::logic_error is thrown.
class FuzzTargets {
 public:
  /// `controller`: path of a library whose create() gets random constants. `certificate`: one of this
  /// library, whose constants are taken with a few of them changed; empty: all are random, and few are
  /// accepted.
  FuzzTargets(std::uint64_t seed, const std::string& controller, const std::string& certificate = "");

  void packet();       ///< random bytes, and good packets with a few changed: none but whole ones is accepted
  void certificate();  ///< a signed text with a few bytes changed is refused in one line
  void body();         ///< a changed body that somebody has signed is a plan or a refusal in one line
  void constants();    ///< the controller refuses them in one line, or its outputs stay within its own limits
  void supervisor();   ///< whatever comes, what leaves is finite, within its limits, and 0 once stopped

  /// All of them by turns, so that `count` inputs are read in total.
  void run(std::uint64_t count);
  /// How many of the constants' inputs the controller took.
  std::uint64_t created() const { return created_; }
  /// `count` inputs of one of them, by its name. Throws std::invalid_argument for another name.
  void run_only(const std::string& target, std::uint64_t count);

 private:
  double any_number();
  void mutate(std::string& text);
  std::vector<double> some_constants(const plumbline_controller_api& api);

  std::mt19937_64 random_;
  std::string text_, body_text_, packet_bytes_, controller_;
  void* library_ = nullptr;
  std::vector<double> good_constants_;
  std::uint64_t created_ = 0;
};

}  // namespace plumbline::driver
