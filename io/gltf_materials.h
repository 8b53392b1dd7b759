// SPDX-License-Identifier: Apache-2.0
#pragma once
/// glTF materials, textures and samplers. Internal to io.

#include "io/gltf_file.h"
#include "io/textures.h"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace vitrine::io {

/// The materials of a model as primitives ask for them, each read once.
class GltfMaterials {
 public:
  GltfMaterials(GltfFile& gltf, SourceModel& model, ReadOptions const& options)
      : gltf_(gltf), model_(model), textures_(model, options.limits), occlusion_maps_(options.occlusion_maps) {}

  struct Entry {
    std::uint16_t index = 0;   ///< into SourceModel::materials
    std::uint64_t uv_set = 0;  ///< the TEXCOORD that its textures use
    bool only_emits = false;   ///< vertex colours, which reflect, do not show
  };

  /// Nothing: glTF's default material, white. Errors: InvalidInput for a material, texture or image that is not there.
  Entry take(std::optional<std::uint64_t> material);

 private:
  void read_emission(GltfJson const& description, bool alone, Material& material, Entry& entry);
  void read_occlusion(GltfJson const& map, bool alone, Material& material, std::uint64_t& uv_set);
  Material read(GltfJson const& description, Entry& entry);
  TextureUse use(GltfJson const& texture_info, ColourSpace space);
  std::optional<std::uint64_t> image_of(GltfJson const& texture) const;

  GltfFile& gltf_;
  SourceModel& model_;
  Textures textures_;
  bool occlusion_maps_;
  std::map<std::optional<std::uint64_t>, Entry> taken_;
};

}  // namespace vitrine::io
