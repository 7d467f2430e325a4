#include "tests/battery/worlds/outside.h"

#include <cmath>
#include <cstring>

namespace plumbline::battery::worlds {
namespace {

/// A number in [0, 1) for each sample (splitmix64's mixing), another row of them for another share.
double chance(double share, std::int64_t k) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &share, sizeof bits);
  std::uint64_t z = bits + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(k + 1);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1.0p-53;
}

}  // namespace

// At distance r from the pivot, angle x from hanging: height -r cos x, to the side r sin x. In grease so
// thick that its inertia along the link does not count, r' = mobility (what pulls it outwards)/m. About the
// pivot
//   d/dt (m r^2 x') = torque of the link on it - m r (up sin x + side cos x).
Carried carried(const Hidden& load, const PlaceMotion& m, double moved, double up, double side) {
  const double mass = load["mass"];
  const double r = load["from"] + moved;
  Carried c;
  c.creeping = load["mobility"] * (up * std::cos(m.x) - side * std::sin(m.x) + r * m.v * m.v);
  c.inertia = mass * r * r;
  c.force = -mass * r * (up * std::sin(m.x) + side * std::cos(m.x)) - 2.0 * mass * r * c.creeping * m.v;
  return c;
}

double turned_round(const Hidden& amplifier, double asked, double sense, double& sense_rate) {
  const double to = asked == 0.0 ? sense : std::copysign(1.0, asked);
  sense_rate = (to - sense) / amplifier["time"];
  return std::abs(asked) * sense;
}

double weakened(const Hidden& motor, double asked, double x) {
  const double away = (x - motor["centre"]) / motor["reach"];
  return asked * (1.0 - motor["loss"] * away * away);
}

int held_for(double share, std::int64_t k) {
  if (k >= 2 && chance(share, k - 1) < share) return 2;
  return k >= 1 && chance(share, k) < share ? 1 : 0;
}

double bit_error(double error, double step, double actual) {
  if (error == 0.0) return 0.0;
  return std::fmod(std::floor(actual / step), 2.0) != 0.0 ? error : 0.0;
}

}  // namespace plumbline::battery::worlds
