// SPDX-License-Identifier: Apache-2.0
#include "io/webp_animation.h"

#include "stages/error.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <memory>
#include <string>

namespace vitrine::io {
namespace {

using Encoder = std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)>;

void require(bool ok, std::string const& what) {
  if (!ok) throw Error(ErrorKind::broken, "libwebp cannot encode an animation: " + what, "report this with the model");
}

Encoder start(Image const& first) {
  WebPAnimEncoderOptions options;
  require(WebPAnimEncoderOptionsInit(&options), "it has another version than its headers");
  options.anim_params.bgcolor = 0xFFFFFFFF;
  Encoder encoder(WebPAnimEncoderNew(first.width, first.height, &options), WebPAnimEncoderDelete);
  require(encoder != nullptr, "it cannot start");
  return encoder;
}

void add(WebPAnimEncoder* encoder, Image const& frame, WebPConfig const& config, int timestamp) {
  WebPPicture picture;
  require(WebPPictureInit(&picture), "it has another version than its headers");
  std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> const freed(&picture, WebPPictureFree);
  picture.use_argb = 1;
  picture.width = frame.width;
  picture.height = frame.height;
  auto const import = frame.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
  require(import(&picture, frame.texels.data(), frame.width * frame.channels), "out of memory");
  require(WebPAnimEncoderAdd(encoder, &picture, timestamp, &config), WebPAnimEncoderGetError(encoder));
}

}  // namespace

std::vector<std::byte> encode_animation(std::vector<Image> const& frames, int quality, int milliseconds) {
  require(!frames.empty(), "it has no frames");
  WebPConfig config;
  require(WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)), "it refuses its own preset");
  Encoder const encoder = start(frames.front());
  int timestamp = 0;
  for (Image const& frame : frames) {
    add(encoder.get(), frame, config, timestamp);
    timestamp += milliseconds;
  }
  require(WebPAnimEncoderAdd(encoder.get(), nullptr, timestamp, nullptr), WebPAnimEncoderGetError(encoder.get()));
  WebPData data;
  WebPDataInit(&data);
  std::unique_ptr<WebPData, decltype(&WebPDataClear)> const cleared(&data, WebPDataClear);
  require(WebPAnimEncoderAssemble(encoder.get(), &data), WebPAnimEncoderGetError(encoder.get()));
  auto const* begin = reinterpret_cast<std::byte const*>(data.bytes);
  return {begin, begin + data.size};
}

}  // namespace vitrine::io
