// Where a result comes from: goes into every file that a run writes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/case/case.hpp"

namespace slagflow {

struct Provenance {
  std::string version, commit, compiler, build_type;
  std::string backend;    // "cpu" or "cuda"
  std::string device;     // processor or GPU
  int threads = 1;        // CPU build
  std::string precision;  // "float" or "double"
  std::string case_name;
  std::string case_text;    // the resolved case, TOML
  std::string started_utc;  // ISO 8601
  std::string ended_utc;    // the same; empty while the run is on
  std::string changes;      // a line for each key that has changed since the start, and when; or empty
  // Of a run that began from the state of another one: from_folder, from_file, from_time, from_step and
  // from_changes, the keys that differ, a line each.
  std::vector<std::pair<std::string, std::string>> origin{};

  // Name and value of each, as attributes of a file. The same names at all times: where a disk fails, an
  // attribute that a file already has is the old or the new one.
  std::vector<std::pair<std::string, std::string>> attributes() const;

  // Of a resumed run: takes over what is known of its start. Where the program or the device has changed,
  // both are named.
  void begin_with(const std::vector<std::pair<std::string, std::string>>& attributes_of_start);
};

// The values of the texts that begin with "from_".
std::vector<std::pair<std::string, std::string>> origin_among(
    const std::vector<std::pair<std::string, std::string>>& texts);

// The present time, ISO 8601.
std::string now_utc();

// The build and the device, without a case.
Provenance build_provenance();
// The build, the device, a resolved case and the present time.
Provenance run_provenance(const Case& resolved);

}  // namespace slagflow
