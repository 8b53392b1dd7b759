// SPDX-License-Identifier: Apache-2.0
// The readers on real files: whole ones have the counts of their manifest, broken ones are refused with a reason.
#include "io/read_model.h"
#include "stages/clean.h"
#include "tests/support/folders.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace vitrine {
namespace {

using testing::IsEmpty;
using testing::Not;

namespace fs = std::filesystem;

using Reader = SourceModel (*)(io::Blob const&, io::Resolve const&, io::ReadOptions const&);
std::map<std::string, Reader> const kReaders{{".ply", io::read_ply}, {".stl", io::read_stl},   {".off", io::read_off},
                                             {".obj", io::read_obj}, {".gltf", io::read_gltf}, {".glb", io::read_gltf}};

class SharedModels : public testing::Test {
 protected:
  void SetUp() override {
    if (test::shared_models().empty()) GTEST_SKIP() << "no shared models beside the repository";
  }

  /// Calls use(row, file) for each row of a manifest whose format is read here.
  template <class Use>
  static void each(std::string const& tsv, Use const& use) {
    int rows = 0;
    for (std::vector<std::string> const& row : test::manifest(test::shared_models() / tsv)) {
      fs::path const file = test::shared_models() / row[1];
      if (!kReaders.contains(file.extension())) continue;
      SCOPED_TRACE(row[1]);
      use(row, file);
      ++rows;
    }
    EXPECT_GT(rows, 5);
  }

  static SourceModel read(fs::path const& file) {
    return kReaders.at(file.extension())(io::map_file(file), io::resolve_in(file.parent_path()), {});
  }

  /// The same, read once for all tests and kept without its images.
  static SourceModel const& once(fs::path const& file) {
    static std::map<fs::path, SourceModel> models;
    auto const [entry, added] = models.try_emplace(file);
    if (added) {
      entry->second = read(file);
      entry->second.images.clear();
    }
    return entry->second;
  }
};

TEST_F(SharedModels, HaveAsManyTrianglesAsTheirManifestSays) {
  each("MANIFEST.tsv", [](std::vector<std::string> const& row, fs::path const& file) {
    EXPECT_EQ(once(file).mesh.triangles.size(), std::stoul(row[4]));
  });
}

TEST_F(SharedModels, HaveAsManyVerticesAsTheirManifestSaysUnlessCornersDiffer) {
  each("MANIFEST.tsv", [](std::vector<std::string> const& row, fs::path const& file) {
    SourceModel const& model = once(file);
    if (model.uvs.empty())
      EXPECT_EQ(model.mesh.positions.size(), std::stoul(row[3]));
    else
      EXPECT_GE(model.mesh.positions.size(), std::stoul(row[3]));
  });
}

TEST_F(SharedModels, AreColouredWhenTheirManifestSaysSo) {
  each("MANIFEST.tsv", [](std::vector<std::string> const& row, fs::path const& file) {
    EXPECT_EQ(has_colour(once(file)), !row[5].starts_with("none")) << row[5];
  });
}

TEST_F(SharedModels, GiveFinitePositions) {
  each("MANIFEST.tsv", [](std::vector<std::string> const&, fs::path const& file) {
    for (V3f const& p : once(file).mesh.positions)
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  });
}

TEST_F(SharedModels, AreRefusedWhenBrokenWithAReasonAndARemedy) {
  each("broken/MANIFEST.tsv", [](std::vector<std::string> const& row, fs::path const& file) {
    if (row[4] != "reject") return;
    try {
      clean(read(file));
      ADD_FAILURE() << "was read: " << row[5];
    } catch (Error const& error) {
      EXPECT_NE(error.kind(), ErrorKind::broken);
      EXPECT_THAT(std::string(error.what()), Not(IsEmpty()));
      EXPECT_THAT(error.remedy(), Not(IsEmpty()));
    }
  });
}

}  // namespace
}  // namespace vitrine
