#include "host/rheometry/rheometry_phase_table.hpp"

#include <algorithm>
#include <cmath>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_facts.hpp"
#include "host/rheometry/rheometry_phase_names.hpp"

namespace slagflow {
namespace {

constexpr std::size_t most_problems = 20;
constexpr double most_fraction = 1.5;  // above it fractions are per cent

const char* const allowed =
    "a line of names with a temperature and its unit, as `T(C)` or `temperature_K`, and a fraction, as "
    "`solid "
    "fraction [%]`, or amounts of phases, as `g_ASlag-liq#1` or `Mass fraction of LIQUID`";

// The columns that a record of names gives; none: it is no such record.
std::vector<PhaseColumn> columns_of(const Record& names, const Record& units, bool bare) {
  std::vector<PhaseColumn> columns;
  bool temperature = false, phases = false;
  for (std::size_t k = 0; k < names.fields.size(); ++k) {
    PhaseColumn column = parse_phase_column(names.fields[k]);
    const std::string unit = k < units.fields.size() ? units.fields[k] : "";
    if (!unit.empty() && form_of(unit) == NumberForm::no_number)
      column = parse_phase_column(names.fields[k] + " [" + replaced(unit, {{"[", ""}, {"]", ""}}) + "]");
    if (column.bare && !bare) column.role = PhaseRole::none;
    temperature = temperature || (column.role == PhaseRole::temperature && column.unit_known);
    phases = phases || column.is_fraction() || column.role == PhaseRole::liquid;
    columns.push_back(column);
  }
  return temperature && phases ? columns : std::vector<PhaseColumn>{};
}

struct Layout {
  Separator separator = Separator::comma;
  std::vector<Record> records;
  std::size_t names = 0, first_row = 0;
  std::vector<PhaseColumn> columns;
};

bool is_number_at(const Record& record, const std::vector<PhaseColumn>& columns) {
  for (std::size_t k = 0; k < std::min(columns.size(), record.fields.size()); ++k)
    if (columns[k].role == PhaseRole::temperature) return form_of(record.fields[k]) != NumberForm::no_number;
  return false;
}

bool has_number(const Record& record) {
  return std::any_of(record.fields.begin(), record.fields.end(),
                     [](const std::string& field) { return form_of(field) != NumberForm::no_number; });
}

std::optional<Layout> layout_of(const std::string& text, Separator separator, bool bare) {
  Layout layout{separator, split_records(text, separator).records, 0, 0, {}};
  const std::vector<Record>& records = layout.records;
  for (std::size_t k = 0; k + 1 < records.size(); ++k) {
    if (records[k].filled() < 2) continue;
    for (std::size_t row = k + 1; row < std::min(k + 3, records.size()); ++row) {
      const bool between = row > k + 1 && !has_number(records[k + 1]);  // a row of units
      const Record& units = between ? records[k + 1] : Record{};
      layout.columns = columns_of(records[k], units, bare);
      if (layout.columns.empty() || !is_number_at(records[row], layout.columns)) continue;
      layout.names = k, layout.first_row = between ? row : k + 1;
      return layout;
    }
  }
  return {};
}

Layout find_layout(const std::string& text, const std::string& file) {
  for (const bool bare : {false, true})
    for (const Separator separator : {Separator::tab, Separator::semicolon, Separator::comma, Separator::bar,
                                      Separator::blanks, Separator::blank})
      if (std::optional<Layout> found = layout_of(text, separator, bare)) return std::move(*found);
  throw InputError(file + ": no line names the columns of a table of phases: allowed: " + allowed);
}

class PhaseReader {
 public:
  PhaseReader(std::string file, const SampleFacts& options, std::optional<double> mass)
      : file_(std::move(file)), mass_(mass) {
    table_.facts = options;
  }

  PhaseTable read(const std::string& bytes) {
    const DecodedText decoded = decode_text(bytes, file_);
    layout_ = find_layout(decoded.text, file_);
    take_facts();
    choose_columns();
    raise();
    decide_sign();
    for (std::size_t k = layout_.first_row; k < layout_.records.size(); ++k) take_row(layout_.records[k]);
    raise();
    finish_solids();
    finish_heat();
    raise();
    sort();
    table_.how = how(decoded.encoding);
    return std::move(table_);
  }

 private:
  struct Raw {
    int line;
    double solid, liquid, gas, fraction;
  };

