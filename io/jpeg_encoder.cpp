// SPDX-License-Identifier: Apache-2.0
#include "io/jpeg_encoder.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <jpeglib.h>  // needs <cstdio> before

namespace vitrine::io {
namespace {

/// libjpeg leaves by longjmp: no object with a destructor may live between setjmp and there.
struct Compressor {
  jpeg_compress_struct state{};
  jpeg_error_mgr errors{};
  std::jmp_buf failed;
  char reason[JMSG_LENGTH_MAX] = "";
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  Compressor() {
    state.err = jpeg_std_error(&errors);
    state.client_data = this;
    errors.error_exit = [](j_common_ptr common) {
      auto* self = static_cast<Compressor*>(common->client_data);
      common->err->format_message(common, self->reason);
      std::longjmp(self->failed, 1);
    };
    errors.output_message = [](j_common_ptr) {};
  }
  ~Compressor() {
    jpeg_destroy_compress(&state);
    std::free(bytes);
  }
  Compressor(Compressor const&) = delete;
  Compressor& operator=(Compressor const&) = delete;
};

void configure(jpeg_compress_struct& state, Image const& image, ImageQuality const& quality) {
  state.image_width = static_cast<JDIMENSION>(image.width);
  state.image_height = static_cast<JDIMENSION>(image.height);
  state.input_components = image.channels;
  state.in_color_space = image.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&state);
  jpeg_set_quality(&state, quality.quality, TRUE);
  state.optimize_coding = TRUE;
  if (quality.full_chroma) state.comp_info[0].h_samp_factor = state.comp_info[0].v_samp_factor = 1;
  if (quality.effort != Effort::usual) jpeg_simple_progression(&state);
}

bool compress(Compressor& compressor, Image const& image, ImageQuality const& quality) {
  jpeg_compress_struct& state = compressor.state;
  if (setjmp(compressor.failed)) return false;
  jpeg_create_compress(&state);
  jpeg_mem_dest(&state, &compressor.bytes, &compressor.size);
  configure(state, image, quality);
  jpeg_start_compress(&state, TRUE);
  while (state.next_scanline < state.image_height) {
    auto* row = const_cast<JSAMPLE*>(image.texels.data() + std::size_t(state.next_scanline) * state.image_width *
                                                               static_cast<std::size_t>(state.input_components));
    jpeg_write_scanlines(&state, &row, 1);
  }
  jpeg_finish_compress(&state);
  return true;
}

}  // namespace

std::vector<std::byte> encode_jpeg(Image const& image, ImageQuality const& quality) {
  Compressor compressor;
  if (!compress(compressor, image, quality))
    throw Error(ErrorKind::broken,
                "libjpeg cannot encode " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                    " texels: " + compressor.reason,
                "report this with the model");
  auto const* begin = reinterpret_cast<std::byte const*>(compressor.bytes);
  return {begin, begin + compressor.size};
}

}  // namespace vitrine::io
