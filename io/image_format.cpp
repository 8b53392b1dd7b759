// SPDX-License-Identifier: Apache-2.0
#include "io/image_format.h"

#include "io/avif_codec.h"
#include "io/stand_in.h"
#include "stages/error.h"

#include <cstring>
#include <string_view>
#include <tuple>

namespace vitrine::io {
namespace {

using Bytes = std::span<std::byte const>;

[[noreturn]] void refuse(ErrorKind kind, std::string const& what) {
  throw Error(kind, what, "supply the image as PNG or JPEG");
}

bool starts(Bytes bytes, std::string_view magic, std::size_t at = 0) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

/// Targa has no magic in front: its header must make sense.
bool is_targa(Bytes bytes) {
  if (bytes.size() < 18) return false;
  auto const at = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
  int const type = at(2) & ~8, depth = at(16);
  return at(1) <= 1 && type >= 1 && type <= 3 &&
         (depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32);
}

}  // namespace

std::string image_format(std::span<std::byte const> bytes) {
  using namespace std::string_view_literals;
  if (starts(bytes, "\xFF\xD8\xFF")) return "jpeg";
  if (starts(bytes, "\x89PNG\r\n\x1A\n")) return "png";
  if (starts(bytes, "RIFF") && starts(bytes, "WEBP", 8)) return "webp";
  if (is_avif(bytes)) return "avif";
  if (starts(bytes, "GIF8")) return "gif";
  if (starts(bytes, "II*\0"sv) || starts(bytes, "MM\0*"sv) || starts(bytes, "II+\0"sv) || starts(bytes, "MM\0+"sv))
    return "tiff";
  if (starts(bytes, "BM")) return "bmp";
  if (bytes.size() > 2 && starts(bytes, "P") && bytes[1] >= std::byte{'1'} && bytes[1] <= std::byte{'6'}) return "pnm";
  refuse_stand_in(bytes, "image");
  for (auto const& [magic, at, name] : {std::tuple{"ftyphe"sv, 4, "HEIF"},
                                        {"ftypmif1"sv, 4, "HEIF"},
                                        {"\xABKTX"sv, 0, "KTX"},
                                        {"DDS "sv, 0, "DDS"},
                                        {"\x76\x2F\x31\x01"sv, 0, "OpenEXR"},
                                        {"#?"sv, 0, "Radiance HDR"},
                                        {"8BPS"sv, 0, "Photoshop"},
                                        {"\0\0\0\x0CjP"sv, 0, "JPEG 2000"}})
    if (starts(bytes, magic, static_cast<std::size_t>(at)))
      refuse(ErrorKind::unsupported, std::string(name) + " images are not read");
  if (is_targa(bytes)) return "targa";
  refuse(ErrorKind::invalid_input, "no known image format in " + std::to_string(bytes.size()) + " bytes");
}

}  // namespace vitrine::io
