// SPDX-License-Identifier: Apache-2.0
#include "tools/options_page.h"

#include "graph/pipeline.h"
#include "tools/command_line.h"

#include <fmt/format.h>

namespace vitrine::tools {
namespace {

template <class T>
std::string allowed(Field const& field) {
  if constexpr (std::is_enum_v<T>) {
    std::string text = choices<T>();
    std::replace(text.begin(), text.end(), '|', ' ');
    return text;
  } else if constexpr (std::is_same_v<T, bool>) {
    return "yes no";
  } else {
    return fmt::format("{} to {} {}", field.low, field.high, field.unit);
  }
}

}  // namespace

std::string options_page() {
  std::string page =
      "# Options of `vitrine convert` that change what comes out\n\n"
      "Written from the program's own option structs; a test keeps this page current.\n";
  graph::ModelOptions const defaults;
  graph::option_groups(defaults, [&](std::string_view group, auto const& options) {
    page += fmt::format("\n## {}\n\n| option | default | allowed | meaning |\n|---|---|---|---|\n", group);
    options.fields(options, [&](auto const& value, Field const& field) {
      using T = std::decay_t<decltype(value)>;
      page += fmt::format("| `--{}` | {} | {} | {} |\n", field.flag, shown(value), allowed<T>(field), field.help);
    });
  });
  return page;
}

}  // namespace vitrine::tools
