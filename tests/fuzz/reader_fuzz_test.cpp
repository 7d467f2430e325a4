// Damaged inputs, a few thousand from a fixed seed, and every input that once broke a reader: only ever an
// InputError, one line, in time.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "simulator/trace/error.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/reader_targets.h"
#include "tests/trace/temporary_folder.h"

#if defined(__SANITIZE_ADDRESS__)
// udunits2 2.2.28 loses a few bytes in its scanner when a text is no unit.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:utlex\n";
}  // NOLINT(bugprone-reserved-identifier)
#endif

namespace plumbline::test {
namespace {

TEST(ReaderFuzzTest, GoodTextsAreAccepted) {
  const TemporaryFolder folder;
  for (const ReaderTarget& target : reader_targets(folder.path(""))) {
    for (const std::string& seed : target.seeds) {
      EXPECT_EQ(target.check(seed), "") << target.name;
    }
  }
}

TEST(ReaderFuzzTest, DamagedTextsAreRefusedOrRead) {
  const TemporaryFolder folder;
  for (const ReaderTarget& target : reader_targets(folder.path(""))) {
    const bool slow = target.name == "sdf" || target.name == "urdf" || target.name == "mat";
    const int count = slow ? 40 : 1500;
    Mutator mutator(20260101);
    for (int i = 0; i < count; ++i) {
      const std::string text =
          mutator.mutate(target.seeds[static_cast<std::size_t>(i) % target.seeds.size()]);
      ASSERT_EQ(target.check(text), "") << target.name << " input " << i << ":\n" << text;
    }
  }
}

TEST(ReaderFuzzTest, TheMutatorRepeatsItself) {
  Mutator a(7);
  Mutator b(7);
  std::set<std::string> different;
  for (int i = 0; i < 100; ++i) {
    const std::string text = a.mutate("value: 1.5, unit: N m");
    EXPECT_EQ(text, b.mutate("value: 1.5, unit: N m"));
    different.insert(text);
  }
  EXPECT_GT(different.size(), 80U);
}

TEST(ReaderFuzzTest, TheCorpusIsHandled) {
  const TemporaryFolder folder;
  int files = 0;
  for (const ReaderTarget& target : reader_targets(folder.path(""))) {
    const std::filesystem::path corpus = std::filesystem::path(PLUMBLINE_ROOT "/tests/corpus") / target.name;
    if (!std::filesystem::is_directory(corpus)) {
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      EXPECT_EQ(target.check(text), "") << entry.path();
      ++files;
    }
  }
  RecordProperty("files", files);
}

}  // namespace
}  // namespace plumbline::test
