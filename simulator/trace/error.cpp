#include "simulator/trace/error.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>

namespace plumbline {
namespace {

constexpr std::size_t kLongestFound = 120;
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kMostSuggestions = 3;
constexpr std::size_t kMostKnown = 16;

/// Whatever a file held, the message stays one readable line.
std::string one_line(const std::string& text, std::size_t longest = std::string::npos) {
  std::string line;
  for (const char c : text.substr(0, std::min(text.size(), longest))) {
    line += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
  }
  return text.size() > longest ? line + "..." : line;
}

std::string message(const Place_in_file& where, const std::string& found, const std::string& expected) {
  std::string text = where.file;
  if (where.line > 0) {
    text += ":" + std::to_string(where.line);
  }
  text += text.empty() ? "" : ": ";
  if (!where.key.empty()) {
    text += one_line(where.key, kLongestFound) + ": ";
  }
  return one_line(text + "found " + one_line(found, kLongestFound) + ", expected " + expected);
}

std::string lower_case(const std::string& text) {
  std::string lower = text.substr(0, std::min(text.size(), kLongestName));
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// Insertions, deletions, substitutions and swaps of neighbours that turn one name into the other (optimal
/// string alignment: Damerau 1964).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

bool is_near(const std::string& a, const std::string& b, std::size_t distance) {
  const std::size_t longer = std::max(a.size(), b.size());
  const bool contained = a.size() >= 3 && b.find(a) != std::string::npos;
  return contained || distance <= std::max<std::size_t>(1, longer / 3);
}

std::string join(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    text += (i == 0 ? "" : ", ") + one_line(names[i], kLongestName);
  }
  return names.size() > most ? text + ", ..." : text;
}

}  // namespace

InputError::InputError(const Place_in_file& where, const std::string& found, const std::string& expected)
    : std::runtime_error(message(where, found, expected)) {}

std::string nearest_names(const std::string& given, const std::vector<std::string>& known) {
  const std::string wanted = lower_case(given);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& name : known) {
    const std::string candidate = lower_case(name);
    const std::size_t distance = edit_distance(wanted, candidate);
    if (is_near(wanted, candidate, distance)) {
      near.emplace_back(distance, name);
    }
  }
  if (near.empty()) {
    return known.empty() ? "; none are known" : "; known: " + join(known, kMostKnown);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  names.reserve(near.size());
  for (const auto& [distance, name] : near) {
    names.push_back(name);
  }
  names.resize(std::min(names.size(), kMostSuggestions));
  return "; did you mean " + join(names, kMostSuggestions) + "?";
}

}  // namespace plumbline
