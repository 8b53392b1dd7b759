// SPDX-License-Identifier: Apache-2.0
// The program: parse, run, print, exit. Each verb is a function that describes itself to the parser and returns what
// runs it.
#include "stages/error.h"
#include "tools/command_line.h"
#include "tools/command_memory.h"
#include "tools/convert.h"
#include "tools/evaluate.h"
#include "tools/model_flags.h"
#include "tools/night.h"
#include "tools/report/report.h"
#include "tools/series.h"
#include "tools/serve.h"

#include <fmt/format.h>
#include <malloc.h>

#include <functional>
#include <memory>

namespace {

using namespace vitrine;
using Verb = std::function<int()>;

/// How models are understood where they are ambiguous.
void add_reading(CLI::App& app, io::UpAxis& up, io::MtlKd& mtl_kd, std::string const& up_help) {
  std::map<std::string, io::UpAxis> const axes{{"y", io::UpAxis::y}, {"z", io::UpAxis::z}};
  app.add_option("--up", up, up_help)
      ->transform(CLI::CheckedTransformer(axes).description(""))
      ->type_name("y|z")
      ->default_str("y");
  std::map<std::string, io::MtlKd> const kd{{"ignore", io::MtlKd::ignore}, {"multiply", io::MtlKd::multiply}};
  app.add_option("--mtl-kd", mtl_kd, "what the Kd beside a map_Kd of an MTL file does")
      ->transform(CLI::CheckedTransformer(kd).description(""))
      ->type_name("ignore|multiply")
      ->default_str("ignore");
}

/// How a run uses the machine.
void add_machine(CLI::App& app, graph::RunOptions& run) {
  app.add_option("--threads", run.threads, "0: all cores")->check(CLI::Range(0, 1024))->type_name("N");
  app.add_option("--memory", run.memory, "that the program may take (default: 80 % of what is free)")
      ->transform(CLI::AsSizeValue(true))
      ->type_name("SIZE");
}

/// How a run goes on where another ended, and when it ends.
void add_night(CLI::App& app, tools::ConvertCommand& command) {
  app.add_flag("--dry-run", command.dry_run, "say what would be done, how long it may take, and write nothing")
      ->group("Night");
  app.add_flag("--verify", command.verify,
               "hash every original and every thumbnail again, instead of trusting the file system's times of change")
      ->group("Night");
  std::map<std::string, graph::Retry> const retries{{"failed", graph::Retry::failed},
                                                    {"quarantined", graph::Retry::quarantined}};
  app.add_option("--retry", command.retry,
                 "try failures again though nothing has changed; quarantined: those models, too")
      ->transform(CLI::CheckedTransformer(retries).description(""))
      ->type_name("failed|quarantined")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeFirst)
      ->default_str("")
      ->group("Night");
  app.add_flag("--prune", command.prune, "remove thumbnails of models that are no longer in the archive")
      ->group("Night");
  app.add_option("--stop-at", command.stop_at, "begin no model after this time of day; the same command goes on later")
      ->check(CLI::Validator(tools::check_time, "", ""))
      ->type_name("HH:MM")
      ->group("Night");
  app.add_option("--stall-limit", command.stall_limit,
                 "a model that stays in one stage for longer hangs (default: by its size, 300 or more)")
      ->check(CLI::Range(0.0, 1e6).description(""))
      ->type_name("SECONDS")
      ->default_str("")
      ->group("Night");
  app.add_option("--log", command.log, "append everything that happens, as lines of JSON")
      ->type_name("FILE")
      ->group("Night");
}

