#include "validation/api/effects_page.h"

#include <algorithm>
#include <vector>

#include "simulator/effects/documentation.h"
#include "validation/api/effects_guide.h"
#include "validation/api/effects_picture.h"

namespace plumbline::api {
namespace {

using effects::Declaration;

// A bar would end the table's cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  }
  return escaped;
}

std::string place_of(const Declaration& law) {
  std::string text;
  for (const effects::Place place : law.places) {
    text += (text.empty() ? "" : " or ") + effects::to_string(place);
  }
  return text;
}

std::string parameters_of(const Declaration& law) {
  std::string text;
  for (const effects::Parameter& parameter : law.parameters) {
    text += (text.empty() ? "" : ", ") + ("`" + parameter.name) + "` " + parameter.meaning + " [" +
            effects::unit_in_words(parameter.unit) + "]";
  }
  return text;
}

std::string row(const effects::Law& law) {
  const Declaration& declared = law.declaration();
  const EffectGuide* guide = find_guide(declared.name);
  const std::string picture =
      effect_picture(law).empty() ? "" : "![" + declared.name + "](images/effects/" + declared.name + ".svg)";
  std::string says = "**" + declared.name + "** at " + place_of(declared) + ": " + declared.summary +
                     ".<br>`" + declared.equation + "`<br>" + parameters_of(declared) + ".";
  for (const std::string& state : declared.states) {
    says += "<br>State: " + state + ".";
  }
  if (!declared.power_note.empty()) {
    says += "<br>Energy: " + declared.power_note;
  }
  says += "<br>Source: " + declared.source + ".";
  return "| " + picture + " | " + cell(says) + " | " + cell(guide == nullptr ? "" : guide->confused_with) +
         " | " + cell(guide == nullptr ? "" : guide->experiment) + " |\n";
}

constexpr const char* kHead =
    "# Effects\n\n"
    "<!-- Made by `plumbline effects --page`; change the laws in simulator/effects and contact, or\n"
    "validation/api/effects_guide.cpp, and print it again. -->\n\n"
    "The catalogue: what a diagnosis can name. `plumbline effects NAME` has bounds and null values, "
    "[design.md](design.md) the four kinds of\nlaws, [CONTRIBUTING.md](../CONTRIBUTING.md) how to add one. A "
    "force is drawn over position and velocity, along a sine, under a\ntorque that swings with it; an "
    "actuator's "
    "torque over its command and in time; a sensor's reading and error over the true value,\n"
    "an inertial sensor's of a vector that turns once. Inertias, "
    "delays, the battery and "
    "the ground have no picture. In equations `x` and `v` are position and velocity of the place, `u` is "
    "the\n"
    "command in torque units, `load` the torque that the motor delivers, or that its gear passes on.\n\n"
    "What two laws say together has no third: a cable harness is `spring`, `hardening` and `hysteresis` of "
    "one "
    "coordinate; the two waves a\nturn of a harmonic drive are `encoder_eccentricity` (waves 2) and "
    "`cogging` "
    "(cycles 2) of its motor; a mounting that yields and a link\nthat bends are `resonator` with a negative "
    "`rotor_inertia`; clocks of command and measurement apart are a `bus_delay` of all motors,\n"
    "and `clock_drift` where the two run apart.\n";

}  // namespace

std::string effects_page(const effects::Catalogue& catalogue) {
  std::string page = kHead;
  std::vector<std::string> domains;
  for (const EffectGuide& guide : effects_guide()) {
    if (std::find(domains.begin(), domains.end(), guide.domain) == domains.end()) {
      domains.push_back(guide.domain);
    }
  }
  for (const std::string& domain : domains) {
    std::string title = domain;
    title.front() = static_cast<char>(title.front() - 'a' + 'A');
    page += "\n## " + title + "\n\n| | effect | confused with | told apart by |\n| --- | --- | --- | --- |\n";
    for (const EffectGuide& guide : effects_guide()) {
      const auto law = catalogue.find(guide.name);
      if (guide.domain == domain && law != nullptr) {
        page += row(*law);
      }
    }
  }
  return page;
}

std::map<std::string, std::string> effects_pictures(const effects::Catalogue& catalogue) {
  std::map<std::string, std::string> files;
  for (const auto& law : catalogue.laws()) {
    const std::string picture = effect_picture(*law);
    if (!picture.empty()) {
      files[law->declaration().name + ".svg"] = picture;
    }
  }
  return files;
}

}  // namespace plumbline::api
