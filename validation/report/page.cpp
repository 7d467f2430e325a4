#include "validation/report/page.h"

#include <map>

#include "validation/report/report.h"

namespace plumbline::validation {
namespace {

/// Each {{mark}} replaced by its text; what the texts hold is not looked at again.
std::string filled(const std::string& page, const std::map<std::string, std::string>& texts) {
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = page.find("{{"); at != std::string::npos; at = page.find("{{", done)) {
    const std::size_t end = page.find("}}", at);
    out.append(page, done, at - done);
    out += texts.at(page.substr(at + 2, end - at - 2));
    done = end + 2;
  }
  return out.append(page, done);
}

}  // namespace

std::string html_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

// A script's text ends at "</script", and "<!--" changes how it is read: no "<" at all is the simple way out.
// Bytes that are no UTF-8 (in a name) become U+FFFD.
std::string script_text(const nlohmann::json& json) {
  std::string safe;
  for (const char c : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string report_page(const nlohmann::json& report) {
  const PageFiles files = page_files();
  return filled(files.html, {{"title", html_text(report.at("robot").get<std::string>())},
                             {"library licence", files.library_licence},
                             {"style", std::string(files.library_style) + files.style},
                             {"library", files.library},
                             {"script", files.script},
                             {"data", script_text(report)}});
}

}  // namespace plumbline::validation
