// SPDX-License-Identifier: Apache-2.0
#include "graph/options_json.h"

#include "stages/error.h"

#include <algorithm>

namespace vitrine::graph {
namespace {

constexpr char const *kMtlKd = "mtl-kd", *kMultiply = "multiply", *kIgnore = "ignore";

template <class T>
T parsed(StrictOrderedJson const& json) {
  if constexpr (std::is_enum_v<T>) {
    auto const& names = EnumNames<T>::names;
    auto const found = std::find(names.begin(), names.end(), json.get<std::string>());
    if (found == names.end())
      throw Error(ErrorKind::invalid_input, "there is no choice " + json.dump(), "make it anew");
    return static_cast<T>(found - names.begin());
  } else {
    return json.get<T>();
  }
}

}  // namespace

nlohmann::ordered_json options_json(ModelOptions const& options) {
  nlohmann::ordered_json out = {{kMtlKd, options.read.mtl_kd == io::MtlKd::multiply ? kMultiply : kIgnore}};
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

ModelOptions options_from_json(StrictOrderedJson const& json) try {
  ModelOptions options;
  if (json.value(kMtlKd, kIgnore) == std::string(kMultiply)) options.read.mtl_kd = io::MtlKd::multiply;
  option_groups(options, [&](std::string_view, auto& group) {
    group.fields(group, [&](auto& value, Field const& field) {
      auto const found = json.find(std::string(field.flag));
      if (found != json.end()) value = parsed<std::decay_t<decltype(value)>>(*found);
    });
  });
  return options;
} catch (nlohmann::json::exception const& e) {
  throw Error(ErrorKind::invalid_input, std::string("options: ") + e.what(), "make it anew");
}

}  // namespace vitrine::graph
