// Evaluates a law's written equation, so that what is documented is what the code computes.
#pragma once

#include <map>
#include <string>

namespace plumbline::effects {

/// "f = EXPR; a = EXPR; ...": named expressions over numbers, symbols, + - * / ^, |...|, ( ),
/// tanh exp sqrt sin cos sgn abs min max, and "EXPR if A > B else EXPR".
class Equations {
 public:
  explicit Equations(const std::string& text);
  bool defines(const std::string& name) const { return definitions_.count(name) > 0; }
  /// Throws std::runtime_error on unknown symbols or text that is no expression.
  double value(const std::string& name, const std::map<std::string, double>& symbols) const;

 private:
  std::map<std::string, std::string> definitions_;
};

}  // namespace plumbline::effects
