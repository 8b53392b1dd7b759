// SPDX-License-Identifier: Apache-2.0
#include "io/archive.h"
#include "io/csv.h"
#include "io/glob.h"
#include "io/read_model.h"
#include "tests/support/folders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <vector>

using namespace vitrine;
using namespace vitrine::io;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Pair;
using testing::SizeIs;

namespace fs = std::filesystem;

namespace {

class ArchiveFolder : public testing::Test {
 protected:
  void put(std::string const& path, std::string_view content = "x") const { test::write_file(root() / path, content); }
  fs::path root() const { return folder_.path() / "archive"; }
  fs::path outside() const { return folder_.path() / "outside"; }

  Archive read(ArchiveOptions const& options = {}) const {
    fs::create_directories(root());
    return read_archive(root(), options);
  }
  std::vector<std::string> paths(ArchiveOptions const& options = {}) const {
    std::vector<std::string> result;
    for (ArchiveEntry const& entry : read(options).entries) result.push_back(entry.path);
    return result;
  }
  std::string failure() const {
    try {
      read();
    } catch (Error const& error) {
      return error.what();
    }
    return "no failure";
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(ArchiveFolder, HoldsModelsOfAllFormatsSortedByPath) {
  for (char const* path : {"b.ply", "a/z.obj", "a/z.mtl", "a/t.png", "B.STL", "c.off", "d.glb", "e.gltf", "readme.txt"})
    put(path);
  EXPECT_THAT(paths(), ElementsAre("B.STL", "a/z.obj", "b.ply", "c.off", "d.glb", "e.gltf"));
}

TEST_F(ArchiveFolder, PassesOverHiddenThingsAndGalleries) {
  for (char const* path :
       {".hidden.ply", ".git/a.ply", "gallery/.vitrine/ledger", "gallery/models/x/thumb.glb", "seen.ply"})
    put(path);
  EXPECT_THAT(paths(), ElementsAre("seen.ply"));
}

TEST_F(ArchiveFolder, ChoosesByPatterns) {
  for (char const* path : {"a.ply", "raw/b.ply", "raw/old/c.ply"}) put(path);
  EXPECT_THAT(paths({UpAxis::y, {"raw/*"}, {}}), ElementsAre("raw/b.ply"));
  EXPECT_THAT(paths({UpAxis::y, {}, {"raw/**"}}), ElementsAre("a.ply"));
  EXPECT_THAT(paths({UpAxis::y, {"**/*.ply"}, {"**/old/*"}}), ElementsAre("a.ply", "raw/b.ply"));
}

TEST_F(ArchiveFolder, NeverFollowsLinksOutOfTheRoot) {
  put("real.ply");
  test::write_file(outside() / "secret.ply", "x");
  fs::create_symlink(outside() / "secret.ply", root() / "file.ply");
  fs::create_directory_symlink(outside(), root() / "folder");
  fs::create_symlink("nowhere", root() / "dangling.ply");
  EXPECT_THAT(paths(), ElementsAre("real.ply"));
  EXPECT_THAT(read().notes, ElementsAre(HasSubstr("nowhere"), HasSubstr("leads out"), HasSubstr("leads out")));
}

TEST_F(ArchiveFolder, TakesLinksToFilesInsideAndNoLoops) {
  put("a/real.ply");
  fs::create_symlink("a/real.ply", root() / "again.ply");
  fs::create_directory_symlink(root(), root() / "a" / "loop");
  EXPECT_THAT(paths(), ElementsAre("a/real.ply", "again.ply"));
  EXPECT_THAT(read().notes, ElementsAre(HasSubstr("a/loop")));
}

TEST_F(ArchiveFolder, NotesSpecialFiles) {
  put("a.ply");
  ASSERT_EQ(mkfifo((root() / "pipe.ply").c_str(), 0600), 0);
  EXPECT_THAT(paths(), ElementsAre("a.ply"));
  EXPECT_THAT(read().notes, ElementsAre(HasSubstr("pipe.ply")));
}

TEST_F(ArchiveFolder, SlugsArePlainShortAndStable) {
  put("Büsten/Kopf der <Königin>.ply");
  put("other/Kopf.ply");
  put(std::string(100, 'x') + "/" + std::string(100, 'y') + ".ply");
  for (ArchiveEntry const& entry : read().entries) {
    EXPECT_THAT(entry.slug, MatchesRegex("[a-z0-9]([a-z0-9-]*[a-z0-9])?-[0-9a-f]{8}"));
    EXPECT_LE(entry.slug.size(), 69u);
  }
  EXPECT_THAT(read().entries[0].slug, testing::StartsWith("b-sten-kopf-der-k-nigin-"));
}

TEST_F(ArchiveFolder, TheCatalogueGivesMetadataAndUpAxes) {
  put("a.ply");
  put("b/c.ply");
  put("archive.csv",
      "\xEF\xBB\xBFPath,title,up,credit\r\na.ply,\"Head, \"\"young\"\"\",z,\r\nb\\c.ply,Bowl,,Museum\r\n");
  std::vector<ArchiveEntry> const entries = read().entries;
  EXPECT_EQ(entries[0].up, UpAxis::z);
  EXPECT_THAT(entries[0].metadata, ElementsAre(Pair("title", "Head, \"young\"")));
  EXPECT_EQ(entries[1].up, UpAxis::y);
  EXPECT_THAT(entries[1].metadata, ElementsAre(Pair("credit", "Museum"), Pair("title", "Bowl")));
}

TEST_F(ArchiveFolder, TheCommandLineGivesTheUpAxisOfTheRest) {
  put("a.ply");
  put("b.ply");
  put("archive.csv", "path,up\na.ply,y\n");
  std::vector<ArchiveEntry> const entries = read({UpAxis::z, {}, {}}).entries;
  EXPECT_EQ(entries[0].up, UpAxis::y);
  EXPECT_EQ(entries[1].up, UpAxis::z);
}

TEST_F(ArchiveFolder, RowsWithoutAModelAreNoted) {
  put("archive.csv", "path\ngone.ply\n");
  EXPECT_THAT(read().notes, ElementsAre(HasSubstr("line 2: no model at \"gone.ply\"")));
}

TEST_F(ArchiveFolder, AMalformedCatalogueIsAnErrorWithItsLine) {
  put("a.ply");
  put("archive.csv", "path,title\na.ply,\"open\n");
  EXPECT_THAT(failure(), HasSubstr("archive.csv line 2: a quote is not closed"));
  put("archive.csv", "path,title\n\"a\nb\",c\na.ply,x,y\n");
  EXPECT_THAT(failure(), HasSubstr("line 4: 3 cells under 2 headings"));
  put("archive.csv", "title\nx\n");
  EXPECT_THAT(failure(), HasSubstr("no column is named path"));
  put("archive.csv", "path,up\na.ply,sideways\n");
  EXPECT_THAT(failure(), HasSubstr("line 2: up is \"sideways\""));
}

TEST(ReadArchive, NeedsAFolder) { EXPECT_THROW(read_archive("/nonexistent/archive"), Error); }

TEST(Csv, QuotedCellsHoldCommasLinesAndQuotes) {
  std::vector<CsvRow> const rows = parse_csv("a,\"b,\"\"c\"\"\nd\"\r\n\n,e");
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_THAT(rows[0].cells, ElementsAre("a", "b,\"c\"\nd"));
  EXPECT_THAT(rows[1].cells, ElementsAre("", "e"));
  EXPECT_EQ(rows[1].line, 4u);
}

TEST(Csv, TextAfterAClosingQuoteIsAnError) { EXPECT_THROW(parse_csv("\"a\"b,c\n"), Error); }

TEST(Glob, StarsStayInAFolderAndDoubleStarsDoNot) {
  EXPECT_TRUE(matches_glob("*.ply", "a.ply"));
  EXPECT_FALSE(matches_glob("*.ply", "b/a.ply"));
  EXPECT_TRUE(matches_glob("**.ply", "b/c/a.ply"));
  EXPECT_TRUE(matches_glob("**/a.ply", "a.ply"));
  EXPECT_TRUE(matches_glob("**/a.ply", "b/c/a.ply"));
  EXPECT_FALSE(matches_glob("**/a.ply", "b/ba.ply"));
  EXPECT_TRUE(matches_glob("b/**/a.???", "b/a.ply"));
  EXPECT_FALSE(matches_glob("?", "/"));
  EXPECT_FALSE(matches_glob("a", "ab"));
}

TEST(Glob, ManyStarsTakeNoTime) {
  EXPECT_FALSE(matches_glob("**a**a**a**a**a**a**a**a**a**b", std::string(2000, 'a')));
}

Estimate estimate_of(std::string const& name, std::string_view content) {
  test::TemporaryFolder const folder;
  test::write_file(folder.path() / name, content);
  return estimate({name, folder.path() / name, content.size(), "", UpAxis::y, {}});
}

TEST(Estimate, AFileIsCountedFromItsHeader) {
  EXPECT_EQ(estimate_of("a.ply",
                        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nelement face 7\nproperty list "
                        "uchar int vertex_indices\nend_header\n")
                .triangles,
            7u);
  EXPECT_EQ(estimate_of("a.off", "OFF\n# a comment\n8 12 0\n" + std::string(200, '0')).triangles, 12u);
  EXPECT_EQ(estimate_of("a.OFF", "OFF 8 12 0\n" + std::string(200, '0')).triangles, 12u);
  EXPECT_EQ(estimate_of("a.stl", std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(100, '\0')).triangles,
            2u);
  EXPECT_EQ(estimate_of("a.obj", "v 0 0 0\nf 1 1 1\nf 1 1 1 1\n").triangles, 3u);
  EXPECT_EQ(
      estimate_of(
          "a.gltf",
          R"({"nodes":[{"mesh":0},{"mesh":0}],"meshes":[{"primitives":[{"attributes":{},"indices":0}]}],"accessors":[{"count":30}]})")
          .triangles,
      20u);
}

TEST(Estimate, AClaimIsBelievedOnlyAsFarAsThereAreBytes) {
  EXPECT_LT(estimate_of("a.off", "OFF\n8 999999999999 0\n").triangles, 10u);
  EXPECT_LT(estimate_of("a.stl", std::string(80, ' ') + "\xFF\xFF\xFF\xFF" + std::string(100, '\0')).triangles, 10u);
}

TEST(Estimate, ADamagedFileFallsBackOnItsSize) {
  for (char const* name : {"a.ply", "a.obj", "a.stl", "a.off", "a.glb", "a.gltf"}) {
    EXPECT_GT(estimate_of(name, "").memory, 0u) << name;
    EXPECT_LT(estimate_of(name, std::string(1000, '\xFF')).memory, 60'000'000u) << name;
  }
}

TEST(Estimate, ASharedModelIsNearTheTruth) {
  if (test::shared_models().empty()) GTEST_SKIP() << "no shared models beside the repository";
  for (std::vector<std::string> const& row : test::manifest(test::shared_models() / "MANIFEST.tsv")) {
    fs::path const file = test::shared_models() / row[1];
    double const truth = std::stod(row[4]);
    Estimate const found = estimate({row[1], file, fs::file_size(file), "", UpAxis::y, {}});
    EXPECT_GT(static_cast<double>(found.triangles), 0.8 * truth) << row[1];
    EXPECT_LT(static_cast<double>(found.triangles), 3 * truth) << row[1];
  }
}

}  // namespace
