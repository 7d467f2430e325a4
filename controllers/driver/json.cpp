#include "controllers/driver/json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace plumbline::driver {
namespace {

constexpr int kDeepest = 32;

// Length of the UTF-8 sequence at `at`; 0 where there is none (RFC 3629: no surrogates, nothing overlong).
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) {
    return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0U;
  };
  const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80U) return 1;
  if (first >= 0xC2U && first <= 0xDFU) return follows(1) ? 2 : 0;
  if (first >= 0xE0U && first <= 0xEFU) {
    if (!follows(1) || !follows(2)) return 0;
    if (first == 0xE0U && byte(1) < 0xA0U) return 0;
    if (first == 0xEDU && byte(1) > 0x9FU) return 0;
    return 3;
  }
  if (first >= 0xF0U && first <= 0xF4U) {
    if (!follows(1) || !follows(2) || !follows(3)) return 0;
    if (first == 0xF0U && byte(1) < 0x90U) return 0;
    if (first == 0xF4U && byte(1) > 0x8FU) return 0;
    return 4;
  }
  return 0;
}

void append_utf8(std::string& out, unsigned code) {
  const auto byte = [&](unsigned value) { out.push_back(static_cast<char>(value)); };
  if (code < 0x80U) {
    byte(code);
  } else if (code < 0x800U) {
    byte(0xC0U | (code >> 6U));
    byte(0x80U | (code & 0x3FU));
  } else if (code < 0x10000U) {
    byte(0xE0U | (code >> 12U));
    byte(0x80U | ((code >> 6U) & 0x3FU));
    byte(0x80U | (code & 0x3FU));
  } else {
    byte(0xF0U | (code >> 18U));
    byte(0x80U | ((code >> 12U) & 0x3FU));
    byte(0x80U | ((code >> 6U) & 0x3FU));
    byte(0x80U | (code & 0x3FU));
  }
}

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  Json all() {
    Json value = read(0);
    space();
    if (at_ != text_.size()) fail("something behind the value");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw DriverError("JSON, byte " + std::to_string(at_) + ": " + what);
  }
  bool more() const { return at_ < text_.size(); }
  char peek() const { return more() ? text_[at_] : '\0'; }
  void space() {
    while (more() && (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r')) ++at_;
  }
  void expect(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) fail("expected \"" + std::string(word) + "\"");
    at_ += word.size();
  }

  Json read(int depth) {
    if (depth > kDeepest) fail("more than 32 levels");
    space();
    switch (peek()) {
      case '{':
        return object(depth);
      case '[':
        return array(depth);
      case '"':
        return Json(string());
      case 't':
        expect("true");
        return Json(true);
      case 'f':
        expect("false");
        return Json(false);
      case 'n':
        expect("null");
        return {};
      default:
        return Json(number());
    }
  }

  Json object(int depth) {
    Json::Object members;
    ++at_;
    space();
    if (peek() == '}') {
      ++at_;
      return Json(std::move(members));
    }
    while (true) {
      space();
      if (peek() != '"') fail("expected a member's name");
      std::string name = string();
      space();
      expect(":");
      if (members.count(name) != 0) fail("member \"" + name + "\" occurs twice");
      members.emplace(std::move(name), read(depth + 1));
      space();
      if (peek() == '}') break;
      expect(",");
    }
    ++at_;
    return Json(std::move(members));
  }

  Json array(int depth) {
    Json::Array values;
    ++at_;
    space();
    if (peek() == ']') {
      ++at_;
      return Json(std::move(values));
    }
    while (true) {
      values.push_back(read(depth + 1));
      space();
      if (peek() == ']') break;
      expect(",");
    }
    ++at_;
    return Json(std::move(values));
  }

  unsigned hex4() {
    unsigned code = 0;
    for (int k = 0; k < 4; ++k) {
      const char c = peek();
      unsigned digit = 0;
      if (c >= '0' && c <= '9') {
        digit = static_cast<unsigned>(c - '0');
      } else if (c >= 'a' && c <= 'f') {
        digit = static_cast<unsigned>(c - 'a') + 10U;
      } else if (c >= 'A' && c <= 'F') {
        digit = static_cast<unsigned>(c - 'A') + 10U;
      } else {
        fail("expected four hexadecimal digits");
      }
      code = code * 16U + digit;
      ++at_;
    }
    return code;
  }

  void escape(std::string& out) {
    ++at_;
    const char c = peek();
    ++at_;
    static constexpr std::string_view kNames = "\"\\/bfnrt";
    static constexpr std::string_view kValues = "\"\\/\b\f\n\r\t";
    if (const std::size_t index = kNames.find(c); c != '\0' && index != std::string_view::npos) {
      out.push_back(kValues[index]);
      return;
    }
    if (c != 'u') fail("unknown escape");
    unsigned code = hex4();
    if (code >= 0xDC00U && code <= 0xDFFFU) fail("half of a surrogate pair");
    if (code >= 0xD800U && code <= 0xDBFFU) {
      expect("\\u");
      const unsigned low = hex4();
      if (low < 0xDC00U || low > 0xDFFFU) fail("half of a surrogate pair");
      code = 0x10000U + ((code - 0xD800U) << 10U) + (low - 0xDC00U);
    }
    append_utf8(out, code);
  }

  std::string string() {
    std::string out;
    ++at_;
    while (true) {
      if (!more()) fail("text without an end");
      const char c = peek();
      if (c == '"') break;
      if (static_cast<unsigned char>(c) < 0x20U) fail("a control character in a text");
      if (c == '\\') {
        escape(out);
        continue;
      }
      const std::size_t length = utf8_length(text_, at_);
      if (length == 0) fail("text that is not UTF-8");
      out.append(text_.substr(at_, length));
      at_ += length;
    }
    ++at_;
    return out;
  }

  void digits() {
    if (peek() < '0' || peek() > '9') fail("expected a value");
    while (peek() >= '0' && peek() <= '9') ++at_;
  }

  double number() {
    const std::size_t from = at_;
    if (peek() == '-') ++at_;
    if (peek() == '0') {
      ++at_;
    } else {
      digits();
    }
    if (peek() == '.') {
      ++at_;
      digits();
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_;
      if (peek() == '+' || peek() == '-') ++at_;
      digits();
    }
    double value = 0.0;
    const char* const begin = text_.data() + from;
    const auto result = std::from_chars(begin, text_.data() + at_, value);
    if (result.ec != std::errc() || result.ptr != text_.data() + at_) fail("a number beyond a double");
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

void write_text(std::string& out, const std::string& text) {
  static constexpr char kHex[] = "0123456789abcdef";
  out.push_back('"');
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    static constexpr std::string_view kValues = "\"\\\b\f\n\r\t";
    static constexpr std::string_view kNames = "\"\\bfnrt";
    if (const std::size_t index = kValues.find(c); index != std::string_view::npos) {
      out.push_back('\\');
      out.push_back(kNames[index]);
    } else if (byte < 0x20U) {
      out.append("\\u00");
      out.push_back(kHex[byte >> 4U]);
      out.push_back(kHex[byte & 15U]);
    } else {
      out.push_back(c);
    }
  }
  out.push_back('"');
}

// ECMAScript's Number::toString: plain digits for 1e-6 <= |value| < 1e21, an exponent otherwise.
void write_number(std::string& out, double value) {
  if (!std::isfinite(value)) throw DriverError("JSON has no number that is not finite");
  if (value == 0.0) {
    out.push_back('0');  // minus zero too
    return;
  }
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, std::abs(value), std::chars_format::scientific).ptr;
  const std::string_view written(buffer, static_cast<std::size_t>(end - buffer));  // d.ddde+xx
  const std::size_t e = written.find('e');
  std::string digits(written.substr(0, e));
  digits.erase(std::remove(digits.begin(), digits.end(), '.'), digits.end());
  int exponent = 0;
  const std::size_t sign = written[e + 1] == '+' ? e + 2 : e + 1;
  std::from_chars(written.data() + sign, written.data() + written.size(), exponent);
  const int k = static_cast<int>(digits.size());
  const int n = exponent + 1;  // the value is 0.digits times 10^n
  if (value < 0.0) out.push_back('-');
  if (n >= k && n <= 21) {
    out += digits + std::string(static_cast<std::size_t>(n - k), '0');
  } else if (n > 0 && n <= 21) {
    out += digits.substr(0, static_cast<std::size_t>(n)) + "." + digits.substr(static_cast<std::size_t>(n));
  } else if (n > -6 && n <= 0) {
    out += "0." + std::string(static_cast<std::size_t>(-n), '0') + digits;
  } else {
    out += digits.substr(0, 1);
    if (k > 1) out += "." + digits.substr(1);
    out += n - 1 >= 0 ? "e+" : "e-";
    out += std::to_string(std::abs(n - 1));
  }
}

