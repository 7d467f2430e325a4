#include "simulator/effects/documentation.h"

#include <cmath>
#include <sstream>

namespace plumbline::effects {
namespace {

// A bar would end the table's cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string number(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

// Positive shapes (a speed over which friction fades) have no null value of their own.
std::string value_word(const Parameter& parameter) {
  if (parameter.structural) return "fixed, standard ";
  return parameter.scale == Scale::logarithm ? "standard " : "null ";
}

std::string parameter_text(const Parameter& parameter) {
  return "`" + parameter.name + "` [" + unit_in_words(parameter.unit) + "] " + parameter.meaning + "; " +
         value_word(parameter) + number(parameter.null_value) + ", " + number(parameter.lower) + " to " +
         number(parameter.upper);
}

std::string row(const Declaration& law) {
  std::vector<std::string> places;
  for (const Place place : law.places) places.push_back(to_string(place));
  std::vector<std::string> parameters;
  for (const auto& parameter : law.parameters) parameters.push_back(parameter_text(parameter));
  const std::vector<std::string> cells = {"**" + law.name + "**: " + law.summary,
                                          joined(places, ", "),
                                          "`" + law.equation + "`",
                                          joined(parameters, "<br>"),
                                          joined(law.states, ", "),
                                          law.power_note,
                                          law.source};
  std::string line = "|";
  for (const auto& text : cells) line += " " + cell(text) + " |";
  return line + "\n";
}

}  // namespace

std::string unit_in_words(const std::string& general_unit) {
  const std::string rotary = unit_at(general_unit, true);
  const std::string linear = unit_at(general_unit, false);
  return rotary == linear ? rotary : rotary + " or " + linear;
}

std::string documentation_table(const Catalogue& catalogue) {
  std::string table =
      "| effect | sits at | equation | parameters | states | energy | source |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const auto& law : catalogue.laws()) table += row(law->declaration());
  return table;
}

}  // namespace plumbline::effects
