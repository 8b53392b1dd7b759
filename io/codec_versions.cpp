// SPDX-License-Identifier: Apache-2.0
#include "io/codec_versions.h"

#include <OpenImageIO/imageio.h>
#include <avif/avif.h>
#include <draco/core/draco_version.h>
#include <webp/encode.h>

#include <jpeglib.h>  // needs <cstdio> before
#include <cstdio>

#include <meshoptimizer.h>

namespace vitrine::io {
namespace {

std::string dotted(int version, int base) {
  return std::to_string(version / (base * base)) + "." + std::to_string(version / base % base) + "." +
         std::to_string(version % base);
}

}  // namespace

std::string codec_versions() {
  char avif_codecs[256];
  avifCodecVersions(avif_codecs);
  return std::string("avif ") + avifVersion() + " (" + avif_codecs + "), webp " + dotted(WebPGetEncoderVersion(), 256) +
         ", jpeg " + dotted(LIBJPEG_TURBO_VERSION_NUMBER, 1000) + ", draco " + draco::kDracoVersion +
         ", meshoptimizer " + std::to_string(MESHOPTIMIZER_VERSION) + ", openimageio " +
         dotted(OIIO::openimageio_version(), 100);
}

}  // namespace vitrine::io
