// Finds the tables of readings in a file: the line of names, the row of units, the rows, and what stands
// above, between and below.
#pragma once

#include <string>
#include <vector>

#include "host/rheometry/rheometry_units.hpp"
#include "host/text/table_text.hpp"

namespace slagflow {

struct Column {
  std::string name;
  NamedQuantity meaning;
};

// One table. The indices of columns are -1 where none has the quantity.
struct Block {
  int line = 0;        // of the names
  int units_line = 0;  // of the row of units; 0: the names have them
  std::vector<Column> columns;
  std::vector<Record> rows;
  int column_of(Quantity q) const;
  std::vector<int> columns_of(Quantity q) const;
  bool has_flow_pair() const;  // of a flow curve
  bool has_pair() const;       // that, or viscosity over temperature
};

struct Problem {
  int line;
  std::string what;
};

struct Tables {
  Separator separator = Separator::comma;
  std::vector<Block> blocks;      // each with a pair of quantities and a row
  std::vector<Record> others;     // lines of facts and prose, and comments as one field
  std::vector<Problem> problems;  // rows that cannot be understood
};

// With the separator that gives tables. Where none does, the problem tells of the line that is nearest.
Tables find_tables(const std::string& text);

// For messages: which pairs there are, and how a name and its unit are written.
std::string allowed_columns();

}  // namespace slagflow
