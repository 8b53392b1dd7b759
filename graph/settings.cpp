// SPDX-License-Identifier: Apache-2.0
#include "graph/settings.h"

#include "graph/certificate.h"
#include "graph/options_json.h"
#include "io/codec_versions.h"
#include "io/dependencies.h"

namespace vitrine::graph {

using json = nlohmann::ordered_json;

std::string const& build_id() {
  static std::string const id = io::content_hash(io::map_file("/proc/self/exe").bytes);
  return id;
}

std::string settings_hash(ModelOptions const& options, std::string const& title, io::UpAxis up) {
  json const all = {program_json(), build_id(), io::codec_versions(), options_json(options), up == io::UpAxis::z};
  return io::content_hash(all.dump() + title);
}

}  // namespace vitrine::graph
