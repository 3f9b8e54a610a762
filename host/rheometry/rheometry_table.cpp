#include "host/rheometry/rheometry_table.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "host/text/number_text.hpp"

namespace slagflow {
namespace {

bool is_number_like(const std::string& text) {
  return form_of(split_number(text).number) != NumberForm::no_number;
}

bool is_number(const std::string& text) { return form_of(text) != NumberForm::no_number; }

bool is_comment(const Record& record) {
  const std::string& first = record.fields.front();
  return first[0] == '#' || first.compare(0, 2, "//") == 0;
}

// Of signs alone, as the line below the names in Markdown.
bool is_rule(const Record& record) {
  return std::all_of(record.fields.begin(), record.fields.end(), [](const std::string& field) {
    return field.find_first_not_of("-=:_*") == std::string::npos;
  });
}

std::size_t measured_count(const Block& block) {
  return static_cast<std::size_t>(std::count_if(block.columns.begin(), block.columns.end(),
                                                [](const Column& c) { return c.meaning.known; }));
}

Block named_columns(const std::vector<std::string>& names, int line) {
  Block block;
  block.line = line;
  for (const std::string& name : names) {
    Column column{name, parse_name(name)};
    if (column.meaning.known && !is_measured(column.meaning.quantity)) column.meaning.known = false;
    block.columns.push_back(std::move(column));
  }
  return block;
}

// `Shear rate, 1/s, Shear stress, Pa` in a file that commas separate: names and units in turn.
std::vector<std::string> with_units_joined(const std::vector<std::string>& fields) {
  std::vector<std::string> joined;
  for (const std::string& field : fields) {
    const bool joins = !joined.empty() && !joined.back().empty() && joined.back().back() != ']' &&
                       is_unit(field) && !is_number(field);
    if (joins)
      joined.back() += " [" + field + "]";
    else
      joined.push_back(field);
  }
  return joined;
}

// A row below the names that has the units of measured columns.
bool is_units_row(const Record& record, const Block& block) {
  bool any = false;
  for (const std::string& field : record.fields) {
    if (field.empty()) continue;
    if (is_number(field)) return false;
    any = any || is_unit(field) || field[0] == '[';
  }
  return any && record.fields.size() <= block.columns.size() + 1;
}

// The quantities that a name has already keep their unit; it must be the same.
void take_units(Block& block, const Record& row, std::vector<Problem>& problems) {
  block.units_line = row.line;
  for (std::size_t k = 0; k < std::min(row.fields.size(), block.columns.size()); ++k) {
    Column& column = block.columns[k];
    if (row.fields[k].empty() || !column.meaning.known) continue;
    const NamedQuantity here = with_unit(column.meaning, row.fields[k]);
    if (column.meaning.unit_known && here.unit_known && here.unit != column.meaning.unit)
      problems.push_back({row.line, "column '" + column.name + "': the row of units has " +
                                        quoted(row.fields[k]) + ": allowed: the unit of the name, " +
                                        column.meaning.unit});
    if (!column.meaning.unit_known) column.meaning = here;
  }
}

// Splits records into tables and the rest.
class Scanner {
 public:
  explicit Scanner(std::vector<Record> records) : records_(std::move(records)) {}

  Tables scan() {
    for (at_ = 0; at_ < records_.size(); ++at_) {
      const Record& record = records_[at_];
      if (record.filled() == 0 || (is_rule(record) && !among_rows(record))) {
        gap_ = true;
      } else if (std::optional<Block> block = is_comment(record) ? std::nullopt : header_here()) {
        tables_.blocks.push_back(std::move(*block));
        ended_ = 0, gap_ = false;
      } else if (is_comment(record) || tables_.blocks.empty()) {
        take_other(record);
      } else {
        take_row(record);
      }
    }
    return std::move(tables_);
  }

 private:
  // Signs in place of numbers between rows of them are the instrument's.
  bool among_rows(const Record& record) const {
    if (record.filled() < 2 || tables_.blocks.empty() || tables_.blocks.back().rows.empty()) return false;
    const std::size_t next = next_filled(at_ + 1);
    return next < records_.size() && all_numbers(records_[next], tables_.blocks.back());
  }

  void take_other(const Record& record) {
    tables_.others.push_back(record);
    if (!tables_.blocks.empty() && !is_comment(record) && ended_ == 0) ended_ = record.line;
  }

  // The next record from `k` on that is neither empty nor a comment.
  std::size_t next_filled(std::size_t k) const {
    while (k < records_.size() &&
           (records_[k].filled() == 0 || is_rule(records_[k]) || is_comment(records_[k])))
      ++k;
    return k;
  }

