// Seeded damage to texts: the same seed gives the same damage on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace plumbline::test {

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// One to four changes.
  std::string mutate(std::string text);

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
  void change(std::string& text);
  void change_number(std::string& text);
  void swap_words(std::string& text);

  std::mt19937_64 random_;
};

}  // namespace plumbline::test
