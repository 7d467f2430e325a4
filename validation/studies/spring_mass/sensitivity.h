// How a law that was made for one spring-mass model does on another: the rows and columns of Wu 2017,
// table 3.1.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "validation/studies/spring_mass/trail.h"

namespace plumbline::spring_mass {

/// One row: what is wrong, under the names of the published table.
struct SensitivityRow {
  std::string parameter;  ///< "none", "E", "k", "alpha", "beta", "t"; "E of ground": see sensitivity_rows()
  std::string value;      ///< "-10%", "+1deg", "15 ms"
  Disturbance disturbance;
  bool with_classical = true;  ///< the classical law has no time that a delay could act on
};

/// The 17 rows of the table, then its four of the energy once more, as what standing 22 or 11 cm higher or
/// lower leaves or adds: 9.67 and 4.84 %. The printed numbers of 5 % are those of 11 cm.
std::vector<SensitivityRow> sensitivity_rows(const Body& body);

/// Five numbers for each law: steady apex error, then over the trails root mean square and largest error of
/// apex and deflection. In cm and degrees, as the table has them.
enum class Measure { steady_apex, rms_apex, worst_apex, rms_deflection, worst_deflection };
inline constexpr int measures = 5;
inline constexpr int laws = 3;

/// A cell over several random trails: the thesis ran one, and did not say where its way-points were.
struct Cell {
  double mean = 0.0, least = 0.0, most = 0.0;
  int fallen = 0;  ///< trails that did not go on to their end
};

struct SensitivityResult {
  SensitivityRow row;
  std::array<std::array<Cell, measures>, laws> cells;  ///< by law, then by measure
};

/// Runs `trails` trails of `steps` steps over flat ground for each row and law, on all cores. The way-points
/// are the same in all rows. `progress` hears the share that is done.
std::vector<SensitivityResult> sensitivity(const DeadbeatLaw& law, int trails, int steps,
                                           const std::function<void(double)>& progress = nullptr);

/// The published table: parameter, value, then 15 numbers, a missing one not a number.
struct PublishedRow {
  std::string parameter, value;
  std::array<std::array<double, measures>, laws> cells;
};
/// Reads robots/atrias/wu_table_3_1.csv. Throws InputError.
std::vector<PublishedRow> read_published_table(const std::string& file);

/// What a cell says of the published number: "" no number, "=" within half a unit of the print, "~" between
/// the least and the most of the trails (half a unit added), "x" neither.
std::string verdict(const Cell& cell, double published);

}  // namespace plumbline::spring_mass