  void problem(int line, const std::string& what) { problems_.push_back({line, what}); }
  void warn(const std::string& what) { table_.warnings.push_back(file_ + ": " + what); }
  void raise() const {
    if (problems_.empty()) return;
    std::string all;
    for (std::size_t k = 0; k < std::min(problems_.size(), most_problems); ++k)
      all += (k > 0 ? "\n" : "") + file_ + ":" + std::to_string(problems_[k].line) + ": " + problems_[k].what;
    throw InputError(all);
  }
  int names_line() const { return layout_.records[layout_.names].line; }
  const PhaseColumn* column(int k) const {
    return k < 0 ? nullptr : &layout_.columns[static_cast<std::size_t>(k)];
  }

  void take_facts() {
    std::vector<Record> above(layout_.records.begin(),
                              layout_.records.begin() + static_cast<std::ptrdiff_t>(layout_.names));
    above.erase(std::remove_if(above.begin(), above.end(), [](const Record& r) { return r.filled() == 0; }),
                above.end());
    const FileFacts facts = read_facts(above, problems_);
    decimal_ = facts.decimal;
    if (!table_.facts.density) table_.facts.density = facts.sample.density;
    if (!table_.facts.name) table_.facts.name = facts.sample.name;
  }

  // The first column of a kind; a solid fraction goes before a liquid one, and both before amounts.
  void choose_columns() {
    int solid = -1, liquid = -1;
    bool solids = false;
    for (int k = 0; k < static_cast<int>(layout_.columns.size()); ++k) {
      const PhaseColumn& c = *column(k);
      const auto first = [&](PhaseRole role, int& place) {
        if (c.role == role && place < 0 && c.unit_known) place = k;
      };
      first(PhaseRole::temperature, temperature_);
      first(PhaseRole::enthalpy, enthalpy_);
      first(PhaseRole::heat_capacity, capacity_);
      first(PhaseRole::solid_fraction, solid);
      first(PhaseRole::liquid_fraction, liquid);
      if (c.is_amount()) amounts_.push_back(k), solids = solids || c.role == PhaseRole::solid;
      if ((c.role == PhaseRole::enthalpy || c.role == PhaseRole::heat_capacity) && !c.unit_known)
        problem(names_line(), "column '" + c.name +
                                  "' has no unit that is known: allowed: J, kJ, J/kg, kJ/kg, "
                                  "J/g, of a heat capacity over K");
    }
    fraction_ = solid >= 0 ? solid : liquid;
    if (fraction_ < 0 && !solids)
      fraction_ = *std::find_if(amounts_.begin(), amounts_.end(),
                                [&](int k) { return column(k)->role == PhaseRole::liquid; });
    if (fraction_ >= 0) return;
    for (const int k : amounts_)
      if (column(k)->unit != column(amounts_[0])->unit)
        problem(names_line(), "columns '" + column(amounts_[0])->name + "' in " + column(amounts_[0])->unit +
                                  " and '" + column(k)->name + "' in " + column(k)->unit +
                                  ": allowed: one unit for the amounts of all phases");
  }

  std::vector<int> used() const {
    std::vector<int> all{temperature_};
    if (fraction_ >= 0) all.push_back(fraction_);
    if (fraction_ < 0 || weighs()) all.insert(all.end(), amounts_.begin(), amounts_.end());
    for (const int k : {enthalpy_, capacity_})
      if (k >= 0) all.push_back(k);
    return all;
  }
  bool weighs() const {
    return !amounts_.empty() && (column(amounts_[0])->unit == "g" || column(amounts_[0])->unit == "kg");
  }

  void decide_sign() {
    bool point = false, comma = false;
    int unclear = 0;
    for (std::size_t r = layout_.first_row; r < layout_.records.size(); ++r)
      for (const int k : used()) {
        const Record& record = layout_.records[r];
        if (static_cast<std::size_t>(k) >= record.fields.size()) continue;
        const NumberForm form = form_of(record.fields[static_cast<std::size_t>(k)]);
        point = point || form == NumberForm::with_point;
        comma = comma || form == NumberForm::with_comma;
        if (form == NumberForm::unclear_comma && unclear == 0) unclear = record.line;
      }
    sign_ = decimal_.value_or(comma ? DecimalSign::comma : DecimalSign::point);
    if (!decimal_ && point && comma)
      problem(names_line(), "numbers with decimal points and decimal commas: allowed: one of them in a file");
    if (!decimal_ && unclear != 0 && !point && !comma)
      problem(unclear,
              "all numbers may have decimal commas or ones between thousands: allowed: a line `# "
              "decimal = comma` or `# decimal = point`");
  }

