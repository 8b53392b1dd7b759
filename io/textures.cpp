// SPDX-License-Identifier: Apache-2.0
#include "io/textures.h"

#include "io/image_codec.h"

#include <algorithm>
#include <utility>

namespace vitrine::io {

int Textures::take(std::string const& name, ColourSpace space, Fetch const& fetch) {
  auto const known =
      std::find_if(taken_.begin(), taken_.end(), [&](Taken const& t) { return t.name == name && t.space == space; });
  if (known != taken_.end()) return known->image;
  int index = -1;
  try {
    std::optional<Blob> const file = fetch();
    if (!file) throw Error(ErrorKind::invalid_input, "there is no such file beside the model", "");
    ReadLimits limits;
    limits.texels = texels_left_;
    Image image = decode_image(file->bytes, space, limits);
    texels_left_ -= static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    index = static_cast<int>(model_.images.size());
    model_.images.push_back(std::move(image));
  } catch (Error const& error) {
    model_.notes.push_back("texture \"" + name + "\" left out: " + error.what());
  }
  taken_.push_back({name, space, index});
  return index;
}

}  // namespace vitrine::io
