// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What decides, beside the bytes of a model and of the files it names, what becomes of it.

#include "graph/options.h"
#include "io/archive.h"

#include <string>

namespace vitrine::graph {

/// Tells one build of the program from another: a hash of its file.
std::string const& build_id();

/// Of the options, the title, the up axis, the program, its build and its codecs: equal only if all of them are.
std::string settings_hash(ModelOptions const& options, std::string const& title, io::UpAxis up);

}  // namespace vitrine::graph
