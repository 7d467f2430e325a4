#include "validation/identify/predict/kept_results.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/sha256.h"

namespace plumbline::validation {
namespace {

constexpr const char* kKind = "plumbline: results/1 ";

/// Hexadecimal: the same double when it is read back, infinities and NaN included.
std::string text_of(double number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::hex);
  return {text.data(), end.ptr};
}

double number_of(const std::string& text) {
  double number = 0.0;
  const char* last = text.data() + text.size();
  const auto read = std::from_chars(text.data(), last, number, std::chars_format::hex);
  if (read.ec != std::errc() || read.ptr != last) {
    throw std::invalid_argument(text);
  }
  return number;
}

/// The beginning of a line for a message, which is one line itself.
std::string shown(const std::string& line) {
  constexpr std::size_t kShown = 40;
  std::string text = line.substr(0, kShown);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
  return "`" + text + "`";
}

/// "hash count number ...".
std::string line_of(const std::string& hash, const Record& record) {
  std::string line = hash + " " + std::to_string(record.numbers().size());
  for (const double number : record.numbers()) {
    line += " " + text_of(number);
  }
  return line + "\n";
}

std::pair<std::string, Record> parsed(const std::string& line) {
  std::istringstream words(line);
  std::string hash;
  std::size_t count = 0;
  if (!(words >> hash >> count)) {
    throw std::invalid_argument(line);
  }
  std::vector<double> numbers;
  std::string word;
  while (words >> word) {
    numbers.push_back(number_of(word));
  }
  if (numbers.size() != count) {
    throw std::invalid_argument(line);
  }
  return {hash, Record(std::move(numbers))};
}

}  // namespace

Record& Record::add(double number) {
  numbers_.push_back(number);
  return *this;
}

Record& Record::add(const Eigen::VectorXd& vector) {
  add(static_cast<double>(vector.size()));
  numbers_.insert(numbers_.end(), vector.data(), vector.data() + vector.size());
  return *this;
}

Record& Record::add(const std::vector<Eigen::VectorXd>& vectors) {
  add(static_cast<double>(vectors.size()));
  for (const Eigen::VectorXd& one : vectors) {
    add(one);
  }
  return *this;
}

std::size_t RecordReader::count() {
  const double count = number();
  if (!(count >= 0.0 && count <= static_cast<double>(numbers_.size()))) {
    throw std::out_of_range("a count in a kept result");
  }
  return static_cast<std::size_t>(count);
}

Eigen::VectorXd RecordReader::vector() {
  Eigen::VectorXd vector(static_cast<Eigen::Index>(count()));
  for (double& one : vector) {
    one = number();
  }
  return vector;
}

std::vector<Eigen::VectorXd> RecordReader::vectors() {
  std::vector<Eigen::VectorXd> vectors(count());
  for (Eigen::VectorXd& one : vectors) {
    one = vector();
  }
  return vectors;
}

std::string ResultKey::hash() const {
  const std::vector<double>& values = numbers.numbers();
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  return sha256_of(words + '\n' + std::string(bytes, values.size() * sizeof(double)));
}

KeptResults::KeptResults(const std::string& file, const std::string& inputs, Access access) : file_(file) {
  if (std::filesystem::exists(file)) {
    read(inputs);
  }
  found_ = records_.size();
  if (access == Access::read) {
    return;
  }
  if (whole_) {
    std::filesystem::resize_file(file, *whole_);
  }
  out_.open(file, std::ios::app | std::ios::binary);
  if (out_ && std::filesystem::file_size(file) == 0) {
    out_ << kKind << inputs << '\n' << std::flush;
  }
  if (!out_) {
    throw InputError({file, 0, ""}, "no way to write it", "a file that can be written");
  }
}

void KeptResults::read(const std::string& inputs) {
  const std::string text = read_text(file_);
  std::size_t at = 0;
  int line = 1;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', at), ++line) {
    const std::string content = text.substr(at, end - at);
    if (line == 1) {
      if (content.rfind(kKind, 0) != 0) {
        throw InputError({file_, 1, ""}, shown(content), "`plumbline: results/1 ...`");
      }
      if (content != kKind + inputs) {
        throw InputError({file_, 1, ""}, "results of other files or of another version of the program",
                         "those of this work; name another file to begin anew");
      }
    } else {
      try {
        records_.insert(parsed(content));
      } catch (const std::invalid_argument&) {
        throw InputError({file_, line, ""}, shown(content), "a result: hash, count, numbers");
      }
    }
    at = end + 1;
  }
  if (line == 1 && (kKind + inputs).rfind(text, 0) != 0) {
    throw InputError({file_, 1, ""}, shown(text), "`plumbline: results/1 ...`");
  }
  whole_ = at;
}

Record KeptResults::get(const ResultKey& key, const std::function<Record()>& compute) {
  const std::string hash = key.hash();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = records_.find(hash);
    if (found != records_.end()) {
      return found->second;
    }
  }
  Record record = compute();
  keep(hash, record, true);
  return record;
}

void KeptResults::keep(const std::string& hash, const Record& record, bool is_own) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_own && is_listing_) {
    list_ += line_of(hash, record);
  }
  if (records_.emplace(hash, record).second && out_.is_open()) {
    out_ << line_of(hash, record) << std::flush;
  }
}

void KeptResults::begin_list() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_listing_ = true;
  list_.clear();
}

std::string KeptResults::end_list() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_listing_ = false;
  return std::move(list_);
}

void KeptResults::take(const std::string& list) {
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    const auto [hash, record] = parsed(line);
    keep(hash, record, false);
  }
}

}  // namespace plumbline::validation
