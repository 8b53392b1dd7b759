// SPDX-License-Identifier: Apache-2.0
#include "io/publish.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace vitrine::io {
namespace {

namespace fs = std::filesystem;

class Publish : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  static std::string content(fs::path const& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (fs::directory_entry const& entry : fs::recursive_directory_iterator(folder))
      if (!entry.is_directory()) all.push_back(entry.path().filename());
    return all;
  }

  fs::path const folder = fs::path(testing::TempDir()) / "vitrine-publish";
};

TEST_F(Publish, WritesBytesAsTheyAre) {
  std::string const bytes("a\0b\r\n", 5);
  publish_file(folder / "x", bytes);
  EXPECT_EQ(content(folder / "x"), bytes);
  publish_file(folder / "empty", "");
  EXPECT_EQ(fs::file_size(folder / "empty"), 0u);
}

TEST_F(Publish, MakesTheFolder) {
  publish_file(folder / "models/lucy/thumb.glb", "glTF");
  EXPECT_EQ(content(folder / "models/lucy/thumb.glb"), "glTF");
}

TEST_F(Publish, ReplacesAndLeavesNothingAside) {
  publish_file(folder / "x", "a longer old file");
  publish_file(folder / "x", "new");
  EXPECT_EQ(content(folder / "x"), "new");
  EXPECT_THAT(names(), testing::ElementsAre("x"));
}

TEST_F(Publish, LetsOthersReadIt) {
  mode_t const mask = umask(022);
  publish_file(folder / "x", "for the web server");
  umask(mask);
  EXPECT_EQ(fs::status(folder / "x").permissions(), fs::perms(0644));
}

TEST_F(Publish, TakesNamesAsLongAsFileSystemsAllow) {
  std::string const name(255, 'n');
  publish_file(folder / name, "x");
  EXPECT_THAT(names(), testing::ElementsAre(name));
}

TEST_F(Publish, AFullDiskLeavesTheOldFileAndNothingAside) {
  publish_file(folder / "x", "old");
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  rlimit const tiny{100, old_limit.rlim_max};
  auto const old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &tiny);
  std::error_code reason;
  try {
    publish_file(folder / "x", std::string(1000, 'n'));
  } catch (fs::filesystem_error const& error) {
    reason = error.code();
  }
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(reason, std::errc::file_too_large);
  EXPECT_EQ(content(folder / "x"), "old");
  EXPECT_THAT(names(), testing::ElementsAre("x"));
}

TEST_F(Publish, NamesThePathThatFailed) {
  fs::create_directories(folder / "taken");
  publish_file(folder / "file", "x");
  for (fs::path const& path : {folder / "taken", folder / "file/below"}) try {
      publish_file(path, "x");
      ADD_FAILURE() << path;
    } catch (fs::filesystem_error const& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(path == folder / "taken" ? "taken" : "file"));
    }
  EXPECT_THAT(names(), testing::ElementsAre("file"));
}

TEST_F(Publish, ThreadsDoNotMeet) {
  std::vector<std::jthread> threads;
  for (char c : {'a', 'b', 'c', 'd'})
    threads.emplace_back([this, c] {
      for (int i = 0; i < 20; ++i) publish_file(folder / "x", std::string(5000, c));
    });
  threads.clear();
  std::string const last = content(folder / "x");
  EXPECT_EQ(last, std::string(5000, last.at(0)));
  EXPECT_THAT(names(), testing::ElementsAre("x"));
}

TEST_F(Publish, SweepsOnlyWhatWasLeftAside) {
  publish_file(folder / "models/a/thumb.glb", "x");
  std::ofstream(folder / "models/a/.123-4.vitrine-unfinished") << "half";
  std::ofstream(folder / ".hidden") << "of the user";
  sweep_unfinished(folder);
  EXPECT_THAT(names(), testing::UnorderedElementsAre("thumb.glb", ".hidden"));
}

TEST_F(Publish, SweepsNoFoldersThatAreNotThere) { EXPECT_NO_THROW(sweep_unfinished(folder / "none")); }

}  // namespace
}  // namespace vitrine::io
