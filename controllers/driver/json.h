// JSON of certificates: a strict reader, and the canonical form of RFC 8785 that is signed.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace plumbline::driver {

/// What is wrong with a file or a request, in one line.
class DriverError : public std::runtime_error {
 public:
  /// One line whatever a file has in its names: control characters become spaces.
  explicit DriverError(std::string what) : std::runtime_error(one_line(std::move(what))) {}

 private:
  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = ' ';
    }
    return text;
  }
};

/// One value. Numbers are doubles; objects keep their members sorted by name.
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::map<std::string, Json, std::less<>>;

  Json() = default;                                        ///< null
  Json(bool value) : value_(value) {}                      // NOLINT(google-explicit-constructor)
  Json(double value) : value_(value) {}                    // NOLINT(google-explicit-constructor)
  Json(int value) : value_(static_cast<double>(value)) {}  // NOLINT(google-explicit-constructor)
  Json(const char* value) : value_(std::string(value)) {}  // NOLINT(google-explicit-constructor)
  Json(std::string value) : value_(std::move(value)) {}    // NOLINT(google-explicit-constructor)
  Json(Array value) : value_(std::move(value)) {}          // NOLINT(google-explicit-constructor)
  Json(Object value) : value_(std::move(value)) {}         // NOLINT(google-explicit-constructor)

  bool is_object() const { return std::holds_alternative<Object>(value_); }
  bool is_array() const { return std::holds_alternative<Array>(value_); }
  bool is_number() const { return std::holds_alternative<double>(value_); }
  bool is_string() const { return std::holds_alternative<std::string>(value_); }
  bool is_bool() const { return std::holds_alternative<bool>(value_); }
  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }

  /// Each throws DriverError when the value is of another kind.
  const Object& object() const;
  const Array& array() const;
  double number() const;
  const std::string& text() const;
  bool boolean() const;

  /// Member of an object; throws DriverError naming it when it is not there.
  const Json& at(std::string_view name) const;
  /// Null when it is not there.
  const Json* find(std::string_view name) const;
  /// Makes an object of a null, and the member when it is not there.
  Json& operator[](const std::string& name);
  void push_back(Json value);

  bool operator==(const Json& other) const { return value_ == other.value_; }

 private:
  std::variant<std::monostate, bool, double, std::string, Array, Object> value_;
};

/// Reads exactly one value. Refused, with the byte's place: anything that RFC 8259 does not allow, members
/// that occur twice, numbers beyond a double, text that is not UTF-8, and more than 32 levels.
Json parse_json(std::string_view text);

/// RFC 8785: no white space, members sorted by their UTF-16 code units, numbers as ECMAScript writes them
/// (the shortest decimal that reads back to the same double). Throws DriverError for a number that is not
/// finite.
std::string canonical_json(const Json& value);

}  // namespace plumbline::driver
