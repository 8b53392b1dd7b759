// SPDX-License-Identifier: Apache-2.0
#include "tests/support/folders.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace vitrine::test {
namespace {

namespace fs = std::filesystem;

float srgb(std::uint16_t linear) {
  float const x = float(linear) / 65535;
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "vitrine-test-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make a temporary folder: " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void write_file(fs::path const& path, std::string_view text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary).write(text.data(), std::streamsize(text.size()));
}

std::string read_file(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string obj_text(SourceModel const& model) {
  std::ostringstream out;
  out.precision(9);
  for (std::size_t i = 0; i < model.mesh.positions.size(); ++i) {
    V3f const& p = model.mesh.positions[i];
    out << "v " << p.x << ' ' << p.y << ' ' << p.z;
    if (!model.colours.empty())
      for (int c = 0; c < 3; ++c) out << ' ' << srgb(model.colours[i][std::size_t(c)]);
    out << '\n';
  }
  for (Triangle const& t : model.mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.str();
}

fs::path shared_models() {
  fs::path const folder = fs::path(VITRINE_SOURCE_DIR) / "../shared/models";
  return fs::exists(folder / "MANIFEST.tsv") ? folder : fs::path();
}

std::vector<std::vector<std::string>> manifest(fs::path const& tsv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read_file(tsv));
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, '\t')) rows.back().push_back(cell);
  }
  return rows;
}

}  // namespace vitrine::test
