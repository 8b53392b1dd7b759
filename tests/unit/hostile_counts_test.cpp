// SPDX-License-Identifier: Apache-2.0
// Headers that promise billions cost an error, not memory.
#include "io/read_model.h"
#include "tests/support/bytes.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <limits>
#include <string>

namespace vitrine {
namespace {

using test::Bytes;
using testing::HasSubstr;

/// The most memory this process ever had, MB.
long peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

struct Hostile {
  std::string name;
  SourceModel (*read)(io::Blob const&, io::Resolve const&, io::ReadOptions const&);
  io::Blob file;
  std::string reason;
};

std::string ply(std::string const& format, std::string const& elements) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

std::string const kXyz = "property float x\nproperty float y\nproperty float z\n";
std::string const kOneVertex = "element vertex 1\n" + kXyz;
std::string const kFaces = "element face 2000000000\nproperty list uchar int vertex_indices\n";

Bytes binary(std::string const& elements) {
  return Bytes().text(ply("binary_little_endian", elements)).put(0.0f, 0.0f, 0.0f);
}
Bytes ascii(std::string const& elements) { return Bytes().text(ply("ascii", elements) + "0 0 0\n"); }

class HostileCounts : public testing::TestWithParam<Hostile> {};

TEST_P(HostileCounts, AreRefusedWithinSixtyFourMegabytes) {
  Hostile const& hostile = GetParam();
  long const before = peak();
  EXPECT_THAT(test::refusal([&] { return hostile.read(hostile.file, test::no_files, {}); }), HasSubstr(hostile.reason));
  EXPECT_LT(peak() - before, 64);
}

std::int32_t const kMost = std::numeric_limits<std::int32_t>::max();

INSTANTIATE_TEST_SUITE_P(
    Files, HostileCounts,
    testing::Values(
        Hostile{"PlyVertices", io::read_ply, binary("element vertex 1400000000\n" + kXyz + kFaces).blob(),
                "1400000000 announced"},
        Hostile{"PlyMoreVerticesThanTheLimit", io::read_ply, binary("element vertex 9000000000\n" + kXyz).blob(),
                "exceed the limit"},
        Hostile{"PlyTextVertices", io::read_ply, ascii("element vertex 1400000000\n" + kXyz).blob(),
                "1400000000 announced"},
        Hostile{"PlyFaces", io::read_ply, binary(kOneVertex + kFaces).put(std::uint8_t{3}, 0, 0, 0).blob(),
                "2000000000 announced"},
        Hostile{"PlyTextFaces", io::read_ply, ascii(kOneVertex + kFaces).text("3 0 0 0\n").blob(),
                "2000000000 announced"},
        Hostile{"PlyEmptyVertices", io::read_ply, binary("element vertex 1400000000\n").blob(), "no x, y and z"},
        Hostile{"PlyEmptyElement", io::read_ply, binary("element void 9000000000\n" + kOneVertex).blob(), "no faces"},
        Hostile{
            "PlyPolygon", io::read_ply,
            binary(kOneVertex + "element face 1\nproperty list int int vertex_indices\n").put(kMost, 0, 0, 0).blob(),
            "ends within"},
        Hostile{"PlyTextPolygon", io::read_ply,
                ascii(kOneVertex + "element face 1\nproperty list int int vertex_indices\n")
                    .text("2147483647 0 0 0\n")
                    .blob(),
                "missing"},
        Hostile{"PlyStrip", io::read_ply,
                binary(kOneVertex + "element tristrips 1\nproperty list int int vertex_indices\n")
                    .put(kMost, 0, 0, 0)
                    .blob(),
                "ends within"},
        Hostile{"Stl", io::read_stl,
                Bytes().text(std::string(80, ' ')).put(2'000'000'000u).text(std::string(50, ' ')).blob(),
                "2000000000 triangles"},
        Hostile{"OffVertices", io::read_off, test::blob("OFF 2000000000 1 0\n0 0 0\n"),
                "2000000000 vertices announced"},
        Hostile{"OffFaces", io::read_off, test::blob("OFF 1 2000000000 0\n0 0 0\n3 0 0 0\n"),
                "2000000000 faces announced"},
        Hostile{"OffPolygon", io::read_off, test::blob("OFF 1 1 0\n0 0 0\n2000000000 0 0 0\n"),
                "2000000000 corners has 3"}),
    [](testing::TestParamInfo<Hostile> const& hostile) { return hostile.param.name; });

}  // namespace
}  // namespace vitrine
