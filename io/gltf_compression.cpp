// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_compression.h"

#include "io/assemble.h"

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <meshoptimizer.h>

#include <array>
#include <memory>

namespace vitrine::io {
namespace {

// ---- meshopt --------------------------------------------------------------------------------------------------------

/// The codecs' conditions on count and stride; the library asserts them.
void check_shape(MeshoptStream const& s, std::uint64_t byte_limit) {
  bool const attributes = s.mode == "ATTRIBUTES";
  bool fits = attributes ? s.stride > 0 && s.stride <= 256 && s.stride % 4 == 0 : s.stride == 2 || s.stride == 4;
  if (s.mode == "TRIANGLES")
    fits = fits && s.count % 3 == 0;
  else if (!attributes && s.mode != "INDICES")
    fits = false;
  std::string const shape = "a meshopt stream of mode \"" + s.mode.substr(0, 20) + "\", " + std::to_string(s.count) +
                            " x " + std::to_string(s.stride) + " bytes from " + std::to_string(s.bytes.size());
  if (!fits) refuse_gltf(shape);
  if (s.count > byte_limit / s.stride)
    throw Error(ErrorKind::limit_exceeded, "glTF: " + shape, "simplify or cut the model before");
  constexpr std::uint64_t best_ratio = 64;  // of the attribute codec: two bits stand for sixteen equal bytes
  if (s.count * s.stride / best_ratio > s.bytes.size()) refuse_gltf(shape);
}

void apply_filter(MeshoptStream const& s, std::vector<std::byte>& bytes) {
  if (s.filter.empty() || s.filter == "NONE") return;
  bool const attributes = s.mode == "ATTRIBUTES";
  if (attributes && s.filter == "OCTAHEDRAL" && (s.stride == 4 || s.stride == 8))
    meshopt_decodeFilterOct(bytes.data(), s.count, s.stride);
  else if (attributes && s.filter == "QUATERNION" && s.stride == 8)
    meshopt_decodeFilterQuat(bytes.data(), s.count, s.stride);
  else if (attributes && s.filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(bytes.data(), s.count, s.stride);
  else
    refuse_gltf("meshopt filter \"" + s.filter.substr(0, 20) + "\" on " + s.mode + " of " + std::to_string(s.stride) +
                " bytes");
}

// ---- Draco ----------------------------------------------------------------------------------------------------------

struct DracoCounts {
  std::uint32_t faces = 0, vertices = 0;
};

/// What the stream claims, read before the decoder makes room for it.
/// Source: Draco bitstream specification 2.2, sections 3 (header, metadata) and 5 (connectivity).
DracoCounts draco_counts(draco::DecoderBuffer buffer) {
  draco::DracoHeader header;
  bool ok = draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok();
  if (!ok) refuse_gltf("a Draco stream without a header");
  if (header.encoder_type != draco::TRIANGULAR_MESH || header.version_major != 2 || header.version_minor != 2)
    throw Error(ErrorKind::unsupported,
                "Draco " + std::to_string(header.version_major) + "." + std::to_string(header.version_minor) +
                    " stream of type " + std::to_string(header.encoder_type) + "; only meshes of version 2.2 are read",
                "export the model again");
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
  if (header.flags & METADATA_FLAG_MASK) {
    draco::GeometryMetadata metadata;
    ok = draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata);
  }
  DracoCounts counts;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    std::uint8_t traversal = 0;
    ok = ok && buffer.Decode(&traversal) && draco::DecodeVarint(&counts.vertices, &buffer) &&
         draco::DecodeVarint(&counts.faces, &buffer);
  } else {
    ok = ok && draco::DecodeVarint(&counts.faces, &buffer) && draco::DecodeVarint(&counts.vertices, &buffer);
  }
  if (!ok) refuse_gltf("a Draco stream that ends in its counts");
  return counts;
}

/// Room that the decoder takes for each, measured with room to spare: corner tables, attribute values, point maps.
constexpr std::uint64_t kBytesPerFace = 100, kBytesPerPoint = 100;

void check_counts(DracoCounts const& counts, std::size_t bytes, ReadLimits const& limits) {
  check_limits(limits, counts.vertices, counts.faces, counts.faces * kBytesPerFace + counts.vertices * kBytesPerPoint);
  // Entropy coding has no hard floor. Real meshes take a bit a face or more; a sixteenth of that is damage or a trap.
  constexpr std::uint64_t faces_per_byte = 128;
  if (counts.faces / faces_per_byte > bytes || counts.vertices / faces_per_byte > bytes)
    refuse_gltf("a Draco stream of " + std::to_string(bytes) + " bytes claims " + std::to_string(counts.faces) +
                " faces and " + std::to_string(counts.vertices) + " vertices");
}

Component component_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return Component::int8;
    case draco::DT_UINT8:
      return Component::uint8;
    case draco::DT_INT16:
      return Component::int16;
    case draco::DT_UINT16:
      return Component::uint16;
    case draco::DT_UINT32:
      return Component::uint32;
    case draco::DT_FLOAT32:
      return Component::float32;
    default:
      refuse_gltf("Draco attribute of data type " + std::to_string(type));
  }
}

