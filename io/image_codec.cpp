// SPDX-License-Identifier: Apache-2.0
#include "io/image_codec.h"

#include "io/avif_codec.h"
#include "io/image_format.h"
#include "io/jpeg_encoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <string>

namespace vitrine::io {
namespace {

using Bytes = std::span<std::byte const>;

char const* const supply = "supply the image as PNG or JPEG";

std::string first_line(std::string const& text) { return text.substr(0, text.find('\n')); }

[[noreturn]] void refuse(ErrorKind kind, std::string const& what) { throw Error(kind, what, supply); }

// ---- Sizes, before pixels -------------------------------------------------------------------------------------------

void check_size(std::int64_t width, std::int64_t height, std::size_t bytes, ReadLimits const& limits) {
  // No codec read here packs tighter: one bit a texel, deflated at 1032 : 1. What claims more is cut or a trap.
  constexpr std::uint64_t texels_per_byte = 8 * 1032;
  std::string const size = std::to_string(width) + " x " + std::to_string(height);
  if (width <= 0 || height <= 0) refuse(ErrorKind::invalid_input, "image of " + size + " texels");
  auto const texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (texels > limits.texels)
    throw Error(
        ErrorKind::limit_exceeded,
        "image of " + size + " = " + std::to_string(texels) + " texels; the limit is " + std::to_string(limits.texels),
        "supply a smaller image");
  if (texels / texels_per_byte > bytes)
    refuse(ErrorKind::invalid_input, "image of " + size + " texels in only " + std::to_string(bytes) + " bytes");
}

/// A reader that is open on bytes in memory; the members' order keeps the proxy alive longer than the reader.
struct Reader {
  OIIO::Filesystem::IOMemReader proxy;
  std::unique_ptr<OIIO::ImageInput> input;

  explicit Reader(Bytes bytes) : proxy(bytes.data(), bytes.size()) {}
  ~Reader() {
    if (input) (void)input->geterror();  // a pending error would be printed to stderr
  }
};

void use_one_thread() {
  static bool const once = OIIO::attribute("threads", 1);
  (void)once;
}

/// OpenImageIO 2.4 unpacks these past the end of what it was given where the palette is grey, and looks colours up in
/// palettes that are not there.
bool is_run_length_coded(Bytes bytes) {
  constexpr std::size_t kHeaderSize = 14, kCompression = 30;
  if (bytes.size() <= kCompression || bytes[kHeaderSize] == std::byte{12}) return false;  // the first header has none
  return bytes[kCompression] == std::byte{1} || bytes[kCompression] == std::byte{2};
}

std::unique_ptr<Reader> open(Bytes bytes, std::string const& format, ReadLimits const& limits) {
  use_one_thread();
  if (format == "gif" && bytes.size() >= 10) {  // its reader makes the canvas when it opens
    auto const at = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
    check_size(at(6) | at(7) << 8, at(8) | at(9) << 8, bytes.size(), limits);
  }
  if (format == "bmp" && is_run_length_coded(bytes))
    refuse(ErrorKind::unsupported, "run-length coded bmp images are not read");
  auto reader = std::make_unique<Reader>(bytes);
  reader->input = OIIO::ImageInput::create(format);
  if (!reader->input) refuse(ErrorKind::unsupported, format + " images are not read: " + OIIO::geterror());
  reader->input->set_ioproxy(&reader->proxy);
  OIIO::ImageSpec spec, config;
  config["oiio:UnassociatedAlpha"] = 1;
  if (!reader->input->open("", spec, config))
    refuse(ErrorKind::invalid_input, "damaged " + format + " image: " + first_line(reader->input->geterror()));
  OIIO::ImageSpec const& found = reader->input->spec();
  check_size(found.width, found.height, bytes.size(), limits);
  if (found.tile_pixels() > limits.texels || found.depth > 1 || found.nchannels < 1)
    refuse(ErrorKind::invalid_input, "damaged " + format + " image: impossible tiles, depth or channels");
  return reader;
}

int kept_channels(OIIO::ImageSpec const& spec) {
  if (spec.nchannels <= 3) return spec.nchannels;
  return spec.alpha_channel == 3 || spec.nchannels == 4 ? 4 : 3;
}

std::uint8_t to_byte(float value, bool encode) {
  float const v = value > 0 ? std::min(value, 1.0f) : 0.0f;  // NaN too
  float const coded = !encode ? v : v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * coded));
}