  // A table's head at this place, with which at_ goes to its last line.
  std::optional<Block> header_here() {
    const Record& names = records_[at_];
    std::vector<Problem> problems;
    Block block = named_columns(names.fields, names.line);
    if (measured_count(block) < 2) return {};
    std::size_t last = at_, next = next_filled(at_ + 1);
    for (int tries = 0; tries < 2 && next < records_.size(); ++tries) {  // symbols may stand before units
      if (is_units_row(records_[next], block)) {
        take_units(block, records_[next], problems);
        last = next, next = next_filled(next + 1);
        break;
      }
      const std::size_t after = next_filled(next + 1);
      if (has_numbers(records_[next], block) || after >= records_.size() ||
          !is_units_row(records_[after], block))
        break;
      next = after;
    }
    if (next >= records_.size()) return {};
    join_units(block, names, records_[next]);
    for (Column& column : block.columns)
      if (column.meaning.weak && !column.meaning.unit_known) column.meaning.known = false;
    if (!block.has_pair() || !has_numbers(records_[next], block)) return {};
    tables_.problems.insert(tables_.problems.end(), problems.begin(), problems.end());
    at_ = last;
    return block;
  }

  static void join_units(Block& block, const Record& names, const Record& row) {
    const std::vector<std::string> joined = with_units_joined(names.fields);
    if (joined.size() < names.fields.size() && row.width() <= joined.size())
      block = named_columns(joined, block.line);
  }

  static bool has_numbers(const Record& row, const Block& block) {
    for (std::size_t k = 0; k < std::min(row.fields.size(), block.columns.size()); ++k)
      if (block.columns[k].meaning.known && is_number_like(row.fields[k])) return true;
    return false;
  }

  // Text in the first column, such as `Mean`, where the rows above have none or a number.
  bool is_labelled(const Record& row, const Block& block) const {
    if (block.rows.empty() || block.columns[0].meaning.known || row.fields[0].empty()) return false;
    const std::string& above = block.rows.back().fields[0];
    return (above.empty() || is_number(above)) && !is_number_like(row.fields[0]);
  }

  bool is_prose(const Record& record, const Block& block) const {
    const std::size_t columns = block.columns.size();
    const bool all = all_numbers(record, block);
    if (is_labelled(record, block)) return gap_ || !all;
    if (!has_numbers(record, block))
      return gap_ || ended_ != 0 || record.width() > columns + 1 ||
             record.filled() < std::max(std::min<std::size_t>(columns, 2), (columns + 1) / 2);
    if (all) return false;
    const std::size_t first =
        static_cast<std::size_t>(std::find_if(record.fields.begin(), record.fields.end(),
                                              [](const std::string& f) { return !f.empty(); }) -
                                 record.fields.begin());
    return (gap_ || ended_ != 0) && !is_number_like(record.fields[first]);
  }

  void take_row(const Record& record) {
    Block& block = tables_.blocks.back();
    if (is_prose(record, block)) {
      take_other(record);
    } else if (ended_ != 0) {
      tables_.problems.push_back(
          {record.line, "numbers below line " + std::to_string(ended_) + ", which ends the table of line " +
                            std::to_string(block.line) +
                            ": allowed: rows that follow each other, or another line of names"});
    } else if (is_labelled(record, block)) {
      tables_.problems.push_back(
          {record.line, "column '" + block.columns[0].name + "': value " + quoted(record.fields[0]) +
                            " where the other rows have numbers: allowed: readings, no "
                            "means or sums; or # in front of the line"});
    } else {
      add_row(record, block);
    }
  }

  void add_row(const Record& record, Block& block) {
    const std::size_t columns = block.columns.size();
    if (record.width() > columns) {
      const char* const hint =
          record.width() == 2 * columns ? "; a decimal comma? Then separate by semicolons" : "";
      tables_.problems.push_back({record.line, std::to_string(record.width()) +
                                                   " fields: allowed: " + std::to_string(columns) +
                                                   ", as in line " + std::to_string(block.line) + hint});
      return;
    }
    block.rows.push_back(record);
    block.rows.back().fields.resize(columns);
    gap_ = false;
  }

  static bool all_numbers(const Record& row, const Block& block) {
    for (std::size_t k = 0; k < block.columns.size(); ++k)
      if (block.columns[k].meaning.known && (k >= row.fields.size() || !is_number_like(row.fields[k])))
        return false;
    return true;
  }

