// SPDX-License-Identifier: Apache-2.0
#include "graph/trace.h"

#include "graph/report.h"
#include "tests/support/folders.h"
#include "tests/support/meshes.h"
#include "tests/support/rows.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace vitrine::graph {
namespace {

using Track = std::pair<int, int>;
struct Slice {
  std::string name;
  std::int64_t begin, end;
};

/// Whether slices lie within one another or apart; sorted from the outermost.
bool is_nested(std::vector<Slice> slices) {
  std::sort(slices.begin(), slices.end(),
            [](Slice const& a, Slice const& b) { return std::tuple(a.begin, -a.end) < std::tuple(b.begin, -b.end); });
  std::vector<std::int64_t> open;
  for (Slice const& s : slices) {
    while (!open.empty() && open.back() <= s.begin) open.pop_back();
    if (!open.empty() && open.back() < s.end) return false;
    open.push_back(s.end);
  }
  return true;
}

/// One sound model and one that is none, traced.
nlohmann::json traced(test::TemporaryFolder const& folder, std::vector<ModelRow>& rows,
                      Occupancy* occupancy = nullptr) {
  test::write_file(folder.path() / "archive/torus.obj", test::obj_text(test::plain_model(test::torus())));
  test::write_file(folder.path() / "archive/empty.ply", "");
  ModelOptions options;
  options.simplify.triangles = 200;
  options.pack.texture = 64;
  options.publish.certificate = false;
  RunOptions run{2, 0, folder.path() / "gallery"};
  run.trace = folder.path() / "trace.json";
  if (occupancy) run.occupied = [=](Occupancy const& part) { *occupancy += part; };
  rows = test::converted(io::read_archive(folder.path() / "archive"), options, run);
  return nlohmann::json::parse(test::read_file(run.trace));
}

TEST(Trace, HoldsEveryModelWithItsStagesInside) {
  test::TemporaryFolder const folder;
  std::vector<ModelRow> rows;
  nlohmann::json const trace = traced(folder, rows);
  std::map<Track, std::vector<Slice>> tracks;
  std::set<std::string> counters;
  for (nlohmann::json const& event : trace["traceEvents"]) {
    if (event["ph"] == "C") counters.insert(event["name"]);
    if (event["ph"] != "X") continue;
    std::int64_t const begin = event["ts"];
    tracks[{event["pid"], event["tid"]}].push_back({event["name"], begin, begin + event["dur"].get<std::int64_t>()});
  }
  for (auto const& [track, slices] : tracks) EXPECT_TRUE(is_nested(slices)) << track.first << ' ' << track.second;
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<Slice> const& slices = tracks[{2, int(i) + 1}];
    std::set<std::string> names;
    for (Slice const& s : slices) names.insert(s.name);
    EXPECT_TRUE(names.contains(rows[i].input));
    for (auto const& [stage, seconds] : rows[i].seconds) EXPECT_TRUE(names.contains(stage)) << stage;
  }
  EXPECT_THAT(counters, testing::ElementsAre("memory admitted", "memory used", "models under way"));
}

TEST(Trace, SlicesThatCrossAreNotNested) {
  EXPECT_TRUE(is_nested({{"a", 0, 10}, {"b", 0, 5}, {"c", 5, 10}}));
  EXPECT_FALSE(is_nested({{"a", 0, 10}, {"b", 5, 15}}));
}

TEST(Trace, TheReportSaysHowLongModelsWaited) {
  test::TemporaryFolder const folder;
  std::vector<ModelRow> rows;
  (void)traced(folder, rows);
  nlohmann::json const stages = report_json(rows, "/archive", {}, 1)["stages"];
  ASSERT_FALSE(stages.empty());
  for (nlohmann::json const& stage : stages) EXPECT_GE(stage["waiting"].get<double>(), 0);
  for (nlohmann::json const& stage : stages) EXPECT_GT(stage["peakMemory"].get<std::uint64_t>(), 1'000'000u);
}

TEST(Trace, WhatTheCoresDidAddsUp) {
  test::TemporaryFolder const folder;
  std::vector<ModelRow> rows;
  Occupancy o;
  (void)traced(folder, rows, &o);
  EXPECT_NEAR(o.computed + o.taken + o.memory + o.reading + o.writing + o.ending + o.within, o.available, 1e-9);
  EXPECT_GT(o.computed, 0);
  EXPECT_NE(bound(o), Bound::nothing);
  EXPECT_LE(o.most_admitted, o.allowed);
}

}  // namespace
}  // namespace vitrine::graph
