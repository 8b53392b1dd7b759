// SPDX-License-Identifier: Apache-2.0
// The arrows between folders: tools -> graph -> stages, io; io -> stages/{data,error,options}.h; never back.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// "file: header" for every include below `folder` that `pattern` matches.
std::vector<std::string> includes(std::string const& folder, std::string const& pattern) {
  std::regex const include("#include [\"<](" + pattern + ")[\">]");
  std::vector<std::string> found;
  for (fs::directory_entry const& entry : fs::recursive_directory_iterator(fs::path(VITRINE_SOURCE_DIR) / folder)) {
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);)
      if (std::regex_search(line, match, include))
        found.push_back(entry.path().filename().string() + ": " + match[1].str());
  }
  return found;
}

TEST(Layout, StagesKnowNoBytesNoOrderNoFilesAndNoClock) {
  EXPECT_THAT(includes("stages", "(io|graph|tools)/.*|fstream|filesystem|chrono|nlohmann/.*|CLI/.*"),
              testing::IsEmpty());
}

TEST(Layout, TbbEntersStagesThroughOneHeader) {
  EXPECT_THAT(includes("stages", "(oneapi|tbb)/.*"), testing::Each(testing::StartsWith("parallel.h: ")));
}

TEST(Layout, IoKnowsOnlyTheTypesOfStages) {
  EXPECT_THAT(includes("io", "(graph|tools)/.*|stages/(?!data\\.h|error\\.h|options\\.h).*"), testing::IsEmpty());
}

TEST(Layout, GraphKnowsNoTools) { EXPECT_THAT(includes("graph", "tools/.*"), testing::IsEmpty()); }

TEST(Layout, ThisCheckSeesIncludes) {
  EXPECT_THAT(includes("io", "stages/data\\.h"), testing::Not(testing::IsEmpty()));
}

}  // namespace