Verb convert_verb(CLI::App& app) {
  auto command = std::make_shared<tools::ConvertCommand>();
  app.add_option("archive", command->archive, "folder of scans, searched in depth")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--out", command->run.gallery, "folder of the gallery, made if missing")->required();
  add_reading(app, command->reading.up, command->model.read.mtl_kd,
              "axis that points up in models for which archive.csv says nothing");
  app.add_option("--include", command->reading.include,
                 "convert only paths that match (`*`, `**`, `?`); may be repeated")
      ->type_name("GLOB");
  app.add_option("--exclude", command->reading.exclude, "pass over paths that match; may be repeated")
      ->type_name("GLOB");
  add_machine(app, command->run);
  add_night(app, *command);
  app.add_option("--trace", command->run.trace, "write what each thread and model did when, for ui.perfetto.dev")
      ->type_name("FILE.json");
  tools::add_model_flags(app, command->model);
  return [command] { return tools::convert(*command); };
}

CLI::Option* add_gallery(CLI::App& app, std::filesystem::path& gallery) {
  return app.add_option("gallery", gallery, "folder that convert made")->required()->check(CLI::ExistingDirectory);
}

Verb status_verb(CLI::App& app) {
  auto gallery = std::make_shared<std::filesystem::path>();
  add_gallery(app, *gallery);
  return [gallery] { return tools::status(*gallery); };
}

Verb why_verb(CLI::App& app) {
  auto gallery = std::make_shared<std::filesystem::path>();
  auto model = std::make_shared<std::string>();
  add_gallery(app, *gallery);
  app.add_option("model", *model, "its path in the archive, or a part of it that no other has")->required();
  return [gallery, model] { return tools::why(*gallery, *model); };
}

Verb retry_verb(CLI::App& app) {
  auto gallery = std::make_shared<std::filesystem::path>();
  auto quarantined = std::make_shared<bool>(false);
  add_gallery(app, *gallery);
  app.add_flag("--quarantined", *quarantined, "also models that took the program down");
  return [gallery, quarantined] { return tools::retry(*gallery, *quarantined); };
}

Verb check_verb(CLI::App& app) {
  auto gallery = std::make_shared<std::filesystem::path>();
  add_gallery(app, *gallery);
  return [gallery] { return tools::check(*gallery); };
}

Verb serve_verb(CLI::App& app) {
  struct Command {
    std::filesystem::path gallery;
    std::string host = "127.0.0.1";
    int port = 8000;
  };
  auto command = std::make_shared<Command>();
  app.add_option("gallery", command->gallery, "folder that convert made")->required()->check(CLI::ExistingDirectory);
  app.add_option("--host", command->host, "address to listen on")->capture_default_str();
  app.add_option("--port", command->port, "0: any free port")->check(CLI::Range(0, 65535))->capture_default_str();
  return [command] { return tools::serve(command->gallery, command->host, command->port); };
}

Verb evaluate_verb(CLI::App& app) {
  auto command = std::make_shared<tools::EvaluateCommand>();
  app.add_option("original", command->original, "the model")->required()->check(CLI::ExistingFile);
  app.add_option("thumbnail", command->thumbnail, "any tool's GLB of it")->required()->check(CLI::ExistingFile);
  add_reading(app, command->up, command->read.mtl_kd, "axis that points up in the original");
  app.add_flag("--json", command->json, "print everything, with each view's figures and camera, as JSON");
  app.add_option("--sheet", command->sheet, "write all views side by side: original, thumbnail, squared difference x 8")
      ->type_name("FILE.png");
  command->measure.fields(command->measure, tools::AddFlags(app, "Measure"));
  return [command] { return tools::evaluate(*command); };
}

Verb report_verb(CLI::App& app) {
  auto command = std::make_shared<report::ReportCommand>();
  app.add_option("gallery", command->gallery, "folder that convert made")->required()->check(CLI::ExistingDirectory);
  app.add_option("--textures", command->textures, "sizes to make thumbnails at with the paper's choices")
      ->delimiter(',')
      ->check(CLI::Range(16, 8192).description(""))
      ->type_name("TEXELS,...")
      ->capture_default_str();
  app.add_flag("--ablation", command->ablation,
               "convert once more without each choice of the search, and tell what that costs");
  app.add_option("--archive", command->archive, "where the originals are, if they have moved since")
      ->check(CLI::ExistingDirectory);
  add_machine(app, command->run);
  return [command] { return report::report(*command); };
}

