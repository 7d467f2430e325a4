#include <fmt/core.h>

#include <filesystem>
#include <system_error>

#include "simulator/effects/documentation.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/table.h"
#include "validation/api/effects_json.h"
#include "validation/api/effects_page.h"
#include "validation/cli/commands.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using effects::Declaration;
using effects::Parameter;

/// Infinity as people write it.
std::string number(double value) {
  const std::string text = number_text(value);
  return text == ".inf" ? "inf" : text == "-.inf" ? "-inf" : text;
}

std::string places_of(const Declaration& law) {
  std::string text;
  for (const effects::Place place : law.places) {
    text += (text.empty() ? "" : ", ") + effects::to_string(place);
  }
  return text;
}

void print_short(const Declaration& law) {
  fmt::print("{} (at: {})\n  {}\n  {}\n", law.name, places_of(law), law.summary, law.equation);
  for (const Parameter& parameter : law.parameters) {
    fmt::print("    {} [{}] {} to {}, {} {}\n", parameter.name, effects::unit_in_words(parameter.unit),
               number(parameter.lower), number(parameter.upper),
               parameter.structural ? "fixed, usually" : "null", number(parameter.null_value));
  }
  fmt::print("  source: {}\n\n", law.source);
}

void print_details(const Declaration& law) {
  fmt::print("{}: {}\n\nSits at:  {}\nEquation: {}\nSource:   {}\n", law.name, law.summary, places_of(law),
             law.equation, law.source);
  for (const std::string& state : law.states) {
    fmt::print("State:    {}\n", state);
  }
  if (!law.power_note.empty()) {
    fmt::print("Energy:   {}\n", law.power_note);
  }
  fmt::print("\n");
  std::vector<std::vector<std::string>> rows;
  for (const Parameter& parameter : law.parameters) {
    rows.push_back({parameter.name, effects::unit_in_words(parameter.unit), number(parameter.null_value),
                    number(parameter.lower), number(parameter.upper),
                    parameter.structural ? "never fitted" : "by its " + api::to_string(parameter.scale),
                    parameter.meaning});
  }
  print_table({"parameter", "unit", "null", "lower", "upper", "searched", "meaning"}, rows);
}

struct Options {
  std::string name, json, pictures;
  bool markdown = false, page = false;
};

void write_pictures(const effects::Catalogue& catalogue, const std::string& folder) {
  const std::filesystem::path into = folder;
  std::error_code failed;
  std::filesystem::create_directories(into, failed);
  if (failed) {
    throw InputError(folder + ": found no folder (" + failed.message() +
                     "), expected one that is there or can be made");
  }
  for (const auto& [file, picture] : api::effects_pictures(catalogue)) {
    write_text_atomically((into / file).string(), picture);
  }
}

void run(const Options& options) {
  const effects::Catalogue catalogue = api::named_effects(options.name);
  write_json(api::effects_json(catalogue), options.json);
  if (!options.pictures.empty()) {
    write_pictures(catalogue, options.pictures);
    return;
  }
  if (options.page) {
    fmt::print("{}", api::effects_page(catalogue));
    return;
  }
  if (options.markdown) {
    fmt::print("{}", effects::documentation_table(catalogue));
    return;
  }
  for (const auto& law : catalogue.laws()) {
    options.name.empty() ? print_short(law->declaration()) : print_details(law->declaration());
  }
}

}  // namespace

void add_effects(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("effects", "The catalogue of effects: place, parameters, equation, source");
  command->add_option("name", options->name, "the effect to describe in full; none: all of them")
      ->type_name("NAME");
  command->add_flag("--markdown", options->markdown, "print the table of the documentation");
  command->add_flag("--page", options->page,
                    "print docs/effects.md: all effects by domain, and how to tell them apart");
  command
      ->add_option("--pictures", options->pictures,
                   "write the page's pictures into FOLDER, one SVG for each effect")
      ->type_name("FOLDER");
  add_json_option(*command, options->json);
  command->footer("Example:\n  plumbline effects cable_stretch");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
