// The operator's words, from a terminal, a pipe or the command line.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "controllers/driver/session.h"

namespace plumbline::driver {

/// Words: arm, go, finish, stop, reset, quit, and "wait SECONDS", which ends early when the driver stops or
/// finishes running. Throws DriverError for another word.
struct Word {
  Request request = Request::none;
  double wait = 0.0;  ///< s, of a wait
};
Word parse_word(const std::string& text);
/// Words between semicolons.
std::vector<Word> parse_words(const std::string& text);

/// Hands them to the session one by one and waits until each has been taken; then quits. Ends when the
/// session does.
void follow(Session& session, const std::vector<Word>& words, const std::atomic<bool>& interrupted);
/// Reads lines from standard input. Its end is an emergency stop and quits.
void follow_input(Session& session, const std::atomic<bool>& interrupted);

}  // namespace plumbline::driver
