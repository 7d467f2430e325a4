#include "simulator/effects/boom.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kCurvature, kLevel };

constexpr double kTightest = 2.0;  // 1/m: a boom of half a metre

}  // namespace

const Declaration& Boom::declaration() const {
  static const Declaration kDeclaration{
      "boom",
      "a boom that carries the robot round a tower",
      "the base's x and z are arcs of radius 1/|curvature|: it yaws by curvature*x and rolls by "
      "-curvature*(z - level)",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE "
      "Control Systems Magazine 31(2), 2011, Figure 2 and Table VI (2.25 m); geometry",
      {Place::base},
      {Parameter{"curvature", "1/m", "one over the boom's length; above 0: the tower stands to the left", 0.0,
                 -kTightest, kTightest, Scale::linear, false},
       any("level", "m", "height of the base at which the boom is level")},
      {},
      ""};
  return kDeclaration;
}

// A boom of ten metres is hardly felt, one of one metre by everything.
Values Boom::typical(const Scales& scales) const { return {0.3, guarded(scales).position}; }

std::vector<Values> Boom::starts(const Scales& scales) const {
  return starts_at_rests(null_values(), kLevel, scales, {-3.0, 0.0, 3.0});
}

bool Boom::is_null(const double* p) const { return p[kCurvature] == 0.0; }

StructureChange Boom::change(const double* p) const {
  StructureChange result;
  result.curvature = p[kCurvature];
  result.level = p[kLevel];
  return result;
}

}  // namespace plumbline::effects
