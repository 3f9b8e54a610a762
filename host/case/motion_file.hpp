// Motions of walls from CSV files.
#pragma once

#include <string>

#include "fluid/motion.hpp"

namespace slagflow {

// Rows of a table into `time`, `displacement` and `angle` of a motion. The file has a line of column names
// with their units, as in "time_s, x_mm, angle_deg" or "Time [s]; Angle [deg]", or with the units in the
// line below: a time in s, ms or min, and any of x, y, z in m, mm or cm, and an angle in rad, deg or ° ; then
// a line for each time. Text as decode_text takes it. Commas, semicolons or tabs separate; commas in numbers
// are decimal, and what could be read in two ways is refused. Lines with # are comments, lines above the
// names are left out. Displacements and angles count from the first row. What is not in the file stays empty.
// Returns what is wrong, with the line, or "".
std::string read_motion_file(const std::string& path, WallMotion& motion);

}  // namespace slagflow
