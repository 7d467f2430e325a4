#include "tests/fuzz/mutator.h"

#include <array>
#include <utility>
#include <vector>

namespace plumbline::test {
namespace {

/// What has broken readers of numbers, YAML, XML, CSV and units before.
// NOLINTNEXTLINE(readability-function-size): a table
const std::vector<std::string>& tokens() {
  static const std::vector<std::string> list{".inf",
                                             "-.inf",
                                             ".nan",
                                             "nan",
                                             "inf",
                                             "1e999",
                                             "-1e999",
                                             "1e-400",
                                             "-0",
                                             "0",
                                             "-1",
                                             "0x1p3",
                                             "1e308",
                                             "5e-324",
                                             "999999999999999999999",
                                             "{",
                                             "}",
                                             "[",
                                             "]",
                                             ",",
                                             ":",
                                             ": ",
                                             "- ",
                                             "? ",
                                             "&a ",
                                             "*a",
                                             "<<: *a",
                                             "!!binary ",
                                             "!!float ",
                                             "!",
                                             "|\n",
                                             ">\n",
                                             "%",
                                             "%YAML 1.2\n",
                                             "---\n",
                                             "...\n",
                                             "\"",
                                             "'",
                                             "#",
                                             "@",
                                             "`",
                                             "\\",
                                             "\n",
                                             "\r",
                                             "\r\n",
                                             "\t",
                                             " ",
                                             "  ",
                                             std::string(1, '\0'),
                                             "\xEF\xBB\xBF",
                                             "\xFF\xFE",
                                             "\xC0\x80",
                                             "\xF4\x90\x80\x80",
                                             "null",
                                             "~",
                                             "true",
                                             "yes",
                                             "<",
                                             ">",
                                             "/>",
                                             "</",
                                             "<!--",
                                             "-->",
                                             "<![CDATA[",
                                             "&lt;",
                                             "&#0;",
                                             "&#x110000;",
                                             "<?",
                                             "<!DOCTYPE a [<!ENTITY b \"c\">]>",
                                             "&b;",
                                             "m^2",
                                             "rad",
                                             "degC",
                                             "N m",
                                             "m^1.5",
                                             "m^-1",
                                             "since 1970",
                                             "@ 5",
                                             "kg",
                                             "world",
                                             "__model__",
                                             "__root__",
                                             "::",
                                             "model.yaml",
                                             "../",
                                             "arm.sdf",
                                             std::string(300, '['),
                                             std::string(300, '('),
                                             std::string(3000, 'x'),
                                             std::string(50, ','),
                                             std::string(40, '\n'),
                                             std::string(20, '-')};
  return list;
}

bool is_number_char(char c) { return (c >= '0' && c <= '9') || c == '.'; }
bool is_word_char(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

template <typename Predicate>
std::vector<std::pair<std::size_t, std::size_t>> runs(const std::string& text, Predicate is_inside) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t begin = i;
    while (i < text.size() && is_inside(text[i])) {
      ++i;
    }
    if (i > begin) {
      found.emplace_back(begin, i - begin);
    }
  }
  return found;
}

}  // namespace

std::string Mutator::mutate(std::string text) {
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes; ++i) {
    change(text);
  }
  return text;
}

void Mutator::change_number(std::string& text) {
  static const std::array<const char*, 10> numbers{"0",      "-1",    "1e999", ".inf", ".nan",
                                                   "1e-300", "1e300", "abc",   "",     "-0.5"};
  const auto places = runs(text, is_number_char);
  if (!places.empty()) {
    const auto [at, size] = places[below(places.size())];
    text.replace(at, size, numbers.at(below(numbers.size())));
  }
}

void Mutator::swap_words(std::string& text) {
  const auto places = runs(text, is_word_char);
  if (places.size() > 1) {
    const auto [to, to_size] = places[below(places.size())];
    const auto [from, from_size] = places[below(places.size())];
    text.replace(to, to_size, text.substr(from, from_size));
  }
}

void Mutator::change(std::string& text) {
  const std::size_t at = below(text.size() + 1);
  const std::size_t length = 1 + below(1 + below(40));
  switch (below(9)) {
    case 0:
      text.erase(std::min(at, text.size()), length);
      break;
    case 1:
      text.insert(at, tokens()[below(tokens().size())]);
      break;
    case 2:
      text.insert(below(text.size() + 1), text.substr(at, length * 4));
      break;
    case 3:
      if (at < text.size()) {
        text[at] = static_cast<char>(below(256));
      }
      break;
    case 4:
      if (at < text.size()) {
        text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1U << below(8)));
      }
      break;
    case 5:
      change_number(text);
      break;
    case 6:
      swap_words(text);
      break;
    case 7:
      text.replace(std::min(at, text.size()), length, tokens()[below(tokens().size())]);
      break;
    default:
      if (below(6) == 0) {
        text.resize(at);  // a file that was cut off
      } else {
        change_number(text);
      }
  }
}

}  // namespace plumbline::test
