// SPDX-License-Identifier: Apache-2.0
#include "io/textures.h"

#include "io/image_codec.h"

#include <utility>

namespace vitrine::io {

int Textures::take(std::string const& name, ColourSpace space, Fetch const& fetch) {
  auto const [entry, added] = taken_.try_emplace({name, space}, -1);
  if (!added) return entry->second;
  try {
    std::optional<Blob> const file = fetch();
    if (!file) throw Error(ErrorKind::invalid_input, "there is no such file beside the model", "");
    ReadLimits limits;
    limits.texels = texels_left_;
    Image image = decode_image(file->bytes, space, limits);
    texels_left_ -= static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    entry->second = static_cast<int>(model_.images.size());
    model_.images.push_back(std::move(image));
  } catch (Error const& error) {
    model_.notes.push_back("texture \"" + name + "\" left out: " + error.what());
  }
  return entry->second;
}

}  // namespace vitrine::io
