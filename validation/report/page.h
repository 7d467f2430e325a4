// The files of the page, embedded when the program is built, and text that is safe inside them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace plumbline::validation {

/// Made from page/ and the drawing library by embed.cmake.
struct PageFiles {
  const char* html;
  const char* style;
  const char* script;
  const char* library;  ///< uPlot
  const char* library_style;
  const char* library_licence;
};
PageFiles page_files();

/// Text as it may stand between tags and in attributes.
std::string html_text(const std::string& text);

/// JSON as it may stand inside <script>: without any "<".
std::string script_text(const nlohmann::json& json);

}  // namespace plumbline::validation
