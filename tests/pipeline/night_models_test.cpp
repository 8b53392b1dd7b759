// SPDX-License-Identifier: Apache-2.0
// One bad model costs itself alone, whatever it does: crash, hang, eat the memory, lead elsewhere, or bear a name that
// is code.
#include "tests/support/night.h"

#include <sys/stat.h>

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using test::Night;
using test::Outcome;
using test::times;
using testing::HasSubstr;
using testing::Not;

#ifdef VITRINE_FAULTS

struct FaultModel {
  std::string fault, reason;
};

TEST_F(Night, AModelThatTakesTheProgramDownCostsItselfAlone) {
  std::vector<FaultModel> const models = {
      {"segv@load", "SIGSEGV"},          {"abort@survey", "SIGABRT"},   {"overflow@simplify", "SIGSEGV"},
      {"loop@bake", "no progress"},      {"sleep@load", "no progress"}, {"fork@load", "cannot start a process"},
      {"alloc@survey", "out of memory"}, {"leak@load", "memory"},       {"exit@encode", "exit code 0"},
      {"garble@result", "glTF"},         {"close@load", "closed"},      {"throw@pack", "unknown type"}};
  add_good(times(4, 100));
  auto const good = undisturbed();
  std::string faults = "VITRINE_FAULT=";
  for (std::size_t i = 0; i < models.size(); ++i) {
    std::string const name = "x" + std::to_string(i) + ".obj";
    add(name, int(i));
    faults += models[i].fault + "/" + name + ";";
  }
  Outcome const outcome = run(convert("g", {"--stall-limit", "6", "--memory", "700MB"}), {faults});
  EXPECT_EQ(outcome.code, 3) << outcome.output;
  std::map<std::string, std::string> found = reasons("g");
  EXPECT_EQ(found.size(), models.size()) << outcome.output;
  for (std::size_t i = 0; i < models.size(); ++i)
    EXPECT_THAT(found["x" + std::to_string(i) + ".obj"], HasSubstr(models[i].reason)) << models[i].fault;
  auto const all = test::published(at("g"));
  for (auto const& [name, bytes] : good)
    if (name.starts_with("models/")) {
      EXPECT_EQ(all.at(name), bytes) << name;
    }
  EXPECT_THAT(run("why", "g", {"x0.obj"}).output, HasSubstr("quarantined"));
  EXPECT_THAT(test::read_file(at("g") / "report.html"), HasSubstr("landlock"));
  ASSERT_EQ(run("retry", "g", {"--quarantined"}).code, 0) << "without faults";
}

#endif

TEST_F(Night, ReferencesLeadNowhereElse) {
  test::write_file(at("secret.png"), "not for you");
  test::write_file(at("secret.mtl"), "newmtl red\nKd 1 0 0\n");
  std::vector<std::string> const references = {
      "../secret.png",     at("secret.png"), "link.png",       "http://localhost/secret.png",
      "%2e%2e/secret.png", "pipe.png",       "..\\secret.png", "file:secret.png"};
  fs::create_directories(at("archive"));
  fs::create_symlink(at("secret.png"), at("archive") / "link.png");
  ASSERT_EQ(::mkfifo((at("archive") / "pipe.png").c_str(), 0600), 0);
  std::string const shape =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 3/1 "
      "1/2 4/3\n";
  for (std::size_t i = 0; i < references.size(); ++i) {
    std::string const name = "model" + std::to_string(i);
    test::write_file(at("archive") / (name + ".mtl"), "newmtl painted\nmap_Kd " + references[i] + "\n");
    test::write_file(at("archive") / (name + ".obj"), "mtllib " + name + ".mtl\nusemtl painted\n" + shape);
  }
  test::write_file(at("archive/library.obj"), "mtllib ../secret.mtl\nusemtl red\n" + shape);
  fs::create_symlink(at("secret.mtl"), at("archive/outside.ply"));
  ASSERT_EQ(::mkfifo((at("archive") / "pipe.ply").c_str(), 0600), 0);
  Outcome const outcome = run(convert("g"));
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("outside.ply: passed over: the link leads out of the archive"));
  EXPECT_THAT(outcome.output, HasSubstr("pipe.ply: passed over: neither a file nor a folder"));
  nlohmann::json const rows = report("g")["rows"];
  EXPECT_EQ(rows.size(), references.size() + 1);
  EXPECT_THAT(test::read_file(at("g") / "report.html"), HasSubstr("leads out of the model&#39;s folder"));
  for (nlohmann::json const& row : rows) {
    EXPECT_THAT(row["notes"].dump(), testing::AnyOf(HasSubstr("secret"), HasSubstr("link.png"), HasSubstr("pipe.png")))
        << row["input"];
    nlohmann::json const certificate =
        nlohmann::json::parse(test::read_file(at("g") / std::string(row["certificate"])));
    for (nlohmann::json const& file : certificate["input"]["dependencies"])
      if (std::string(file["path"]).find(".mtl") == std::string::npos || row["input"] == "library.obj") {
        EXPECT_TRUE(file["hash"].is_null()) << file["path"] << " was opened";
      }
  }
}

TEST_F(Night, NamesAreData) {
  std::vector<std::string> const names = {"<script>alert(1)<\x1b[31m>",
                                          "\" onload=\"alert(1)",
                                          "=HYPERLINK(1)",
                                          "@SUM(1)",
                                          "+1",
                                          "-1",
                                          "x..%2f..%2fetc",
                                          "new\nline",
                                          "\xff\xfe",
                                          "\x1b]0;title\x07",
                                          "$(touch here)",
                                          std::string(200, 'x')};
  for (std::string const& name : names) {
    add(name + ".obj");
    test::write_file(at("archive") / (name + ".ply"), "no PLY");
  }
  Outcome const outcome = run(convert("g"));
  EXPECT_EQ(outcome.code, 3) << outcome.output;
  EXPECT_THAT(outcome.output, Not(HasSubstr("\x1b")));
  EXPECT_EQ(finished("g").size(), names.size());
  EXPECT_EQ(reasons("g").size(), names.size());
  for (fs::directory_entry const& folder : fs::directory_iterator(at("g") / "models"))
    EXPECT_EQ(folder.path().filename().string().find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
              std::string::npos)
        << folder.path();
  for (char const* page : {"report.html", "index.html"}) {
    std::string const text = test::read_file(at("g") / page);
    EXPECT_THAT(text, Not(HasSubstr("<script>alert"))) << page;
    EXPECT_THAT(text, Not(HasSubstr("\" onload=\"alert"))) << page;
    EXPECT_THAT(text, Not(HasSubstr("\x1b"))) << page;
  }
  EXPECT_THAT(test::read_file(at("g") / "report.html"), HasSubstr("&lt;script&gt;"));
  std::string const table = "\n" + test::read_file(at("g") / "report.csv");
  for (char const* formula : {"\n=", "\n@", "\n+", "\n-", ",=", ",@", ",\"="})
    EXPECT_THAT(table, Not(HasSubstr(formula)));
  for (char const* verb : {"status", "check"}) EXPECT_THAT(run(verb, "g").output, Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace vitrine
