// Case files. Lines that begin with "--set " are overrides. What is accepted must come back the same from the
// resolved case.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "backend/error.hpp"
#include "host/case/case.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slagflow;
  const std::string prefix = "--set ";
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  std::string text;
  std::vector<std::string> overrides;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(prefix, 0) == 0)
      overrides.push_back(line.substr(prefix.size()));
    else
      text += line + "\n";
  }
  std::string resolved;
  try {
    resolved = to_toml(parse_case(text, "fuzz.toml", overrides));
  } catch (const InputError&) {
    return 0;
  }
  if (to_toml(parse_case(resolved, "resolved.toml")) != resolved) std::abort();
  return 0;
}
