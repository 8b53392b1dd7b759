// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/write.h"

#include <bit>

namespace vitrine::sample {

io::EncodedImage encode_texture(Scan const& scan, Colour colour) {
  int const width = int(std::bit_ceil(std::clamp(std::uint32_t(2 * std::sqrt(double(scan.triangles))), 256u, 4096u)));
  auto const codec = colour == Colour::jpeg ? io::ImageCodec::jpeg : io::ImageCodec::png;
  return io::encode_image(texture(scan, width), {codec, 92, true});
}

std::string_view ending(Format format) {
  switch (format) {
    case Format::obj:
      return ".obj";
    case Format::stl:
      return ".stl";
    case Format::off:
      return ".off";
    case Format::glb:
      return ".glb";
    default:
      return ".ply";
  }
}

std::filesystem::path write(std::filesystem::path const& root, Object const& object, std::string const& name,
                            Scan const& scan, std::optional<std::uint32_t> shuffle) {
  std::filesystem::path const path = std::filesystem::path(object.folder) / (name + std::string(ending(object.format)));
  switch (object.format) {
    case Format::obj:
      write_obj(root / path, scan, object.colour);
      break;
    case Format::stl:
      write_stl(root / path, scan);
      break;
    case Format::off:
      write_off(root / path, scan);
      break;
    case Format::glb:
      write_glb(root / path, scan, object.colour);
      break;
    default:
      write_ply(root / path, scan, object.format, object.colour == Colour::vertices, shuffle);
  }
  return path;
}

}  // namespace vitrine::sample
