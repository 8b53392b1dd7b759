// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the bytes of any tool's GLB are spent on.

#include <cstddef>
#include <span>

namespace vitrine::io {

/// Bytes; the parts add up to the file's size.
struct GlbParts {
  std::size_t geometry = 0;  ///< buffer views that hold no image; compressed ones by their compressed bytes
  std::size_t colour = 0, normal = 0,
              occlusion = 0;  ///< images by what a material uses them for, in this order of right
  std::size_t other = 0;      ///< JSON, headers, padding, images of other kinds
};

/// Errors: InvalidInput when the bytes are no GLB, or its views claim more bytes than there are.
GlbParts glb_parts(std::span<std::byte const> glb);

}  // namespace vitrine::io
