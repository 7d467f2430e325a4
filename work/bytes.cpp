#include "work/bytes.h"

#include <cstring>
#include <stdexcept>

namespace plumbline::work {

Bytes& Bytes::add(double number) {
  all_.append(reinterpret_cast<const char*>(&number), sizeof number);
  return *this;
}

Bytes& Bytes::add(const std::string& text) {
  add(static_cast<double>(text.size()));
  all_ += text;
  return *this;
}

Bytes& Bytes::add(const double* numbers, std::size_t count) {
  add(static_cast<double>(count));
  all_.append(reinterpret_cast<const char*>(numbers), count * sizeof(double));
  return *this;
}

void BytesReader::take(void* to, std::size_t size) {
  if (size > all_.size() - next_) {
    throw std::out_of_range("bytes of a result end too early");
  }
  if (size > 0) {
    std::memcpy(to, all_.data() + next_, size);
  }
  next_ += size;
}

double BytesReader::number() {
  double number = 0.0;
  take(&number, sizeof number);
  return number;
}

std::string BytesReader::text() {
  std::string text(static_cast<std::size_t>(number()), '\0');
  take(text.data(), text.size());
  return text;
}

std::vector<double> BytesReader::numbers() {
  std::vector<double> numbers(static_cast<std::size_t>(number()));
  take(numbers.data(), numbers.size() * sizeof(double));
  return numbers;
}

}  // namespace plumbline::work
