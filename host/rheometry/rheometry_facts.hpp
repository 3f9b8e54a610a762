// What a file says beside its readings: `# key = value`, and lines such as `Density;2600;kg/m3`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/rheometry/rheometry_data.hpp"
#include "host/rheometry/rheometry_table.hpp"
#include "host/text/number_text.hpp"

namespace slagflow {

struct FileFacts {
  SampleFacts sample;
  std::optional<DecimalSign> decimal;  // `# decimal = comma`
};

// Reports keys of a known name with a unit or a value that cannot be. Other lines are prose.
FileFacts read_facts(const std::vector<Record>& lines, std::vector<Problem>& problems);

// Empty, or why a value [the named unit] cannot be.
std::string disbelief(double value, const NamedQuantity& named);

// Six digits.
std::string text_of(double value);

}  // namespace slagflow
