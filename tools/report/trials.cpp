// SPDX-License-Identifier: Apache-2.0
#include "tools/report/trials.h"

#include "graph/certificate.h"
#include "graph/options_json.h"
#include "graph/progress.h"
#include "stages/error.h"
#include "tools/printable.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>

namespace vitrine::report {
namespace {

namespace fs = std::filesystem;

fs::path trial_folder(Gallery const& gallery, Setting const& setting) {
  return gallery.folder / ".vitrine" / "report" / setting.name;
}

/// Whether a certificate is about this input, these options and this program.
bool answers(Json const& certificate, Setting const& setting, Model const& model) {
  return certificate.at("input") == model.certificate.at("input") &&
         certificate.at("program") == Json(graph::program_json()) &&
         certificate.at("options") == Json(graph::options_json(setting.options));
}

/// What there is already: the gallery's own thumbnail where it was made so, or what an earlier run left.
std::optional<Thumbnail> kept(Gallery const& gallery, Setting const& setting, Model const& model) try {
  if (answers(model.certificate, setting, model)) return model.thumbnail;
  fs::path const file = trial_folder(gallery, setting) / "models" / model.slug / "certificate.json";
  if (!fs::exists(file)) return {};
  Json const found = read_json(file);
  return answers(found, setting, model) ? std::optional(read_thumbnail(found)) : std::nullopt;
} catch (Error const&) {
  return {};  // damaged: made again
} catch (nlohmann::json::exception const&) {
  return {};
}

double cost(io::ArchiveEntry const& entry) { return 3e5 + double(entry.estimate.triangles); }

/// What of a trial there is, and what is to be made.
struct Plan {
  Trial trial;
  io::Archive archive;              ///< of what is to be made
  std::vector<std::size_t> models;  ///< for each entry, its model
};

Plan plan(Gallery const& gallery, io::Archive const& archive, Setting const& setting) {
  Plan out{{setting, {}}, {}, {}};
  for (std::size_t m = 0; m < gallery.models.size(); ++m) {
    out.trial.thumbnails.push_back(kept(gallery, setting, gallery.models[m]));
    if (out.trial.thumbnails[m]) continue;
    out.archive.entries.push_back(archive.entries[m]);
    out.models.push_back(m);
  }
  return out;
}

void run(Plan& todo, Gallery const& gallery, graph::RunOptions machine, graph::Progress& progress) {
  if (todo.models.empty()) return;
  Setting const& setting = todo.trial.setting;
  machine.gallery = trial_folder(gallery, setting);
  graph::run_pipeline(todo.archive, setting.options, machine, [&](graph::ModelRow const& row, std::size_t entry) {
    Model const& model = gallery.models[todo.models[entry]];
    auto& made = todo.trial.thumbnails[todo.models[entry]];
    if (row.status == "done") made = kept(gallery, setting, model);
    progress.finished(cost(todo.archive.entries[entry]), !made);
    if (row.status != "done")
      progress.say(tools::printable(setting.name + ": " + graph::describe(row)));
    else if (!made)
      progress.say(tools::printable("error: " + model.input +
                                    ": changed since the gallery was made; run vitrine convert again"));
  });
}

}  // namespace

io::Archive originals(Gallery const& gallery) {
  io::Archive const all = io::read_archive(gallery.archive);
  std::map<std::string, io::ArchiveEntry const*> by_slug;  // paths lose in JSON what is no UTF-8
  for (io::ArchiveEntry const& entry : all.entries) by_slug[entry.slug] = &entry;
  io::Archive out;
  for (Model const& model : gallery.models) {
    auto const found = by_slug.find(model.slug);
    if (found == by_slug.end())
      throw Error(ErrorKind::invalid_input,
                  "the original " + model.input + " is no longer in " + gallery.archive.string(),
                  "put it back, say --archive DIR where the originals are, or run vitrine convert again");
    out.entries.push_back(*found->second);
    out.entries.back().up = model.up == "z" ? io::UpAxis::z : io::UpAxis::y;
  }
  return out;
}

std::vector<Trial> run_trials(Gallery const& gallery, io::Archive const& archive, std::vector<Setting> const& settings,
                              graph::RunOptions const& machine) {
  std::vector<Plan> plans;
  std::size_t count = 0;
  double total = 0;
  for (Setting const& setting : settings) {
    plans.push_back(plan(gallery, archive, setting));
    count += plans.back().models.size();
    for (io::ArchiveEntry const& entry : plans.back().archive.entries) total += cost(entry);
  }
  std::vector<Trial> trials;
  {
    graph::Progress progress(count, total, isatty(STDERR_FILENO));
    for (Plan& todo : plans) run(todo, gallery, machine, progress);
  }
  for (Plan& todo : plans) trials.push_back(std::move(todo.trial));
  return trials;
}

}  // namespace vitrine::report