  // Nothing, or 0 of a phase, where the field says that there is none.
  std::optional<double> number(const Record& record, int k) {
    const std::string text =
        static_cast<std::size_t>(k) < record.fields.size() ? record.fields[static_cast<std::size_t>(k)] : "";
    const PhaseColumn& c = *column(k);
    if (text.empty() || stands_for_no_number(text))
      return c.is_amount() ? std::optional<double>(0) : std::nullopt;
    const std::optional<double> value = number_of(text, sign_);
    if (!value) problem(record.line, "column '" + c.name + "': value " + quoted(text) + " is not a number");
    return value;
  }

  // Text between the rows, but not a row whose temperature is none.
  void leave_out(const Record& record) {
    const std::string text = static_cast<std::size_t>(temperature_) < record.fields.size()
                                 ? record.fields[static_cast<std::size_t>(temperature_)]
                                 : "";
    const bool is_row = has_number(record) && 2 * record.filled() >= layout_.columns.size();
    if (is_row && !text.empty() && !stands_for_no_number(text))
      problem(record.line,
              "column '" + column(temperature_)->name + "': value " + quoted(text) + " is not a number");
    ++left_out_;
  }

  void take_row(const Record& record) {
    if (record.filled() < 2) return;
    if (!is_number_at(record, layout_.columns)) return leave_out(record);
    const PhaseColumn& t = *column(temperature_);
    const double kelvin = t.factor * number(record, temperature_).value_or(0) + t.offset;
    const QuantityInfo& believable = info(Quantity::temperature);
    if (!(kelvin > believable.least && kelvin <= believable.most))
      problem(record.line, "column '" + t.name + "': " + text_of(kelvin) + " K: allowed: > " +
                               text_of(believable.least) + " to " + text_of(believable.most) +
                               " K; is the unit right?");
    Raw raw{record.line, 0, 0, 0, 0};
    for (const int k : amounts_) {
      const double amount = number(record, k).value_or(0);
      if (amount < 0)
        problem(record.line,
                "column '" + column(k)->name + "': value " + text_of(amount) + ": allowed: >= 0");
      (column(k)->role == PhaseRole::solid    ? raw.solid
       : column(k)->role == PhaseRole::liquid ? raw.liquid
                                              : raw.gas) += amount;
    }
    if (fraction_ >= 0) {
      const std::optional<double> fraction = number(record, fraction_);
      if (!fraction) return void(++left_out_);
      raw.fraction = *fraction;
    }
    PhaseRow row{kelvin, 0, {}, {}, record.line};
    if (enthalpy_ >= 0) row.enthalpy = number(record, enthalpy_);
    if (capacity_ >= 0) row.heat_capacity = number(record, capacity_);
    table_.rows.push_back(row), raw_.push_back(raw);
  }

  void finish_solids() {
    double largest = 0;
    for (const Raw& raw : raw_) largest = std::max(largest, raw.fraction);
    percent_ = fraction_ >= 0 && (column(fraction_)->percent || largest > most_fraction);
    double gas = 0;
    for (std::size_t k = 0; k < raw_.size(); ++k) {
      const Raw& raw = raw_[k];
      const double condensed = raw.solid + raw.liquid, share = raw.fraction / (percent_ ? 100 : 1);
      if (fraction_ < 0 && !(condensed > 0)) {
        problem(raw.line, "no phase has an amount: allowed: a solid or a liquid one in each row");
        continue;
      }
      gas = std::max(gas, raw.gas / std::max(condensed + raw.gas, 1e-300));
      if (share < -1e-3 || share > 1 + 1e-3)
        problem(raw.line, "column '" + column(fraction_)->name + "': value " + text_of(raw.fraction) +
                              ": allowed: 0 to " + (percent_ ? "100 %" : "1"));
      const bool liquid = fraction_ >= 0 && column(fraction_)->role != PhaseRole::solid_fraction;
      const double solids = fraction_ < 0 ? raw.solid / condensed : liquid ? 1 - share : share;
      table_.rows[k].solids = std::clamp(solids, 0.0, 1.0);
    }
    if (gas > 1e-3) warn("up to " + text_of(std::round(1000 * gas) / 10) + " % is gas: it is left out");
    if (fraction_ < 0 && column(amounts_[0])->unit == "mol")
      warn("the amounts are in moles: the solid fraction is one of moles, not of mass or volume");
  }

