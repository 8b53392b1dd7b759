// SPDX-License-Identifier: Apache-2.0
#include "graph/pipeline.h"

#include "graph/admission.h"
#include "graph/message.h"
#include "graph/stage_body.h"
#include "io/publish.h"
#include "stages/clean.h"
#include "stages/parameterize.h"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <tuple>

namespace vitrine::graph {
namespace {

/// What the program holds before the first model and between models: OpenImageIO's 258 libraries are most of it.
constexpr std::uint64_t kProgramMemory = 150'000'000;

namespace flow = tbb::flow;
namespace fs = std::filesystem;

struct Admitted {};
struct Published {};
using Original = SurveyedModel;
using Charted = Against<ChartedMesh>;
using Flat = Against<FlatCharts>;
using Packed = Against<Atlas>;
using Simplified = Against<SimplifiedMesh>;
template <class T>
using In = std::shared_ptr<T const>;

// ---- Bodies: what the nodes do to one model
// ---------------------------------------------------------------------------

std::string ending(std::string const& path) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

CleanModel load_model(Job& job, io::ReadOptions const& options) {
  io::ArchiveEntry const& entry = *job.entry;
  SourceModel source =
      io::read_model(ending(entry.path), io::map_file(entry.file), io::resolve_in(entry.file.parent_path()), options);
  if (entry.up == io::UpAxis::z) io::turn_z_up(source);
  job.row.source_triangles = source.mesh.triangles.size();
  job.row.source_vertices = source.mesh.positions.size();
  job.row.source_coloured = has_colour(source);
  job.row.notes = source.notes;
  CleanModel cleaned = clean(std::move(source));
  job.row.repairs = cleaned.repairs;
  return cleaned;
}

Simplified simplify_model(In<Original> const& original, SimplifyOptions const& options, Job& job) {
  SimplifiedMesh light = simplify(weld(*original->model), options);
  job.row.simplify_error = light.error;
  return {original, std::move(light)};
}

Packed pack_charts(In<Flat> const& flat, PackOptions const& options, Job& job) {
  Atlas atlas = pack(flat->light, options);
  job.row.charts = atlas.charts;
  job.row.chart_retries = flat->light.retries;
  job.row.atlas_fill = atlas.fill;
  return {flat->original, std::move(atlas)};
}

BakedModel bake_maps(In<Packed> const& packed, ModelOptions const& options, Job& job) {
  BakedModel baked = bake(quantize(packed->light, options.quantize), *packed->original, options.bake);
  job.row.bake = baked.statistics;
  return baked;
}

Published publish_thumbnail(EncodedThumbnail const& thumbnail, fs::path const& gallery, Job& job) {
  ModelRow& row = job.row;
  std::string const path = "models/" + row.slug + "/thumb.glb";
  io::publish_file(gallery / path, thumbnail.glb);
  row.thumb = path;
  row.triangles = thumbnail.triangles;
  row.vertices = thumbnail.vertices;
  row.bytes = {thumbnail.glb.size(), thumbnail.geometry,  thumbnail.colour,
               thumbnail.normal,     thumbnail.occlusion, thumbnail.other};
  row.status = "done";
  return {};
}

// ---- Before and after
// -------------------------------------------------------------------------------------------------

/// What is known of a model before it is opened.
JobPtr arrive(io::ArchiveEntry const& entry) {
  auto job = std::make_shared<Job>();
  job->entry = &entry;
  job->memory = entry.estimate.memory;
  ModelRow& row = job->row;
  row.input = entry.path;
  row.slug = entry.slug;
  row.metadata = entry.metadata;
  row.input_bytes = entry.bytes;
  row.memory = job->memory;
  auto const title = entry.metadata.find("title");
  bool const titled = title != entry.metadata.end() && !title->second.empty();
  row.title = titled ? title->second : fs::path(entry.path).stem().string();
  return job;
}

std::string gigabytes(std::uint64_t bytes) {
  std::string text = std::to_string((bytes + 5'000'000) / 10'000'000);
  text.insert(0, text.size() < 3 ? 3 - text.size() : 0, '0');
  return text.insert(text.size() - 2, ".") + " GB";
}

Failure too_large(std::uint64_t bytes, std::uint64_t memory) {
  return {"admit", "needs an estimated " + gigabytes(bytes) + " of memory, and --memory allows " + gigabytes(memory),
          "run again with --memory " + std::to_string(bytes / 1'000'000'000 + 1) + "GB or more"};
}

/// The last place of a message: its failure, if any, goes into its row.
ModelRow finish(Message<Published> const& message) {
  ModelRow row = std::move(message.job->row);
  if (auto const* failure = std::get_if<Failure>(&message.value)) row.failure = *failure;
  return row;
}

}  // namespace

// ---- The graph: order, concurrency and the bound on memory
// ------------------------------------------------------------

std::vector<ModelRow> run_pipeline(io::Archive const& archive, ModelOptions const& options, RunOptions const& run,
                                   Watcher const& finished) {
  std::size_t const threads =
      run.threads > 0 ? std::size_t(run.threads) : std::size_t(tbb::info::default_concurrency());
  std::uint64_t const allowed = run.memory ? run.memory : default_memory();
  std::uint64_t const memory = allowed > kProgramMemory ? allowed - kProgramMemory : 0;
  tbb::global_control const width(tbb::global_control::max_allowed_parallelism, threads);

  struct Left {
    std::uint64_t memory;
  };  // a model is out of the graph: what it held is free again
  using Event = std::variant<JobPtr, Left>;
  using Gate = flow::multifunction_node<Event, std::tuple<Message<Admitted>>>;

  std::vector<ModelRow> rows(archive.entries.size());
  std::vector<JobPtr> waiting(archive.entries.size());
  Admission admission(memory, 2 * threads);
  auto const number = [&](JobPtr const& job) { return std::size_t(job->entry - archive.entries.data()); };

  flow::graph g;
  auto const node = [&g]<class From, class To>(std::size_t concurrency, std::string_view name, auto body) {
    return flow::function_node<Message<From>, Message<To>>(g, concurrency, stage<From, To>(name, body));
  };

  flow::input_node<Event> discover(g, [&, next = std::size_t{0}](tbb::flow_control& control) mutable -> Event {
    if (next < archive.entries.size()) return arrive(archive.entries[next++]);
    control.stop();
    return {};
  });
  Gate admit(g, flow::serial, [&](Event const& event, Gate::output_ports_type& out) {
    if (auto const* left = std::get_if<Left>(&event)) {
      admission.release(left->memory);
    } else {
      JobPtr const& job = std::get<JobPtr>(event);
      if (!admission.fits_at_all(job->memory)) job->memory = 0;  // only its refusal passes through
      waiting[number(job)] = job;
      admission.wait(number(job), job->memory);
    }
    for (std::size_t id : admission.admit()) {
      JobPtr job = std::move(waiting[id]);
      Message<Admitted> message{job, std::make_shared<Admitted const>()};
      if (job->memory == 0) message.value = too_large(job->row.memory + kProgramMemory, allowed);
      std::get<0>(out).try_put(message);
    }
  });
  auto load = node.operator()<Admitted, CleanModel>(
      2, "load", [&](In<Admitted> const&, Job& job) { return load_model(job, options.read); });
  auto survey_ = node.operator()<CleanModel, Original>(flow::unlimited, "survey", [](In<CleanModel> const& in, Job&) {
    return survey(std::shared_ptr<SourceModel const>(in, &in->model));
  });
  auto simplify_ = node.operator()<Original, Simplified>(
      flow::unlimited, "simplify",
      [&](In<Original> const& in, Job& job) { return simplify_model(in, options.simplify, job); });
  auto segment_ = node.operator()<Simplified, Charted>(flow::unlimited, "segment", [&](In<Simplified> const& in, Job&) {
    return Charted{in->original, segment(in->light.mesh, options.segment)};
  });
  auto flatten = node.operator()<Charted, Flat>(flow::unlimited, "parameterize", [](In<Charted> const& in, Job&) {
    return Flat{in->original, parameterize(in->light)};
  });
  auto pack_ = node.operator()<Flat, Packed>(
      flow::unlimited, "pack", [&](In<Flat> const& in, Job& job) { return pack_charts(in, options.pack, job); });
  auto bake_ = node.operator()<Packed, BakedModel>(
      flow::unlimited, "bake", [&](In<Packed> const& in, Job& job) { return bake_maps(in, options, job); });
  auto encode = node.operator()<BakedModel, EncodedThumbnail>(
      threads, "encode",
      [&](In<BakedModel> const& in, Job& job) { return io::encode(*in, job.row.title, options.encode); });
  auto publish = node.operator()<EncodedThumbnail, Published>(
      1, "publish", [&](In<EncodedThumbnail> const& in, Job& job) { return publish_thumbnail(*in, run.gallery, job); });
  flow::function_node<Message<Published>, Event> report(g, flow::serial,
                                                        [&](Message<Published> const& message) -> Event {
                                                          std::size_t const id = number(message.job);
                                                          rows[id] = finish(message);
                                                          if (finished) finished(rows[id], id);
                                                          return Left{message.job->memory};
                                                        });

  flow::make_edge(discover, admit);
  flow::make_edge(flow::output_port<0>(admit), load);
  flow::make_edge(load, survey_);
  flow::make_edge(survey_, simplify_);
  flow::make_edge(simplify_, segment_);
  flow::make_edge(segment_, flatten);
  flow::make_edge(flatten, pack_);
  flow::make_edge(pack_, bake_);
  flow::make_edge(bake_, encode);
  flow::make_edge(encode, publish);
  flow::make_edge(publish, report);
  flow::make_edge(report, admit);  // memory given back
  discover.activate();
  g.wait_for_all();
  return rows;
}

}  // namespace vitrine::graph
