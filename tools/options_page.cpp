// SPDX-License-Identifier: Apache-2.0
#include "tools/options_page.h"

#include "graph/preset.h"
#include "tools/command_line.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

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

using Values = std::vector<std::pair<std::string, std::string>>;  // by flag

Values values(graph::ModelOptions const& options) {
  Values all;
  graph::option_groups(options, [&](std::string_view, auto const& group) {
    group.fields(group, [&](auto const& value, Field const& field) { all.emplace_back(field.flag, shown(value)); });
  });
  return all;
}

/// As one would type it.
std::string flag(std::string const& name, std::string const& value) {
  if (value == "true") return "--" + name;
  return value == "false" ? "--no-" + name : "--" + name + " " + value;
}

/// What a preset changes.
std::string preset_row(graph::Preset preset) {
  graph::ModelOptions const defaults;
  Values const before = values(defaults), after = values(graph::with(preset, defaults));
  std::string row = fmt::format("| {} |", shown(preset));
  for (std::size_t i = 0; i < after.size(); ++i)
    if (after[i] != before[i]) row += fmt::format(" `{}`", flag(after[i].first, after[i].second));
  return row + " |\n";
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
  page +=
      "\n## Presets\n\n`--preset` sets several options at once; flags that are given beside it win.\n\n"
      "| preset | the same as |\n|---|---|\n";
  for (std::size_t i = 0; i < EnumNames<graph::Preset>::names.size(); ++i)
    page += preset_row(static_cast<graph::Preset>(i));
  return page;
}

}  // namespace vitrine::tools
