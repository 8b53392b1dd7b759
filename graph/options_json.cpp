// SPDX-License-Identifier: Apache-2.0
#include "graph/options_json.h"

namespace vitrine::graph {

nlohmann::ordered_json options_json(ModelOptions const& options) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  option_groups(options, [&](std::string_view, auto const& group) {
    group.fields(group, [&](auto const& value, Field const& field) {
      if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
        out[std::string(field.flag)] = shown(value);
      else
        out[std::string(field.flag)] = value;
    });
  });
  return out;
}

}  // namespace vitrine::graph
