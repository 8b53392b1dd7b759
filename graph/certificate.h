// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the program vouches for, beside each thumbnail.

#include "graph/options.h"
#include "graph/report.h"

#include <nlohmann/json_fwd.hpp>

namespace vitrine::graph {

/// Which program it was.
nlohmann::ordered_json program_json();

/// certificate.json (schema 1) of a measured model: what it was made from, how, and how good it is. The same model,
/// options and program give the same certificate.
nlohmann::ordered_json certificate_json(ModelRow const& row, ModelOptions const& options);

}  // namespace vitrine::graph