Verb series_verb(CLI::App& app) {
  auto command = std::make_shared<tools::SeriesCommand>();
  auto preset = std::make_shared<int>(0);
  CLI::Option* original = app.add_option("original", command->original, "the model to draw")->check(CLI::ExistingFile);
  app.add_option("--from", command->pictures, "or a folder of pictures, photographs say, in the order of their names")
      ->check(CLI::ExistingDirectory)
      ->type_name("FOLDER")
      ->excludes(original);
  app.add_option("--out", command->out, "folder of the series, made if missing")->required()->type_name("FOLDER");
  std::map<std::string, int> const presets{{"paper-8", 8}, {"paper-16", 16}, {"paper-32", 32}};
  app.add_option("--preset", *preset, "the paper's series: JPEG of quality 90, 200 pixels, so many frames")
      ->transform(CLI::CheckedTransformer(presets).description(""))
      ->type_name("paper-8|paper-16|paper-32");
  add_reading(app, command->up, command->read.mtl_kd, "axis that points up in the model");
  app.add_flag("--json", command->json, "print series.json instead of a summary");
  command->series.fields(command->series, tools::AddFlags(app, "Series"));
  MeasureOptions::fields(command->measure, [&](auto& value, Field const& field) {
    if (field.flag == "size" || field.flag == "light" || field.flag == "supersample")
      tools::AddFlags(app, "Pictures")(value, field);
  });
  app.parse_complete_callback([command] {
    if (command->original.empty() && command->pictures.empty()) throw CLI::RequiredError("original or --from");
  });
  return [command, preset, &app] {
    auto const given = [&](char const* flag) { return app.get_option(flag)->count() > 0; };
    command->all_pictures = *preset == 0 && !given("--frames");
    if (*preset > 0) tools::take_paper_series(*command, *preset, given);
    return tools::series(*command);
  };
}

constexpr struct {
  char const* name;
  char const* help;
  Verb (*make)(CLI::App&);
} kVerbs[] = {
    {"convert", "turn every model below a folder into a 3D thumbnail", convert_verb},
    {"status", "how far a gallery's run is, or how it ended", status_verb},
    {"why", "what became of one model, and why", why_verb},
    {"retry", "run a gallery's last command again, with its failures", retry_verb},
    {"check", "compare every published file with what was published", check_verb},
    {"evaluate", "measure a thumbnail against its original", evaluate_verb},
    {"report", "write the paper's tables and figures for a gallery's models", report_verb},
    {"serve", "show a gallery on localhost", serve_verb},
    {"series", "make the rival of a thumbnail: pictures from all sides", series_verb},
};

/// Large arrays go back to the system when a model is done, so that memory returns to its base. Small ones come from a
/// reserve: pages that go back and forth would cost a twentieth of a small model.
void keep_memory_flat() {
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  mallopt(M_TRIM_THRESHOLD, 16 << 20);
  mallopt(M_TOP_PAD, 32 << 20);
}

}  // namespace

int main(int argc, char** argv) try {
  constexpr int kFatal = 1, kUsage = 2;
  keep_memory_flat();
  CLI::App app("Vitrine turns archives of 3D scans into 3D thumbnails of a few kilobytes each.");
  app.set_version_flag("--version", VITRINE_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  Verb chosen;
  for (auto const& verb : kVerbs) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.help);
    sub->callback([&chosen, run = verb.make(*sub)] { chosen = run; });
  }
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& e) {
    return app.exit(e) == 0 ? 0 : kUsage;
  }
  try {
    return chosen();
  } catch (Error const& e) {
    fmt::print(stderr, "error: {}; {}\n", e.what(), e.remedy());
    return kFatal;
  }
} catch (std::exception const& e) {
  fmt::print(stderr, "error: {}\n", e.what());
  return 1;
}