/// The attribute's values for each point, tightly packed.
ComponentArray unpack(draco::PointAttribute const& attribute, std::uint32_t points) {
  ComponentArray array;
  array.type = component_of(attribute.data_type());
  array.components = static_cast<std::size_t>(attribute.num_components());
  array.count = points;
  array.stride = array.components * size_of(array.type);
  array.storage.resize(array.count * array.stride);
  for (std::uint32_t i = 0; i < points; ++i) {
    draco::AttributeValueIndex const value = attribute.mapped_index(draco::PointIndex(i));
    if (value.value() >= attribute.size()) refuse_gltf("a Draco point names a value that is not there");
    attribute.GetValue(value, array.storage.data() + i * array.stride);
  }
  array.bytes = array.storage;
  return array;
}

}  // namespace

std::vector<std::byte> decode_meshopt(MeshoptStream const& stream, std::uint64_t byte_limit) {
  check_shape(stream, byte_limit);
  std::vector<std::byte> bytes(stream.count * stream.stride);
  auto const* in = reinterpret_cast<unsigned char const*>(stream.bytes.data());
  using Decode = int (*)(void*, std::size_t, std::size_t, unsigned char const*, std::size_t);
  Decode const attributes = meshopt_decodeVertexBuffer, triangles = meshopt_decodeIndexBuffer,
               indices = meshopt_decodeIndexSequence;
  Decode const decode = stream.mode == "ATTRIBUTES" ? attributes : stream.mode == "TRIANGLES" ? triangles : indices;
  if (stream.count > 0 && decode(bytes.data(), stream.count, stream.stride, in, stream.bytes.size()) != 0)
    refuse_gltf("a damaged meshopt stream of " + std::to_string(stream.bytes.size()) + " bytes");
  apply_filter(stream, bytes);
  return bytes;
}

DracoGeometry decode_draco(std::span<std::byte const> bytes, std::span<std::uint64_t const> attribute_ids,
                           ReadLimits const& limits) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<char const*>(bytes.data()), bytes.size());
  check_counts(draco_counts(buffer), bytes.size(), limits);
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) refuse_gltf("a damaged Draco stream: " + decoded.status().error_msg_string());
  std::unique_ptr<draco::Mesh> const mesh = std::move(decoded).value();

  DracoGeometry geometry;
  geometry.vertices = mesh->num_points();
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f)
    for (draco::PointIndex const& point : mesh->face(f)) {
      if (point.value() >= mesh->num_points()) refuse_gltf("a Draco face names a point that is not there");
      geometry.indices.push_back(point.value());
    }
  for (std::uint64_t const id : attribute_ids) {
    draco::PointAttribute const* const attribute = mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    if (!attribute) refuse_gltf("Draco attribute " + std::to_string(id) + " is missing");
    geometry.attributes.emplace(id, unpack(*attribute, mesh->num_points()));
  }
  return geometry;
}

}  // namespace vitrine::io
