// The tables of a case file, one function each. Used by the parser alone.
#pragma once

#include <algorithm>
#include <string>

#include "host/case/case.hpp"
#include "host/case/case_table.hpp"

namespace slagflow {

// What the keys of the file may say; shared with the writer.
extern const std::vector<std::string> kernel_names, slip_names, pressure_names, departure_names, solver_names,
    loop_names, operator_names, stepping_names, explicit_names, yield_names, measure_names, direction_names,
    axis_names, motion_names, interpolation_names;
Direction direction_of(int index);  // into direction_names
int index_of(const Direction& direction);

// Of a run, to its end time.
constexpr double most_snapshots = 1e6, most_history_lines = 1e8;

// How far the intervals of the outputs allow a run to go, or its checkpoints could not be read again [s].
inline double longest_run(const OutputSpec& output) {
  return smaller(output.interval * most_snapshots, output.history_interval * most_history_lines);
}

// Letters, digits, _ - . with a letter, digit or _ at the start: safe as a file name and a key.
bool is_plain_name(const std::string& name);

// What is common to entries that have a name: reports one that is not plain, one that an earlier entry has,
// and more entries than there are numbers for.
void check_name(CaseTable& t, const std::string& name);
void check_count(CaseTable& top, const char* key, std::size_t count);
template <class T>
void check_unique(CaseTable& t, const std::vector<T>& earlier, const std::string& name) {
  const auto same = [&](const T& other) { return other.name == name; };
  if (!name.empty() && std::any_of(earlier.begin(), earlier.end(), same))
    t.problem("name", "value \"" + name + "\" is given twice: allowed: a name of its own");
}

void read_frame(CaseTable& top, Case& c);     // [case] [resolution] [gravity] [body_force] [domain]
void read_fluids(CaseTable& top, Case& c);    // [fluid.NAME]
void read_regions(CaseTable& top, Case& c);   // [[region]]
void read_walls(CaseTable& top, Case& c);     // [[wall]], in case_walls.cpp
void read_numerics(CaseTable& top, Case& c);  // [numerics]
void read_limits(CaseTable& top, Case& c);    // [limits]
void read_output(CaseTable& top, Case& c);    // [output]
void read_measures(CaseTable& top, Case& c);  // [[measure]]

// [limits] for the writer.
std::string limits_text(const LimitSetup& limits);

// A list of shapes; STL files are looked for next to the case file.
bool read_shapes(CaseTable& parent, const char* key, Need need, const std::string& case_file,
                 std::vector<ShapeSpec>& shapes);

// What concerns several tables: periodic extents, measures against the domain, two dimensions.
void check_across_tables(const Case& c, CaseProblems& problems);

}  // namespace slagflow
