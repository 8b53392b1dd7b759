// SPDX-License-Identifier: Apache-2.0
#include "tools/model_flags.h"

#include "graph/preset.h"
#include "tools/command_line.h"

namespace vitrine::tools {

void add_model_flags(CLI::App& app, graph::ModelOptions& options) {
  // CLI11 takes over values in the order in which options were added: the preset first, then what replaces parts of it.
  auto const take = [&options](graph::Preset const& preset) { options = graph::with(preset, options); };
  app.add_option_function<graph::Preset>("--preset", take, "choices that belong together; further flags win over them")
      ->transform(CLI::CheckedTransformer(names<graph::Preset>()).description(""))
      ->type_name(choices<graph::Preset>());
  graph::option_groups(
      options, [&](std::string const& group, auto& of_group) { of_group.fields(of_group, AddFlags(app, group)); });
}

}  // namespace vitrine::tools