  // [kg] of the whole; of amounts in grams their sum.
  std::optional<double> whole() const {
    if (mass_ || !weighs() || raw_.empty()) return mass_;
    return (raw_[0].solid + raw_[0].liquid + raw_[0].gas) * column(amounts_[0])->factor;
  }

  void finish_heat() {
    for (const int k : {enthalpy_, capacity_}) {
      if (k < 0) continue;
      const PhaseColumn& c = *column(k);
      const std::optional<double> mass = c.per_mass ? 1.0 : whole();
      if (!mass || !(*mass > 0)) {
        problem(names_line(),
                "column '" + c.name +
                    "' is of the whole system: allowed: with its mass, by --mass in kg or by amounts of "
                    "all phases in g");
        continue;
      }
      for (PhaseRow& row : table_.rows) {
        std::optional<double>& value = k == enthalpy_ ? row.enthalpy : row.heat_capacity;
        if (value) *value *= c.factor / *mass;
      }
      if (!c.per_mass) mass_told_ = *mass;
    }
  }

  void sort() {
    std::stable_sort(table_.rows.begin(), table_.rows.end(), [](const PhaseRow& a, const PhaseRow& b) {
      return a.temperature < b.temperature || (a.temperature == b.temperature && a.solids > b.solids);
    });
  }

  std::string list(PhaseRole role) const {
    std::string names;
    for (const int k : amounts_)
      if (column(k)->role == role) names += (names.empty() ? "'" : ", '") + column(k)->name + "'";
    return names.empty() ? "none" : names;
  }

  std::string how(const std::string& encoding) const {
    std::string text = encoding + ", separated by " + name_of(layout_.separator) + ", decimal " +
                       (sign_ == DecimalSign::comma ? "comma" : "point") + ": " +
                       std::to_string(table_.rows.size()) + " rows; temperature in " +
                       column(temperature_)->unit + " from '" + column(temperature_)->name + "'";
    if (fraction_ >= 0)
      text += std::string("; ") +
              (column(fraction_)->role == PhaseRole::solid_fraction ? "solid" : "liquid") + " fraction" +
              (percent_ ? " in %" : "") + " from '" + column(fraction_)->name + "'";
    else
      text += "; amounts" + (column(amounts_[0])->bare ? "" : " in " + column(amounts_[0])->unit) +
              ": liquid " + list(PhaseRole::liquid) + "; solid " + list(PhaseRole::solid) + "; gas " +
              list(PhaseRole::gas);
    if (enthalpy_ >= 0) text += "; enthalpy from '" + column(enthalpy_)->name + "'";
    if (capacity_ >= 0) text += "; heat capacity from '" + column(capacity_)->name + "'";
    if (mass_told_ > 0) text += " of " + text_of(mass_told_) + " kg";
    std::string unused;
    for (const PhaseColumn& c : layout_.columns)
      if (c.role == PhaseRole::none && !c.name.empty())
        unused += (unused.empty() ? "'" : ", '") + c.name + "'";
    if (!unused.empty()) text += "; not used: " + unused;
    if (left_out_ > 0) text += "; " + std::to_string(left_out_) + " rows without numbers left out";
    return text;
  }

  std::string file_;
  std::optional<double> mass_;
  std::optional<DecimalSign> decimal_;
  DecimalSign sign_ = DecimalSign::point;
  Layout layout_;
  PhaseTable table_;
  std::vector<Raw> raw_;
  std::vector<Problem> problems_;
  std::vector<int> amounts_;
  int temperature_ = -1, fraction_ = -1, enthalpy_ = -1, capacity_ = -1;  // columns
  int left_out_ = 0;
  double mass_told_ = 0;
  bool percent_ = false;
};

}  // namespace

PhaseTable parse_phases(const std::string& text, const std::string& file, const SampleFacts& options,
                        std::optional<double> mass) {
  return PhaseReader(file, options, mass).read(text);
}

}  // namespace slagflow
