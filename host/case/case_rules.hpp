// What the tables of a case share, and what holds across them.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/case/case_table.hpp"

namespace slagflow {

extern const std::vector<std::string> axis_names, direction_names;  // x y z; -x +x -y +y -z +z
extern const std::vector<std::string> face_names;                   // in the order of InletFace
Direction direction_of(int index);                                  // into direction_names
int index_of(const Direction& direction);

// Of a run, to its end time.
constexpr double most_snapshots = 1e6, most_history_lines = 1e8;

// How far the intervals of the outputs allow a run to go, or its checkpoints could not be read again [s].
inline double longest_run(const OutputSpec& output) {
  return smaller(output.interval * most_snapshots, output.history_interval * most_history_lines);
}

// Letters, digits, _ - . with a letter, digit or _ at the start: safe as a file name and a key.
bool is_plain_name(const std::string& name);

// What concerns several tables: periodic extents, measures against the domain, two dimensions.
void check_across_tables(const Case& c, CaseProblems& problems);

// Fluids more viscous at rest than single precision computes with.
void check_fluids(const Case& c, CaseProblems& problems);

}  // namespace slagflow
