#include "simulator/effects/lost_counts.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kShare, kLimitSpeed, kWidth };

constexpr double kUsualWidth = 0.02;

}  // namespace

const Declaration& LostCounts::declaration() const {
  static const Declaration kDeclaration{
      "lost_counts",
      "an encoder that misses counts where it turns faster than it can count",
      "reading = actual + lost; lost_rate = -share*actual_rate*0.5*(1 + tanh((|actual_rate| - "
      "limit_speed)/(width*limit_speed)))",
      "de Silva, Sensors and Actuators, 2nd edition, 2015, chapter 11 (speed limit of incremental encoders); "
      "the share is ours",
      {Place::sensor},
      {Parameter{"share", "1", "how many of the counts above the limit are missed", 0.0, 0.0, 2.0,
                 Scale::linear, false},
       positive("limit_speed", "{position}/s", "speed up to which every count is seen", 1.0),
       fixed("width", "1", "range of speeds over which it begins, over the limit", kUsualWidth,
             kSmallestPositive, 1.0)},
      {"lost"},
      ""};
  return kDeclaration;
}

Values LostCounts::typical(const Scales& scales) const {
  return {1.0, guarded(scales).velocity, kUsualWidth};
}

std::vector<Values> LostCounts::starts(const Scales& scales) const {
  constexpr double kShare = 0.01;
  std::vector<Values> grid;
  for (const double speeds : {0.6, 1.0, 1.4, 1.8, 2.2}) {  // root mean squares: a sine has 1.41 at most
    grid.push_back({kShare, speeds * guarded(scales).velocity, kUsualWidth});
  }
  return grid;
}

bool LostCounts::is_null(const double* p) const { return p[kShare] == 0.0; }

double LostCounts::loss_rate(double actual_rate, const double* p) const {
  const double beyond = (std::abs(actual_rate) - p[kLimitSpeed]) / (p[kWidth] * p[kLimitSpeed]);
  return -p[kShare] * actual_rate * 0.5 * (1.0 + std::tanh(beyond));
}

}  // namespace plumbline::effects
