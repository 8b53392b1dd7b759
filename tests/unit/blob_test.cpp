// SPDX-License-Identifier: Apache-2.0
#include "io/blob.h"
#include "stages/error.h"
#include "tests/support/bytes.h"
#include "tests/support/folders.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <string>

namespace vitrine {
namespace {

using io::resolve_in;
using testing::HasSubstr;
namespace fs = std::filesystem;

class BlobTest : public testing::Test {
 protected:
  test::TemporaryFolder outer_;
  fs::path const folder_ = outer_.path() / "model";

  void SetUp() override {
    test::write_file(folder_ / "a.png", "picture");
    test::write_file(outer_.path() / "secret.txt", "secret");
  }
  fs::path add(std::string const& name, std::string const& content) {
    test::write_file(folder_ / name, content);
    return folder_ / name;
  }
  /// What a reference in the model gives: the file's text, or "nothing".
  std::string found(std::string_view reference) const {
    std::optional<io::Blob> const blob = resolve_in(folder_)(reference);
    return blob ? std::string(text(*blob)) : "nothing";
  }
  std::string refusal(std::string_view reference) const {
    return test::refusal([&] { return found(reference); });
  }
};

TEST_F(BlobTest, OwnedBytesLiveAsLongAsACopy) {
  io::Blob copy;
  {
    io::Blob const blob = test::blob("abc");
    copy = blob;
  }
  EXPECT_EQ(text(copy), "abc");
}

TEST_F(BlobTest, MappedFilesOutliveTheirName) {
  io::Blob const blob = io::map_file(folder_ / "a.png");
  fs::remove(folder_ / "a.png");
  EXPECT_EQ(text(blob), "picture");
}

TEST_F(BlobTest, EmptyFilesAreEmptyBlobs) { EXPECT_EQ(text(io::map_file(add("empty", ""))), ""); }

TEST_F(BlobTest, WhatIsNoRegularFileIsRefused) {
  EXPECT_THAT(test::refusal([&] { return io::map_file(folder_); }), HasSubstr("no regular file"));
  EXPECT_THAT(test::refusal([&] { return io::map_file(folder_ / "missing"); }), HasSubstr("No such file"));
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(test::refusal([&] { return io::map_file(folder_ / "pipe"); }), HasSubstr("no regular file"));
}

TEST_F(BlobTest, FindsFilesBesideAndBelowTheModel) {
  add("textures/b.png", "below");
  EXPECT_EQ(found("a.png"), "picture");
  EXPECT_EQ(found("./a.png"), "picture");
  EXPECT_EQ(found("textures/b.png"), "below");
  EXPECT_EQ(found(".\\textures\\b.png"), "below");
  EXPECT_EQ(found("textures/../a.png"), "picture");
}

TEST_F(BlobTest, NothingForWhatIsNotThere) {
  EXPECT_EQ(found("b.png"), "nothing");
  EXPECT_EQ(found(""), "nothing");
  EXPECT_EQ(found("."), "nothing");
  EXPECT_EQ(found("a.png/b.png"), "nothing");
}

TEST_F(BlobTest, EscapesAreTakenLiterallyFirst) {
  add("my map.png", "decoded");
  EXPECT_EQ(found("my%20map.png"), "decoded");
  add("my%20map.png", "literal");
  EXPECT_EQ(found("my%20map.png"), "literal");
}

TEST_F(BlobTest, HalfEscapesStayWhatTheyAre) {
  add("100%.png", "percent");
  EXPECT_EQ(found("100%.png"), "percent");
  EXPECT_EQ(found("100%25.png"), "percent");
  EXPECT_EQ(found("100%zz.png"), "nothing");
}

TEST_F(BlobTest, AnotherCaseIsTakenWhereItIsTheOnlyOne) {
  add("Textures/B.PNG", "other case");
  EXPECT_EQ(found("textures/b.png"), "other case");
  add("Textures/b.Png", "second");
  EXPECT_EQ(found("textures/b.png"), "nothing");
  EXPECT_EQ(found("textures/b.Png"), "second");
}

TEST_F(BlobTest, NamesThatLeadOutAreRefused) {
  EXPECT_THAT(refusal("../secret.txt"), HasSubstr("leads out"));
  EXPECT_THAT(refusal("..\\secret.txt"), HasSubstr("leads out"));
  EXPECT_THAT(refusal("%2e%2e/secret.txt"), HasSubstr("leads out"));
  EXPECT_THAT(refusal("textures/../../secret.txt"), HasSubstr("leads out"));
  EXPECT_THAT(refusal("/etc/passwd"), HasSubstr("absolute"));
  EXPECT_THAT(refusal("C:\\maps\\a.png"), HasSubstr("address"));
  EXPECT_THAT(refusal("https://example.org/a.png"), HasSubstr("address"));
  EXPECT_THAT(refusal(std::string_view("a.png\0b", 7)), HasSubstr("zero byte"));
}

TEST_F(BlobTest, SymbolicLinksMayLeadAboutInsideOnly) {
  fs::create_symlink("a.png", folder_ / "inside.png");
  fs::create_symlink("../secret.txt", folder_ / "outside.png");
  fs::create_symlink("..", folder_ / "up");
  EXPECT_EQ(found("inside.png"), "picture");
  EXPECT_THAT(refusal("outside.png"), HasSubstr("symbolic link"));
  EXPECT_THAT(refusal("up/secret.txt"), HasSubstr("symbolic link"));
  EXPECT_THAT(refusal("UP/Secret.txt"), HasSubstr("symbolic link"));
}

TEST_F(BlobTest, AFolderMayItselfBeReachedByALink) {
  fs::create_directory_symlink(folder_, outer_.path() / "link");
  EXPECT_EQ(text(*resolve_in(outer_.path() / "link")("a.png")), "picture");
}

}  // namespace
}  // namespace vitrine
