// SPDX-License-Identifier: Apache-2.0
// vitrine-sample: an archive of made-up museum objects, for demonstrations, tests and throughput runs.
#include "stages/error.h"
#include "tools/sample/stream.h"
#include "tools/sample/write.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace {

using namespace vitrine::sample;

struct Request {
  std::filesystem::path out = "archive";
  std::string object;
  std::uint64_t triangles = 0;
  std::uint32_t seed = 1;
  int count = 1;
  bool shuffle = false;
};

std::string quoted(std::string_view cell) { return '"' + std::string(cell) + '"'; }

/// Writes one object and gives its row of archive.csv.
std::string make(Request const& request, Object const& object, int repeat) {
  std::uint32_t const seed = hash(request.seed, std::uint32_t(repeat));
  std::string const number = request.count > 1 ? '-' + std::to_string(repeat + 1) : "";
  Scan const scanned = scan(object.parts(seed), request.triangles > 0 ? request.triangles : object.triangles, seed);
  auto const path = write(request.out, object, std::string(object.name) + number, scanned,
                          request.shuffle ? std::optional(seed) : std::nullopt);
  std::cout << path.string() << "  " << scanned.triangles << " triangles\n" << std::flush;
  return path.string() + ',' + quoted(object.title) + ",Vitrine sample archive,CC0-1.0," + (object.z_up ? "z" : "y") +
         '\n';
}

int run(Request const& request) {
  std::string rows = "path,title,credit,licence,up\n";
  for (int repeat = 0; repeat < request.count; ++repeat)
    for (Object const& object : objects())
      if (request.object.empty() || request.object == object.name) rows += make(request, object, repeat);
  create(request.out / "archive.csv") << rows;
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  Request request;
  std::vector<std::string> names;
  for (Object const& object : objects()) names.emplace_back(object.name);

  CLI::App app("Makes an archive of museum-like objects: scans without a scanner.");
  app.add_option("--out", request.out, "folder to write to")->capture_default_str();
  app.add_option("--object", request.object, "this object only")->check(CLI::IsMember(names));
  app.add_option("--triangles", request.triangles, "about so many for each object; 0: its own number")
      ->check(CLI::Range(0, 2'000'000'000));
  app.add_option("--count", request.count, "so many of each, all different")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--seed", request.seed, "other wear, stains and proportions")->capture_default_str();
  app.add_flag("--shuffle", request.shuffle, "vertices and faces of PLY files in random order");
  CLI11_PARSE(app, argc, argv);
  return run(request);
} catch (vitrine::Error const& error) {
  std::cerr << "error: " << error.what() << "; " << error.remedy() << '\n';
  return 1;
} catch (std::exception const& error) {
  std::cerr << "error: " << error.what() << '\n';
  return 1;
}
