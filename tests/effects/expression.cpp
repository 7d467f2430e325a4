#include "tests/effects/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

namespace plumbline::effects {
namespace {

using Lookup = std::function<double(const std::string&)>;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  const auto last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

double call(const std::string& name, const std::vector<double>& a) {
  if (a.size() == 2 && name == "min") return std::min(a[0], a[1]);
  if (a.size() == 2 && name == "max") return std::max(a[0], a[1]);
  if (a.size() != 1) throw std::runtime_error("wrong arguments of " + name);
  if (name == "tanh") return std::tanh(a[0]);
  if (name == "exp") return std::exp(a[0]);
  if (name == "sqrt") return std::sqrt(a[0]);
  if (name == "sin") return std::sin(a[0]);
  if (name == "cos") return std::cos(a[0]);
  if (name == "sgn") return a[0] > 0 ? 1.0 : (a[0] < 0 ? -1.0 : 0.0);
  throw std::runtime_error("unknown function " + name);
}

// Recursive descent; one object for one text.
class Parser {
 public:
  Parser(const std::string& text, const Lookup& lookup) : text_(text), lookup_(lookup) {}

  double whole() {
    const double result = conditional();
    skip_spaces();
    if (at_ != text_.size()) throw std::runtime_error("unreadable: " + text_.substr(at_));
    return result;
  }

 private:
  double conditional() {
    const double yes = sum();
    if (!word("if")) return yes;
    const double left = sum();
    expect('>');
    const double right = sum();
    if (!word("else")) throw std::runtime_error("if without else");
    const double no = sum();
    return left > right ? yes : no;
  }

  double sum() {
    double result = product();
    for (;;) {
      if (accept('+')) {
        result += product();
      } else if (accept('-')) {
        result -= product();
      } else {
        return result;
      }
    }
  }

  double product() {
    double result = signed_power();
    for (;;) {
      if (accept('*')) {
        result *= signed_power();
      } else if (accept('/')) {
        result /= signed_power();
      } else {
        return result;
      }
    }
  }

  double signed_power() {
    if (accept('-')) return -signed_power();
    const double base = primary();
    return accept('^') ? std::pow(base, primary()) : base;
  }

  double primary() {
    if (accept('(')) {
      const double result = sum();
      expect(')');
      return result;
    }
    if (accept('|')) {
      const double result = sum();
      expect('|');
      return std::abs(result);
    }
    skip_spaces();
    if (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0) return number();
    const std::string name = identifier();
    if (!accept('(')) return name == "pi" ? 3.14159265358979323846 : lookup_(name);
    std::vector<double> arguments{sum()};
    while (accept(',')) arguments.push_back(sum());
    expect(')');
    return call(name, arguments);
  }

  double number() {
    std::size_t used = 0;
    const double result = std::stod(text_.substr(at_), &used);
    at_ += used;
    return result;
  }

  std::string identifier() {
    const std::size_t first = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_')) {
      ++at_;
    }
    if (at_ == first) throw std::runtime_error("unreadable: " + text_.substr(at_));
    return text_.substr(first, at_ - first);
  }

  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  bool accept(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  bool word(const std::string& expected) {
    skip_spaces();
    if (text_.compare(at_, expected.size() + 1, expected + " ") != 0) return false;
    at_ += expected.size();
    return true;
  }

  void expect(char c) {
    if (!accept(c)) throw std::runtime_error(std::string("expected ") + c + " before: " + text_.substr(at_));
  }

  const std::string& text_;
  const Lookup& lookup_;
  std::size_t at_ = 0;
};

}  // namespace

Equations::Equations(const std::string& text) {
  std::size_t first = 0;
  while (first <= text.size()) {
    const std::size_t end = std::min(text.find(';', first), text.size());
    const std::string part = text.substr(first, end - first);
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) throw std::runtime_error("no definition: " + part);
    definitions_[trimmed(part.substr(0, equals))] = trimmed(part.substr(equals + 1));
    first = end + 1;
  }
}

double Equations::value(const std::string& name, const std::map<std::string, double>& symbols) const {
  const auto definition = definitions_.find(name);
  if (definition == definitions_.end()) throw std::runtime_error("unknown symbol " + name);
  const Lookup lookup = [&](const std::string& symbol) {
    const auto known = symbols.find(symbol);
    return known != symbols.end() ? known->second : value(symbol, symbols);
  };
  return Parser(definition->second, lookup).whole();
}

}  // namespace plumbline::effects
