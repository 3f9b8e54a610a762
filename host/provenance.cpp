#include "host/provenance.hpp"

#include <array>
#include <ctime>
#include <type_traits>

#include "simulation.hpp"
#include "version.hpp"

namespace slagflow {
namespace {

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Provenance::attributes() const {
  return {{"case", case_name},      {"case_text", case_text},    {"version", version},
          {"commit", commit},       {"compiler", compiler},      {"build_type", build_type},
          {"backend", backend},     {"device", device},          {"threads", std::to_string(threads)},
          {"precision", precision}, {"started_utc", started_utc}};
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