void read_texels(OIIO::ImageInput& input, Image& image) {
  auto const read = [&](OIIO::TypeDesc type, void* to) { return input.read_image(0, 0, 0, image.channels, type, to); };
  bool complete = false;
  if (input.spec().format.is_floating_point()) {  // holds linear light
    std::vector<float> values(image.texels.size());
    complete = read(OIIO::TypeDesc::FLOAT, values.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
      bool const alpha = image.channels % 2 == 0 &&
                         i % static_cast<unsigned>(image.channels) + 1 == static_cast<unsigned>(image.channels);
      image.texels[i] = to_byte(values[i], image.space == ColourSpace::srgb && !alpha);
    }
  } else {
    complete = read(OIIO::TypeDesc::UINT8, image.texels.data());
  }
  // The JPEG reader fills what is missing with grey, says so and succeeds. Stray bytes between its segments are
  // harmless.
  std::string const complaint = input.has_error() ? input.geterror() : "";
  bool const harmless = complaint.empty() || complaint.find("extraneous bytes") != std::string::npos;
  if (!complete || !harmless)
    refuse(ErrorKind::invalid_input,
           std::string("damaged ") + input.format_name() + " image: " + first_line(complaint));
}

// ---- WebP -----------------------------------------------------------------------------------------------------------

std::uint8_t const* as_uint8(Bytes bytes) { return reinterpret_cast<std::uint8_t const*>(bytes.data()); }

ImageSize webp_size(Bytes bytes) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(as_uint8(bytes), bytes.size(), &features) != VP8_STATUS_OK)
    refuse(ErrorKind::invalid_input, "damaged webp image: its header ends early");
  if (features.has_animation) refuse(ErrorKind::unsupported, "animated webp images are not read");
  return {features.width, features.height, features.has_alpha ? 4 : 3};
}

void decode_webp(Bytes bytes, Image& image) {
  int const stride = image.width * image.channels;
  auto const decode = image.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  if (!decode(as_uint8(bytes), bytes.size(), image.texels.data(), image.texels.size(), stride))
    refuse(ErrorKind::invalid_input, "damaged webp image");
}

void require(bool ok, std::string const& what) {
  if (!ok) throw Error(ErrorKind::broken, what, "report this with the model");
}

/// Three or four channels; grey is spread to three.
Image colour_channels(Image const& image) {
  if (image.channels >= 3) return image;
  Image out{image.width, image.height, image.channels == 1 ? 3 : 4, image.space, {}};
  auto const step = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.texels.size(); i += step) {
    out.texels.insert(out.texels.end(), 3, image.texels[i]);
    if (step == 2) out.texels.push_back(image.texels[i + 1]);
  }
  return out;
}

std::vector<std::byte> encode_webp(Image const& image, ImageQuality const& quality) {
  bool const thorough = quality.effort != Effort::usual;
  WebPConfig config;
  require(WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality.quality)),
          "libwebp refuses its own preset");
  config.method = thorough ? 6 : 4;
  config.use_sharp_yuv = thorough;
  config.exact = 0;
  config.thread_level = 0;
  WebPPicture picture;
  require(WebPPictureInit(&picture), "libwebp has another version than its headers");
  std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> const freed(&picture, WebPPictureFree);
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> const cleared(&writer, WebPMemoryWriterClear);
  picture.width = image.width;
  picture.height = image.height;
  picture.use_argb = 1;  // sharp_yuv starts from RGB
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  Image const rgb = colour_channels(image);
  int const stride = rgb.width * rgb.channels;
  auto const import = rgb.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
  require(import(&picture, rgb.texels.data(), stride) && WebPEncode(&config, &picture),
          "libwebp cannot encode " + std::to_string(image.width) + " x " + std::to_string(image.height) +
              " texels (error " + std::to_string(picture.error_code) + ")");
  auto const* begin = reinterpret_cast<std::byte const*>(writer.mem);
  return {begin, begin + writer.size};
}

