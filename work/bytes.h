// The bytes of a result that travels between ranks: numbers and texts in a row, exactly as they are in
// memory.
#pragma once

#include <string>
#include <vector>

namespace plumbline::work {

class Bytes {
 public:
  Bytes& add(double number);
  Bytes& add(const std::string& text);
  /// So many numbers, with their count before them.
  Bytes& add(const double* numbers, std::size_t count);
  Bytes& add(const std::vector<double>& numbers) { return add(numbers.data(), numbers.size()); }

  const std::string& all() const { return all_; }

 private:
  std::string all_;
};

/// Reads in the order in which was added. Throws std::out_of_range behind the end.
class BytesReader {
 public:
  /// `all` must outlive the reader.
  explicit BytesReader(const std::string& all) : all_(all) {}

  double number();
  std::string text();
  std::vector<double> numbers();
  bool at_end() const { return next_ == all_.size(); }

 private:
  void take(void* to, std::size_t size);

  const std::string& all_;
  std::size_t next_ = 0;
};

}  // namespace plumbline::work
