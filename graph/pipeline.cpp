// SPDX-License-Identifier: Apache-2.0
#include "graph/pipeline.h"

#include "graph/admission.h"
#include "graph/message.h"
#include "graph/stage_body.h"
#include "graph/steps.h"
#include "stages/parameterize.h"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
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
using Simplified = Against<SimplifiedMesh>;
using Charted = Against<ChartedMesh>;
using Flat = Against<FlatCharts>;
using Packed = Against<Atlas>;
using Baked = Against<BakedModel>;
using Encoded = Against<EncodedThumbnail>;

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
  auto survey_ = node.operator()<CleanModel, Original>(
      flow::unlimited, "survey", [&](In<CleanModel> const& in, Job&) { return survey_model(in, options.publish); });
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
  auto bake_ = node.operator()<Packed, Baked>(
      flow::unlimited, "bake", [&](In<Packed> const& in, Job& job) { return bake_maps(in, options, job); });
  auto encode = node.operator()<Baked, Encoded>(
      threads, "encode", [&](In<Baked> const& in, Job& job) { return encode_thumbnail(in, options.encode, job); });
  auto measure = node.operator()<Encoded, Finished>(
      flow::unlimited, "measure", [](In<Encoded> const& in, Job& job) { return measure_thumbnail(in, job); });
  auto publish = node.operator()<Finished, Published>(1, "publish", [&](In<Finished> const& in, Job& job) {
    publish_model(*in, options, run.gallery, job);
    return Published{};
  });
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
  flow::make_edge(encode, measure);
  flow::make_edge(measure, publish);
  flow::make_edge(publish, report);
  flow::make_edge(report, admit);  // memory given back
  discover.activate();
  g.wait_for_all();
  return rows;
}

}  // namespace vitrine::graph
