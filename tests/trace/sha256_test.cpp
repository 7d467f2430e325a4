#include "simulator/trace/sha256.h"

#include <gtest/gtest.h>

#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline {
namespace {

// NIST, Secure Hash Standard examples.
constexpr const char* kHashOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kHashOfNothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* kHashOfMillionA = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Sha256, AgreesWithTheStandardsExamples) {
  EXPECT_EQ(sha256_of("abc"), kHashOfAbc);
  EXPECT_EQ(sha256_of(""), kHashOfNothing);
  EXPECT_EQ(sha256_of(std::string(1000000, 'a')), kHashOfMillionA);
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("abc", "abc");
  EXPECT_EQ(sha256_of_file(file), kHashOfAbc);
  EXPECT_THROW(sha256_of_file(folder.path("none")), InputError);
}

}  // namespace
}  // namespace plumbline
