// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Choices that belong together.

#include "graph/options.h"

namespace vitrine::graph {

enum class Preset {
  paper  ///< all choices of Limper et al. 2015, for comparison
};

}  // namespace vitrine::graph

template <>
struct vitrine::EnumNames<vitrine::graph::Preset> {
  static constexpr std::array<std::string_view, 1> names{"paper"};
};

namespace vitrine::graph {

/// The options with those replaced that the preset is about.
ModelOptions with(Preset preset, ModelOptions options);

}  // namespace vitrine::graph
