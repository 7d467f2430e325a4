// docs/effects.md and its pictures, made from the catalogue.
#pragma once

#include <map>
#include <string>

#include "simulator/effects/catalogue.h"

namespace plumbline::api {

/// Markdown: the catalogue by place and domain; of each law its picture, equation, parameters, source, what
/// it is confused with and which experiment tells. Pictures are looked for in images/effects beside the page.
std::string effects_page(const effects::Catalogue& catalogue);

/// SVG by file name ("viscous.svg"), of the laws that have one.
std::map<std::string, std::string> effects_pictures(const effects::Catalogue& catalogue);

}  // namespace plumbline::api
