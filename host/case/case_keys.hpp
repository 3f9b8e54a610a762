// The tables of a case file: a function each, which declares its keys.
#pragma once

#include "host/case/case.hpp"
#include "host/case/case_visitor.hpp"

namespace slagflow {

// All of them, in the order of a resolved case.
void describe(CaseVisitor&, Case&);

void describe_frame(CaseVisitor&, Case&);    // [case] [resolution] [gravity] [body_force] [domain]
void describe_fluids(CaseVisitor&, Case&);   // [fluid.NAME]
void describe_regions(CaseVisitor&, Case&);  // [[region]]
void describe_walls(CaseVisitor&, Case&);    // [[wall]]
void describe(CaseVisitor&, WallMotion&, const std::string& case_file);  // wall.motion
void describe_openings(CaseVisitor&, Case&);                             // [[inlet]] [[outlet]]
void describe_numerics(CaseVisitor&, Case&);                             // [numerics]
void describe(CaseVisitor&, NumericsSetup&);                             // inside of it
void describe(CaseVisitor&, LimitSetup&);                                // inside of [limits]
void describe(CaseVisitor&, OutputSpec&);                                // inside of [output]
void describe_measures(CaseVisitor&, Case&);                             // [[measure]]

// Lists of shapes; STL files are looked for next to the case file.
void describe_shapes(CaseVisitor&, const Key&, std::vector<ShapeSpec>&, const std::string& case_file);

void describe_stl(CaseVisitor&, StlSpec&, const std::string& case_file, const std::string& what);

// The key that names one of the case's fluids.
void describe_fluid_of(CaseVisitor&, const Case&, int& fluid);

// A name that must be plain: whether it is.
bool describe_name(CaseVisitor&, const Key&, std::string& name);
// An entry's name that no earlier entry has.
template <class T>
void describe_own_name(CaseVisitor& v, const Key& k, const std::vector<T>& entries, T& entry) {
  if (!describe_name(v, k, entry.name)) return;
  constexpr std::ptrdiff_t looked_at = 2000;  // beyond that the number of entries is wrong anyway
  if (&entry - entries.data() > looked_at) return;
  for (const T* other = entries.data(); other != &entry; ++other)
    if (other->name == entry.name)
      return v.problem("name",
                       "value " + in_quotes(entry.name) + " is given twice: allowed: a name of its own");
}

// More entries than there are numbers for; `of` says of which kind.
void check_count(CaseVisitor&, const char* key, std::size_t count, const std::string& of = "");

}  // namespace slagflow
