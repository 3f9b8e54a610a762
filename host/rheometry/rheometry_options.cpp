#include "host/rheometry/rheometry_options.hpp"

namespace slagflow {

void set_model(const std::string& name, RheometryOptions& options) {
  for (const FlowModel model : flow_models)
    if (name == name_of(model)) options.model = model;
  for (const LiquidLaw law : melt_laws)
    if (name == name_of(law)) options.law = law;
  for (const SlagModel model : slag_models)
    if (name == name_of(model)) options.slag_model = model;
}

std::vector<std::string> model_names() {
  std::vector<std::string> names{"auto"};
  for (const FlowModel model : flow_models) names.push_back(name_of(model));
  for (const LiquidLaw law : melt_laws) names.push_back(name_of(law));
  for (const SlagModel model : slag_models) names.push_back(name_of(model));
  return names;
}

}  // namespace slagflow