std::u16string utf16(std::string_view text) {
  std::u16string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, at), 1);
    const auto byte = [&](std::size_t k) {
      return static_cast<unsigned>(static_cast<unsigned char>(text[at + k]));
    };
    unsigned code = byte(0);
    if (length == 2) code = ((code & 0x1FU) << 6U) | (byte(1) & 0x3FU);
    if (length == 3) code = ((code & 0x0FU) << 12U) | ((byte(1) & 0x3FU) << 6U) | (byte(2) & 0x3FU);
    if (length == 4) {
      code = ((code & 0x07U) << 18U) | ((byte(1) & 0x3FU) << 12U) | ((byte(2) & 0x3FU) << 6U) |
             (byte(3) & 0x3FU);
      out.push_back(static_cast<char16_t>(0xD800U + ((code - 0x10000U) >> 10U)));
      out.push_back(static_cast<char16_t>(0xDC00U + ((code - 0x10000U) & 0x3FFU)));
    } else {
      out.push_back(static_cast<char16_t>(code));
    }
    at += length;
  }
  return out;
}

void write(std::string& out, const Json& value) {
  if (value.is_null()) {
    out += "null";
  } else if (value.is_bool()) {
    out += value.boolean() ? "true" : "false";
  } else if (value.is_number()) {
    write_number(out, value.number());
  } else if (value.is_string()) {
    write_text(out, value.text());
  } else if (value.is_array()) {
    out.push_back('[');
    const char* between = "";
    for (const Json& one : value.array()) {
      out += between;
      write(out, one);
      between = ",";
    }
    out.push_back(']');
  } else {
    std::vector<std::pair<std::u16string, const Json::Object::value_type*>> members;
    for (const auto& member : value.object()) members.emplace_back(utf16(member.first), &member);
    std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    out.push_back('{');
    const char* between = "";
    for (const auto& member : members) {
      out += between;
      write_text(out, member.second->first);
      out.push_back(':');
      write(out, member.second->second);
      between = ",";
    }
    out.push_back('}');
  }
}

