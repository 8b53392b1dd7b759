// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The images of a model while it is read. Internal to io.

#include "io/read_model.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace vitrine::io {

/// Decodes each image once for each colour space it is used in, within the limit on all texels of the model.
class Textures {
 public:
  Textures(SourceModel& model, ReadLimits const& limits) : model_(model), texels_left_(limits.texels) {}

  using Fetch = std::function<std::optional<Blob>()>;

  /// The image's index in the model. A file that is missing, leads out of the folder or is damaged costs the model only
  /// this texture: -1, and a note.
  int take(std::string const& name, ColourSpace space, Fetch const& fetch);

 private:
  SourceModel& model_;
  std::uint64_t texels_left_;
  std::map<std::pair<std::string, ColourSpace>, int> taken_;
};

}  // namespace vitrine::io
