// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A glTF file as a container: its JSON, and the bytes that buffers and buffer views stand for. Internal to io.

#include "io/gltf_json.h"
#include "io/read_model.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::io {

/// The bytes of a buffer view.
struct BufferView {
  std::span<std::byte const> bytes;
  std::size_t stride = 0;  ///< 0: tightly packed
};

class GltfFile {
 public:
  /// Errors: InvalidInput when the container or the JSON is damaged, Unsupported for glTF 1.0 and unknown required
  /// extensions.
  GltfFile(Blob file, Resolve const& resolve, ReadLimits const& limits);

  GltfJson const& root() const { return json_; }
  ReadLimits const& limits() const { return limits_; }

  /// Element of a top-level list. Errors: InvalidInput "accessors[7] of 3".
  GltfJson const& item(char const* collection, std::uint64_t index) const;

  /// Bytes of a view, decompressed where EXT_meshopt_compression says so. Errors: InvalidInput when it reaches past its
  /// buffer.
  BufferView view(std::uint64_t index);

  /// The file behind a `uri`: decoded from data: or resolved beside the model; nothing when there is no such file.
  std::optional<Blob> fetch(std::string const& uri) const;

  bool uses(std::string_view extension) const;

  /// Bytes of the file and of what it named so far: what counts without bytes of their own are measured by.
  std::uint64_t bytes_present() const { return bytes_present_; }

 private:
  void open_container();
  void check_extensions() const;
  std::span<std::byte const> buffer(std::uint64_t index);
  std::span<std::byte const> slice(std::uint64_t buffer, GltfJson const& view);
  std::span<std::byte const> decompressed(std::uint64_t index, GltfJson const& meshopt);

  Blob file_;
  Resolve const& resolve_;
  ReadLimits const& limits_;
  GltfJson json_;
  std::span<std::byte const> binary_chunk_;
  std::map<std::uint64_t, Blob> buffers_;
  std::map<std::uint64_t, std::vector<std::byte>> decompressed_;
  std::uint64_t bytes_present_ = 0, bytes_decompressed_ = 0;
};

}  // namespace vitrine::io
