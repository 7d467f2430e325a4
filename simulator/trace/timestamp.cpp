// Instants written as text.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "simulator/trace/log_file.h"

namespace plumbline {
namespace {

/// Takes a number of digits from the front; -1 where they are not there.
int take_digits(std::string_view& text, std::size_t digits) {
  int value = -1;
  if (text.size() >= digits) {
    const auto result = std::from_chars(text.data(), text.data() + digits, value);
    if (result.ec != std::errc() || result.ptr != text.data() + digits) {
      return -1;
    }
    text.remove_prefix(digits);
  }
  return value;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == std::string_view::npos) {
    return false;
  }
  text.remove_prefix(1);
  return true;
}

/// Days since 1970-01-01 of a date of the Gregorian calendar. Source: H. Hinnant, "chrono-Compatible
/// Low-Level Date Algorithms" (days_from_civil), 2013.
long days_since_1970(int year, int month, int day) {
  const int y = month <= 2 ? year - 1 : year;
  const int era = y / 400;
  const int of_era = y - era * 400;
  const int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const int day_of_era = of_era * 365 + of_era / 4 - of_era / 100 + of_year;
  return era * 146097L + day_of_era - 719468L;
}

/// Share of a second behind a point.
double take_fraction(std::string_view& text) {
  double fraction = 0.0;
  if (take(text, ".,")) {
    for (double place = 0.1; !text.empty() && text.front() >= '0' && text.front() <= '9'; place *= 0.1) {
      fraction += place * (text.front() - '0');
      text.remove_prefix(1);
    }
  }
  return fraction;
}

}  // namespace

double timestamp_seconds(std::string_view text) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const int year = take_digits(text, 4);
  if (year < 1970 || !take(text, "-/")) {
    return kNone;
  }
  const int month = take_digits(text, 2);
  const bool dashed = take(text, "-/");
  const int day = take_digits(text, 2);
  if (!dashed || month < 1 || month > 12 || day < 1 || day > 31 || !take(text, "T ")) {
    return kNone;
  }
  std::array<int, 3> clock{};
  for (std::size_t i = 0; i < clock.size(); ++i) {
    clock[i] = i > 0 && !take(text, ":") ? -1 : take_digits(text, 2);
    if (clock[i] < 0) {
      return kNone;
    }
  }
  const double fraction = take_fraction(text);
  double offset = 0.0;
  if (!take(text, "Z") && !text.empty()) {
    const double sign = text.front() == '-' ? -1.0 : 1.0;
    if (!take(text, "+-")) {
      return kNone;
    }
    const int hours = take_digits(text, 2);
    take(text, ":");
    const int minutes = text.empty() ? 0 : take_digits(text, 2);
    if (hours < 0 || minutes < 0) {
      return kNone;
    }
    offset = sign * (3600.0 * hours + 60.0 * minutes);
  }
  if (!text.empty()) {
    return kNone;
  }
  return 86400.0 * static_cast<double>(days_since_1970(year, month, day)) + 3600.0 * clock[0] +
         60.0 * clock[1] + clock[2] - offset + fraction;
}

}  // namespace plumbline