  std::vector<Record> records_;
  Tables tables_;
  std::size_t at_ = 0;
  int ended_ = 0;     // line of the prose that ended the table
  bool gap_ = false;  // an empty line stands before this one
};

// A line of names that is commented out, as some programs write it, without its mark.
std::vector<Record> with_commented_names(std::vector<Record> records) {
  for (Record& record : records) {
    std::string& first = record.fields[0];
    if (record.filled() == 0 || !is_comment(record)) continue;
    const std::string bare = trimmed(first.substr(std::min(first.find_first_not_of("#/ "), first.size())));
    std::vector<std::string> names = record.fields;
    names[0] = bare;
    if (names[0].empty()) names.erase(names.begin());
    if (named_columns(names, record.line).has_pair()) record.fields = names;
  }
  return records;
}

std::string lack_of(const Block& block) {
  for (const Column& column : block.columns)
    if (column.meaning.known && !column.meaning.unit_known)
      return "column '" + column.name +
             "' has no unit that is known: allowed: " + names_of(column.meaning.quantity);
  return "no row of numbers follows the names of the columns: allowed: a line of numbers for each reading";
}

// Where no table is found: the line that comes nearest to names.
Problem nearest(const std::string& text) {
  Problem best{0, "no line names the columns: allowed: " + allowed_columns()};
  std::size_t most = 0;
  for (const Separator separator :
       {Separator::tab, Separator::semicolon, Separator::comma, Separator::blanks})
    for (const Record& record : split_records(text, separator).records) {
      const Block block = named_columns(record.fields, record.line);
      if (record.filled() == 0 || is_comment(record) || measured_count(block) <= most) continue;
      most = measured_count(block);
      best = {record.line, block.has_pair() ? lack_of(block)
                                            : "the columns are not a pair: allowed: " + allowed_columns()};
    }
  for (const Record& record : split_records(text, Separator::comma).records)
    if (most == 0 && best.line == 0 && record.filled() > 0 && !is_comment(record))
      best = {record.line, "no line names the columns; this one begins with " + quoted(record.fields[0]) +
                               ": allowed: " + allowed_columns()};
  return best;
}

// Above a flow curve a temperature and a viscosity are facts of the sample.
void drop_facts(std::vector<Block>& blocks) {
  const auto flows = [](const Block& block) { return block.has_flow_pair(); };
  if (std::any_of(blocks.begin(), blocks.end(), flows))
    blocks.erase(std::remove_if(blocks.begin(), blocks.end(), std::not_fn(flows)), blocks.end());
}

std::optional<Tables> tables_of(const std::string& text, Separator separator) {
  Records split = split_records(text, separator);
  Tables tables = Scanner(split.records).scan();
  if (tables.blocks.empty()) tables = Scanner(with_commented_names(std::move(split.records))).scan();
  if (tables.blocks.empty()) return {};
  drop_facts(tables.blocks);
  tables.separator = separator;
  if (split.open_quote != 0)
    tables.problems.push_back({split.open_quote, "a quote that is not closed: allowed: \" in pairs"});
  return tables;
}

}  // namespace

std::vector<int> Block::columns_of(Quantity q) const {
  std::vector<int> found;
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].meaning.known && columns[k].meaning.quantity == q) found.push_back(static_cast<int>(k));
  return found;
}

int Block::column_of(Quantity q) const {
  const std::vector<int> found = columns_of(q);
  for (const int k : found)
    if (columns[static_cast<std::size_t>(k)].meaning.unit_known) return k;
  return found.empty() ? -1 : found.front();
}

bool Block::has_flow_pair() const {
  const auto has = [this](Quantity q) { return column_of(q) >= 0; };
  const int flow = has(Quantity::shear_rate) + has(Quantity::shear_stress) + has(Quantity::viscosity);
  return flow >= 2 || (has(Quantity::rotation) && (has(Quantity::torque) || has(Quantity::viscosity)));
}

bool Block::has_pair() const {
  return has_flow_pair() || (column_of(Quantity::temperature) >= 0 && column_of(Quantity::viscosity) >= 0);
}

std::string allowed_columns() {
  return "names with units, as `shear_rate_1/s,shear_stress_Pa` or `Shear Rate [1/s];Viscosity [mPa s]`: two "
         "of shear rate, shear stress and viscosity; or rotation and torque; or temperature and viscosity";
}

Tables find_tables(const std::string& text) {
  for (const std::string& form : {text, unwrap_lines(text)})
    for (const Separator separator : {Separator::tab, Separator::semicolon, Separator::comma, Separator::bar,
                                      Separator::blanks, Separator::blank})
      if (std::optional<Tables> tables = tables_of(form, separator)) return std::move(*tables);
  Tables none;
  none.problems.push_back(nearest(text));
  return none;
}

}  // namespace slagflow