// ---- PNG ------------------------------------------------------------------------------------------------------------

std::vector<std::byte> write(Image const& image, std::string const& format, OIIO::ParamValueList const& settings) {
  use_one_thread();
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (image.channels % 2 == 0) spec.alpha_channel = image.channels - 1;
  spec["oiio:UnassociatedAlpha"] = 1;
  for (OIIO::ParamValue const& setting : settings) spec.extra_attribs.add_or_replace(setting);
  std::vector<unsigned char> buffer;
  OIIO::Filesystem::IOVecOutput proxy(buffer);
  auto const output = OIIO::ImageOutput::create(format);
  require(output != nullptr, "OpenImageIO has no writer for " + format);
  output->set_ioproxy(&proxy);
  bool const written = output->open("memory." + format, spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, image.texels.data()) && output->close();
  require(written, "OpenImageIO cannot write " + format + ": " + output->geterror());
  auto const* begin = reinterpret_cast<std::byte const*>(buffer.data());
  return {begin, begin + buffer.size()};
}

/// The smallest over libpng's row filters: none, up, average, Paeth, and all by its heuristic. None is best everywhere.
std::vector<std::byte> encode_png(Image const& image) {
  std::vector<std::byte> best;
  for (int const filter : {0x08, 0x20, 0x40, 0x80, 0xF8}) {
    OIIO::ParamValueList settings;
    settings["png:compressionLevel"] = 9;
    settings["png:filter"] = filter;
    std::vector<std::byte> bytes = write(image, "png", settings);
    if (best.empty() || bytes.size() < best.size()) best = std::move(bytes);
  }
  return best;
}

}  // namespace

ImageSize image_size(std::span<std::byte const> bytes) {
  std::string const format = image_format(bytes);
  if (format == "webp") return webp_size(bytes);
  if (format == "avif") return avif_size(bytes);
  auto const reader = open(bytes, format, {});
  OIIO::ImageSpec const& spec = reader->input->spec();
  return {spec.width, spec.height, kept_channels(spec)};
}

Image decode_image(std::span<std::byte const> bytes, ColourSpace space, ReadLimits const& limits) {
  std::string const format = image_format(bytes);
  if (format == "avif") return decode_avif(bytes, space, limits);
  auto const image_of = [&](ImageSize size) {
    auto const texels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
                        static_cast<std::size_t>(size.channels);
    return Image{size.width, size.height, size.channels, space, std::vector<std::uint8_t>(texels)};
  };
  if (format == "webp") {
    ImageSize const size = webp_size(bytes);
    // Lossless WebP needs some twenty bytes whatever the size, which its header keeps below 16384 x 16384.
    check_size(size.width, size.height, limits.texels, limits);
    Image image = image_of(size);
    decode_webp(bytes, image);
    return image;
  }
  auto const reader = open(bytes, format, limits);
  OIIO::ImageSpec const& spec = reader->input->spec();
  Image image = image_of({spec.width, spec.height, kept_channels(spec)});
  read_texels(*reader->input, image);
  return image;
}

bool is_same_coding(ImageCodec codec, int quality, int other) {
  if (codec == ImageCodec::png) return true;
  return codec == ImageCodec::avif ? avif_quantiser(quality) == avif_quantiser(other) : quality == other;
}

EncodedImage encode_image(Image const& image, ImageQuality const& quality) {
  auto const texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                      static_cast<std::size_t>(image.channels);
  require(image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4 &&
              image.texels.size() == texels,
          "image whose arrays do not fit its size");
  bool const alpha = image.channels % 2 == 0;
  ImageQuality within = quality;
  within.quality = std::clamp(quality.quality, 1, 100);
  if (quality.codec == ImageCodec::webp) return {"image/webp", encode_webp(image, within)};
  if (quality.codec == ImageCodec::avif) return {"image/avif", encode_avif(image, within)};
  if (quality.codec == ImageCodec::jpeg && !alpha) return {"image/jpeg", encode_jpeg(image, within)};
  return {"image/png", encode_png(image)};
}

}  // namespace vitrine::io
