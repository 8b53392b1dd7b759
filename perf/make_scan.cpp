// SPDX-License-Identifier: Apache-2.0
// perf_make_scan: one huge coloured scan as binary PLY within seconds: a wrinkled ring with noise down to its edges.
//   perf_make_scan OUT.ply --triangles 28000000 [--shuffle]
#include "stages/data.h"
#include "stages/parallel.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <numbers>
#include <string>

namespace {

using namespace vitrine;
using std::numbers::pi;

constexpr std::size_t kVertexBytes = 15, kFaceBytes = 13;

std::uint32_t hash(std::uint64_t x) {
  x = (x ^ x >> 31) * 0x7fb5d329728ea185u;
  x = (x ^ x >> 27) * 0x81dadef4bc2dd44du;
  return static_cast<std::uint32_t>(x ^ x >> 33);
}

/// A random order of n things that needs no memory: a Feistel network over the next power of four, walked until it is
/// within n again.
class Shuffle {
 public:
  explicit Shuffle(std::uint64_t n) : n_(n), half_bits_((int(std::bit_width(n)) + 1) / 2) {}

  std::uint64_t operator()(std::uint64_t i) const {
    do i = once(i);
    while (i >= n_);
    return i;
  }

 private:
  std::uint64_t once(std::uint64_t i) const {
    std::uint64_t const mask = (std::uint64_t{1} << half_bits_) - 1;
    std::uint64_t left = i >> half_bits_, right = i & mask;
    for (std::uint64_t round = 1; round <= 4; ++round) {
      std::uint64_t const next = left ^ (hash(right | round << 40) & mask);
      left = right, right = next;
    }
    return left << half_bits_ | right;
  }

  std::uint64_t n_;
  int half_bits_;
};

/// Waves of all lengths over the unit square, which closes on itself.
class Waves {
 public:
  explicit Waves(std::uint64_t seed) {
    for (std::size_t i = 0; i < table_.size(); ++i)
      table_[i] = float(std::sin(2 * pi * double(i) / double(table_.size())));
    for (std::size_t k = 0; k < waves_.size(); ++k) {
      double const frequency = 1.5 * std::pow(1.4, double(k)), angle = hash(seed + 2 * k) * 2 * pi / 4294967296.0;
      waves_[k] = {std::lround(frequency * std::cos(angle)), std::lround(frequency * std::sin(angle)),
                   hash(seed + 2 * k + 1), float(1 / (frequency + 2))};
    }
  }

  float operator()(double u, double v) const {
    auto const x = static_cast<std::int64_t>(u * 4294967296.0), y = static_cast<std::int64_t>(v * 4294967296.0);
    float sum = 0;
    for (Wave const& w : waves_)
      sum += w.height * table_[static_cast<std::uint32_t>(w.along_u * x + w.along_v * y + w.phase) >> 20];
    return sum;
  }

 private:
  struct Wave {
    std::int64_t along_u, along_v;
    std::uint32_t phase;
    float height;
  };
  std::array<float, 4096> table_;
  std::array<Wave, 18> waves_;
};

struct Scan {
  std::uint64_t columns, rows;

  explicit Scan(std::uint64_t triangles)
      : columns(std::max<std::uint64_t>(3, std::llround(std::sqrt(double(triangles))))),
        rows(std::max<std::uint64_t>(3, triangles / 2 / columns)) {}
  std::uint64_t vertices() const { return columns * rows; }
  std::uint64_t faces() const { return 2 * columns * rows; }
};

void write_vertex(Scan const& scan, std::uint64_t vertex, char* at) {
  static Waves const relief(1), paint(1000);
  double const u = double(vertex % scan.columns) / double(scan.columns),
               v = double(vertex / scan.columns) / double(scan.rows);
  double const noise = (hash(vertex) / 4294967296.0 - 0.5) * 0.3 / double(scan.columns);
  double const thickness = 0.35 + 0.25 * double(relief(u, v)) + noise, about = 2 * pi * u, around = 2 * pi * v;
  double const out = 1 + thickness * std::cos(around);
  std::array const place{float(out * std::cos(about)), float(thickness * std::sin(around)),
                         float(-out * std::sin(about))};
  std::memcpy(at, place.data(), sizeof place);
  for (int k = 0; k < 3; ++k)
    at[12 + k] = char(std::clamp(150 + 90 * paint(u + k * 0.07, v) + float(hash(vertex + k) % 9), 0.f, 255.f));
}

Triangle face(Scan const& scan, std::uint64_t index) {
  std::uint64_t const cell = index / 2, i = cell % scan.columns, j = cell / scan.columns;
  auto const at = [&](std::uint64_t x, std::uint64_t y) {
    return static_cast<std::uint32_t>(y % scan.rows * scan.columns + x % scan.columns);
  };
  return index % 2 == 0 ? Triangle{at(i, j), at(i, j + 1), at(i + 1, j)}
                        : Triangle{at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)};
}

/// Records in blocks: make(index, place in memory).
template <class Make>
void write_records(std::ofstream& file, std::uint64_t count, std::size_t bytes, Make const& make) {
  constexpr std::uint64_t block = 1 << 20;
  std::string buffer(block * bytes, '\0');
  for (std::uint64_t first = 0; first < count; first += block) {
    std::uint64_t const here = std::min(block, count - first);
    vitrine::parallel_for(here, 4096, [&](std::size_t i) { make(first + i, buffer.data() + i * bytes); });
    file.write(buffer.data(), std::streamsize(here * bytes));
  }
}

void write(std::string const& path, Scan const& scan, bool shuffled) {
  std::ofstream file;
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file.open(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << scan.vertices()
       << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty "
          "uchar blue\nelement face "
       << scan.faces() << "\nproperty list uchar int vertex_indices\nend_header\n";
  Shuffle const vertices(scan.vertices()), faces(scan.faces());
  std::vector<std::uint32_t> place(shuffled ? scan.vertices() : 0);  // of each vertex in the file
  vitrine::parallel_for(place.size(), 4096, [&](std::size_t i) { place[vertices(i)] = static_cast<std::uint32_t>(i); });
  write_records(file, scan.vertices(), kVertexBytes,
                [&](std::uint64_t i, char* at) { write_vertex(scan, shuffled ? vertices(i) : i, at); });
  write_records(file, scan.faces(), kFaceBytes, [&](std::uint64_t i, char* at) {
    Triangle corners = face(scan, shuffled ? faces(i) : i);
    if (shuffled)
      for (std::uint32_t& corner : corners) corner = place[corner];
    *at = 3;
    std::memcpy(at + 1, corners.data(), sizeof corners);
  });
}

}  // namespace

int main(int argc, char** argv) try {
  std::string path;
  std::uint64_t triangles = 28'000'000;
  bool shuffle = false;
  CLI::App app("Writes one huge coloured scan.");
  app.add_option("out", path, "PLY file")->required();
  app.add_option("--triangles", triangles, "about so many")
      ->check(CLI::Range(18, 2'000'000'000))
      ->capture_default_str();
  app.add_flag("--shuffle", shuffle, "vertices and faces in random order");
  CLI11_PARSE(app, argc, argv);
  write(path, Scan(triangles), shuffle);
  return 0;
} catch (std::exception const& error) {
  std::cerr << "error: " << error.what() << '\n';
  return 1;
}
