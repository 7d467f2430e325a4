// Angles of this folder.
#pragma once

namespace plumbline::spring_mass {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degree = pi / 180.0;

}  // namespace plumbline::spring_mass
