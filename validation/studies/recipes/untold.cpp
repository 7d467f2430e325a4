#include "validation/studies/recipes/untold.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::validation {
namespace {

constexpr double kWide = 0.5;

StrongCorrelation strongest(const StepResult& result, const std::string& unknown) {
  // They come strongest first.
  const auto found = std::find_if(
      result.correlations.begin(), result.correlations.end(),
      [&](const StrongCorrelation& pair) { return pair.one == unknown || pair.other == unknown; });
  return found == result.correlations.end() ? StrongCorrelation{} : *found;
}

}  // namespace

std::vector<Untold> untold(const Recipe& recipe, const StepResult& result) {
  std::vector<Untold> all;
  for (const IdentifiedValue& finding : result.findings) {
    const Unknown& unknown = recipe.unknown(finding.unknown);
    const double size = std::max({std::abs(finding.value), std::abs(unknown.value), unknown.deviation});
    const double width =
        finding.seen ? (finding.upper - finding.lower) / size : std::numeric_limits<double>::infinity();
    if (!unknown.target && !(width <= kWide)) {
      all.push_back({finding.unknown, width, strongest(result, finding.unknown)});
    }
  }
  return all;
}

}  // namespace plumbline::validation
