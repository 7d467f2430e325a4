// Canonical JSON: RFC 8785's own examples. canonical_node.cmake holds it against another implementation.
#include "controllers/driver/json.h"

#include <gtest/gtest.h>

#include <cstring>

namespace plumbline::driver {
namespace {

double from_bits(std::uint64_t bits) {
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

TEST(Json, NumbersAreThoseOfAppendixB) {
  const struct {
    std::uint64_t bits;
    const char* text;
  } cases[] = {{0x0000000000000000, "0"},
               {0x8000000000000000, "0"},
               {0x0000000000000001, "5e-324"},
               {0x8000000000000001, "-5e-324"},
               {0x7fefffffffffffff, "1.7976931348623157e+308"},
               {0x4340000000000000, "9007199254740992"},
               {0x4430000000000000, "295147905179352830000"},
               {0x44b52d02c7e14af5, "9.999999999999997e+22"},
               {0x44b52d02c7e14af6, "1e+23"},
               {0x44b52d02c7e14af7, "1.0000000000000001e+23"},
               {0x444b1ae4d6e2ef4e, "999999999999999700000"},
               {0x444b1ae4d6e2ef50, "1e+21"},
               {0x3eb0c6f7a0b5ed8c, "9.999999999999997e-7"},
               {0x3eb0c6f7a0b5ed8d, "0.000001"},
               {0x41b3de4355555555, "333333333.3333333"},
               {0xbecbf647612f3696, "-0.0000033333333333333333"},
               {0x43143ff3c1cb0959, "1424953923781206.2"}};
  for (const auto& one : cases) EXPECT_EQ(canonical_json(from_bits(one.bits)), one.text);
  EXPECT_THROW(canonical_json(from_bits(0x7fffffffffffffff)), DriverError);
  EXPECT_THROW(canonical_json(from_bits(0x7ff0000000000000)), DriverError);
}

TEST(Json, MembersAreSortedByTheirUtf16) {
  const std::string text =
      "{\"\\u20ac\":1,\"\\r\":2,\"\\ufb33\":3,\"1\":4,\"\\ud83d\\ude00\":5,\"\\u0080\":6,\"\\u00f6\":7}";
  EXPECT_EQ(canonical_json(parse_json(text)),
            "{\"\\r\":2,\"1\":4,\"\xc2\x80\":6,\"\xc3\xb6\":7,\"\xe2\x82\xac\":1,\"\xf0\x9f\x98\x80\":5,"
            "\"\xef\xac\xb3\":3}");
}

TEST(Json, TheExampleOfSection322) {
  const std::string text =
      "{ \"numbers\": [333333333.33333329, 1E30, 4.50, 2e-3, 0.000000000000000000000000001],\n"
      "  \"string\": \"\\u20ac$\\u000F\\u000aA'\\u0042\\u0022\\u005c\\\\\\\"\\/\", \"literals\": [null, "
      "true, false] }";
  EXPECT_EQ(canonical_json(parse_json(text)),
            "{\"literals\":[null,true,false],\"numbers\":[333333333.3333333,1e+30,4.5,0.002,1e-27],"
            "\"string\":\"\xe2\x82\xac$\\u000f\\nA'B\\\"\\\\\\\\\\\"/\"}");
}

TEST(Json, RefusesWhatIsNotJson) {
  for (const char* text :
       {"", "{", "[1,]", "{\"a\":1,}", "01", "1.", "+1", "nul", "\"\t\"", "\"\\x\"", "\"\\ud800\"", "1e999",
        "[1] 2", "{\"a\":1,\"a\":2}", "\"\xc0\x80\"", "\"\xed\xa0\x80\"", "{a:1}", "NaN"}) {
    EXPECT_THROW(parse_json(text), DriverError) << text;
  }
  EXPECT_THROW(parse_json(std::string(100000, '[')), DriverError);
  EXPECT_NO_THROW(parse_json(std::string(32, '[') + std::string(32, ']')));
}

TEST(DriverErrors, AreOneLine) {
  EXPECT_STREQ(DriverError("name \"a\nb\x7f\": unknown").what(), "name \"a b \": unknown");
}

}  // namespace
}  // namespace plumbline::driver
