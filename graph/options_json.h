// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Options as JSON, by flag.

#include "graph/options.h"
#include "graph/strict_json.h"

#include <string>
#include <type_traits>

namespace vitrine::graph {

/// An enum's value or a number, as --help, the report and the documentation show it.
template <class T>
std::string shown(T const& value) {
  if constexpr (std::is_enum_v<T>)
    return std::string(EnumNames<T>::names[static_cast<std::size_t>(value)]);
  else
    return nlohmann::json(value).dump();
}

/// Every option that changes what comes out.
nlohmann::ordered_json options_json(ModelOptions const& options);

/// What options_json wrote; keys that are missing keep their defaults, others are passed over.
/// Errors: InvalidInput for a value that the option does not have.
ModelOptions options_from_json(StrictOrderedJson const& json);

}  // namespace vitrine::graph
