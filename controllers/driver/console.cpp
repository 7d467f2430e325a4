#include "controllers/driver/console.h"

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace plumbline::driver {
namespace {

using Clock = std::chrono::steady_clock;

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t\r\n");
  if (from == std::string::npos) return "";
  return text.substr(from, text.find_last_not_of(" \t\r\n") - from + 1);
}

void nap() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

// An interrupt stops first, and quits when nothing moves any more.
bool handle_interrupt(Session& session, const std::atomic<bool>& interrupted) {
  if (!interrupted.load()) return false;
  session.ask(Request::stop);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  session.ask(Request::quit);
  return true;
}

void hand_over_word(Session& session, Request request) {
  session.ask(request);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

void wait_for(Session& session, double seconds, const std::atomic<bool>& interrupted) {
  const State before = session.state();
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end && !session.over() && !interrupted.load()) {
    const State now = session.state();
    if (now == State::stopped || (before == State::running && now != State::running)) return;
    nap();
  }
}

}  // namespace

Word parse_word(const std::string& text) {
  const std::string word = trimmed(text);
  static constexpr struct {
    const char* name;
    Request request;
  } kWords[] = {{"arm", Request::arm},   {"go", Request::go},       {"finish", Request::finish},
                {"stop", Request::stop}, {"reset", Request::reset}, {"quit", Request::quit}};
  for (const auto& known : kWords) {
    if (word == known.name) return {known.request, 0.0};
  }
  if (word.rfind("wait ", 0) == 0) {
    char* end = nullptr;
    const double seconds = std::strtod(word.c_str() + 5, &end);
    if (*end == '\0' && seconds >= 0.0 && seconds <= 1e6) return {Request::none, seconds};
  }
  throw DriverError("found \"" + word + "\", expected arm, go, finish, stop, reset, quit or wait SECONDS");
}

std::vector<Word> parse_words(const std::string& text) {
  std::vector<Word> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    if (!trimmed(text.substr(at, end - at)).empty()) words.push_back(parse_word(text.substr(at, end - at)));
    at = end + 1;
  }
  return words;
}

void follow(Session& session, const std::vector<Word>& words, const std::atomic<bool>& interrupted) {
  for (const Word& word : words) {
    if (session.over()) return;
    if (handle_interrupt(session, interrupted)) return;
    if (word.request == Request::none) {
      wait_for(session, word.wait, interrupted);
    } else {
      hand_over_word(session, word.request);
    }
  }
  if (!handle_interrupt(session, interrupted)) hand_over_word(session, Request::quit);
}

void follow_input(Session& session, const std::atomic<bool>& interrupted) {
  std::string line;
  while (!session.over()) {
    if (handle_interrupt(session, interrupted)) return;
    pollfd one{STDIN_FILENO, POLLIN, 0};
    if (poll(&one, 1, 50) <= 0) continue;
    char c = 0;
    if (read(STDIN_FILENO, &c, 1) <= 0) {
      const State now = session.state();
      if (now == State::holding || now == State::running) hand_over_word(session, Request::stop);
      hand_over_word(session, Request::quit);
      return;
    }
    if (c != '\n') {
      line.push_back(c);
      continue;
    }
    try {
      for (const Word& word : parse_words(line)) {
        if (word.request == Request::none) {
          wait_for(session, word.wait, interrupted);
        } else {
          hand_over_word(session, word.request);
        }
      }
    } catch (const DriverError& error) {
      std::fprintf(stderr, "drive: %s\n", error.what());
    }
    line.clear();
  }
}

}  // namespace plumbline::driver