template <typename Kind, typename Value>
const Kind& as(const Value& value, const char* expected) {
  if (const Kind* kind = std::get_if<Kind>(&value)) return *kind;
  throw DriverError(std::string("expected ") + expected);
}

}  // namespace

const Json::Object& Json::object() const { return as<Object>(value_, "an object"); }
const Json::Array& Json::array() const { return as<Array>(value_, "a list"); }
double Json::number() const { return as<double>(value_, "a number"); }
const std::string& Json::text() const { return as<std::string>(value_, "a text"); }
bool Json::boolean() const { return as<bool>(value_, "true or false"); }

const Json* Json::find(std::string_view name) const {
  const Object& members = object();
  const auto found = members.find(name);
  return found == members.end() ? nullptr : &found->second;
}

const Json& Json::at(std::string_view name) const {
  const Json* found = find(name);
  if (found == nullptr) throw DriverError("no member \"" + std::string(name) + "\"");
  return *found;
}

Json& Json::operator[](const std::string& name) {
  if (is_null()) value_ = Object();
  return std::get<Object>(value_)[name];
}

void Json::push_back(Json value) {
  if (is_null()) value_ = Array();
  std::get<Array>(value_).push_back(std::move(value));
}

Json parse_json(std::string_view text) { return Reader(text).all(); }

std::string canonical_json(const Json& value) {
  std::string out;
  write(out, value);
  return out;
}

}  // namespace plumbline::driver
