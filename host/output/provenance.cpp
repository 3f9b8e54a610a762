#include "host/output/provenance.hpp"

#include <array>
#include <cstring>
#include <ctime>
#include <map>
#include <type_traits>

#include "simulation/simulation.hpp"
#include "version.hpp"

namespace slagflow {

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::vector<std::pair<std::string, std::string>> Provenance::attributes() const {
  std::vector<std::pair<std::string, std::string>> all{
      {"case", case_name},      {"case_text", case_text},     {"version", version},
      {"commit", commit},       {"compiler", compiler},       {"build_type", build_type},
      {"backend", backend},     {"device", device},           {"threads", std::to_string(threads)},
      {"precision", precision}, {"started_utc", started_utc}, {"ended_utc", ended_utc},
      {"changes", changes}};
  all.insert(all.end(), origin.begin(), origin.end());
  return all;
}

std::vector<std::pair<std::string, std::string>> origin_among(
    const std::vector<std::pair<std::string, std::string>>& texts) {
  std::vector<std::pair<std::string, std::string>> origin;
  for (const auto& text : texts)
    if (text.first.rfind("from_", 0) == 0) origin.push_back(text);
  return origin;
}

void Provenance::begin_with(const std::vector<std::pair<std::string, std::string>>& attributes_of_start) {
  constexpr const char* between = ", resumed with ";
  const std::map<std::string, std::string*> changing{{"version", &version},
                                                     {"commit", &commit},
                                                     {"compiler", &compiler},
                                                     {"build_type", &build_type},
                                                     {"device", &device}};
  origin = origin_among(attributes_of_start);
  for (const auto& [name, first] : attributes_of_start) {
    if (name == "started_utc") started_utc = first;
    if (name == "changes" && !first.empty()) changes = first + (changes.empty() ? "" : "\n") + changes;
    const auto found = changing.find(name);
    if (found == changing.end()) continue;
    std::string& here = *found->second;
    const auto last = first.rfind(between);
    const bool same = here == (last == std::string::npos ? first : first.substr(last + std::strlen(between)));
    here = same ? first : first + between + here;
  }
}

Provenance build_provenance() {
  const DeviceInfo device = device_info();
  Provenance p;
  p.version = SLAGFLOW_VERSION;
  p.commit = SLAGFLOW_COMMIT;
  p.compiler = SLAGFLOW_COMPILER;
  p.build_type = SLAGFLOW_BUILD_TYPE;
  p.backend = device.backend;
  p.device = device.name;
  p.threads = device.threads;
  p.precision = std::is_same_v<Real, double> ? "double" : "float";
  return p;
}

Provenance run_provenance(const Case& resolved) {
  Provenance p = build_provenance();
  p.case_name = resolved.name;
  p.case_text = to_toml(resolved);
  p.started_utc = now_utc();
  return p;
}

}  // namespace slagflow
