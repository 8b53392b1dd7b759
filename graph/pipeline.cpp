// SPDX-License-Identifier: Apache-2.0
#include "graph/pipeline.h"

#include "graph/admission.h"
#include "graph/arrival.h"
#include "graph/message.h"
#include "graph/meter.h"
#include "graph/stage_body.h"
#include "graph/steps.h"
#include "graph/trace.h"
#include "graph/trial_steps.h"
#include "io/publish.h"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>

namespace vitrine::graph {
namespace {

/// What the program holds before the first model and between models: OpenImageIO's 258 libraries are most of it.
constexpr std::uint64_t kProgramMemory = 150'000'000;

namespace flow = tbb::flow;

struct Admitted {};
struct Surveyed {};
struct Tried {};
struct Published {};
template <class T>
using In = std::shared_ptr<T const>;

// ---- Before and after
// -------------------------------------------------------------------------------------------------

JobPtr arrive(io::Archive const& archive, std::size_t number, ModelOptions const& options, RunOptions const& run) {
  auto job = std::make_shared<Job>();
  job->entry = &archive.entries[number];
  job->number = number;
  job->run = &run;
  job->row = arriving(*job->entry, options.cluster);
  job->memory = job->row.memory;
  job->admitted = job->ready = Trace::Clock::now();
  return job;
}

std::string gigabytes(std::uint64_t bytes) {
  std::string text = std::to_string((bytes + 5'000'000) / 10'000'000);
  text.insert(0, text.size() < 3 ? 3 - text.size() : 0, '0');
  return text.insert(text.size() - 2, ".") + " GB";
}

Failure const kStopped{"admit", "the run was stopped before its turn", "run the same command again", Cause::stopped};

Failure too_large(std::uint64_t bytes, std::uint64_t memory) {
  return {"admit", "needs an estimated " + gigabytes(bytes) + " of memory, and --memory allows " + gigabytes(memory),
          "run again with --memory " + std::to_string(bytes / 1'000'000'000 + 1) + "GB or more", Cause::memory};
}

/// The last place of a message: its failure, if any, goes into its row.
ModelRow finish(Message<Published> const& message) {
  ModelRow row = std::move(message.job->row);
  if (auto const* failure = std::get_if<Failure>(&message.value)) row.failure = *failure;
  return row;
}

/// The trial that the search ends with.
Message<EncodedThumbnail> win(JobPtr const& job) {
  static_cast<Made&>(job->row) = {};
  job->row.trials = job->study->trials();
  if (Failure const* failure = job->study->failure()) return {job, *failure};
  try {
    Study::Winner const& winner = job->study->winner();
    static_cast<Made&>(job->row) = winner.made;
    return {job, winner.file};
  } catch (...) {
    return {job, current_failure("search")};
  }
}

}  // namespace

// ---- The graph: order, concurrency and the bound on memory
// ------------------------------------------------------------

void run_pipeline(io::Archive const& archive, ModelOptions const& options, RunOptions const& run,
                  Watcher const& finished) {
  std::size_t const threads =
      run.threads > 0 ? std::size_t(run.threads) : std::size_t(tbb::info::default_concurrency());
  std::uint64_t const allowed = run.memory ? run.memory : default_memory();
  std::uint64_t const memory = allowed > kProgramMemory ? allowed - kProgramMemory : 0;
  tbb::global_control const width(tbb::global_control::max_allowed_parallelism, threads);

  struct Left {
    std::uint64_t memory;
  };                                              // a model is out of the graph: what it held is free again
  using Event = std::variant<std::size_t, Left>;  // the number: of an entry that is to come in
  using Gate = flow::multifunction_node<Event, std::tuple<Message<Admitted>>>;

  Admission admission(memory, run.models > 0 ? run.models : 2 * threads);

  Meter meter(threads, allowed, kProgramMemory);
  std::optional<Trace> trace;
  if (!run.trace.empty()) trace.emplace();

  flow::graph g;
  auto const node = [&g]<class From, class To>(std::size_t concurrency, std::string_view name, auto body) {
    return flow::function_node<Message<From>, Message<To>>(g, concurrency, stage<From, To>(name, body));
  };

  flow::input_node<Event> discover(g, [&, next = std::size_t{0}](tbb::flow_control& control) mutable -> Event {
    if (next < archive.entries.size()) return next++;
    control.stop();
    return {};
  });
  Gate admit(g, flow::serial, [&](Event const& event, Gate::output_ports_type& out) {
    if (auto const* left = std::get_if<Left>(&event)) {
      admission.release(left->memory);
    } else {
      std::size_t const id = std::get<std::size_t>(event);
      std::uint64_t const needed = memory_of(archive.entries[id], options.cluster);
      admission.wait(id, admission.fits_at_all(needed) ? needed : 0);  // only its refusal passes through
    }
    for (std::size_t id : admission.admit()) {
      JobPtr const job = arrive(archive, id, options, run);
      job->meter = &meter;
      job->trace = trace ? &*trace : nullptr;
      Message<Admitted> message{job, std::make_shared<Admitted const>()};
      if (!admission.fits_at_all(job->memory)) {
        message.value = too_large(job->memory + kProgramMemory, allowed);
        job->memory = 0;
      }
      if (run.stop.stop_requested()) message.value = kStopped;
      std::get<0>(out).try_put(message);
    }
    meter.admission(admission);
    if (trace) trace->memory(admission.memory_in_use(), admission.models_in_flight());
  });
  auto load = node.operator()<Admitted, CleanModel>(
      2, "load", [&](In<Admitted> const&, Job& job) { return load_model(job, options); });
  auto survey_ =
      node.operator()<CleanModel, Surveyed>(flow::unlimited, "survey", [&](In<CleanModel> const& in, Job& job) {
        job.original = std::make_shared<Original const>(survey_model(in, options, job));
        return Surveyed{};
      });
  auto simplify_ = node.operator()<Surveyed, Tried>(flow::unlimited, "simplify", [&](In<Surveyed> const&, Job& job) {
    job.levels = std::make_shared<Levels const>(simplify_model(*job.original, options));
    job.study.emplace(subject_of(*job.original, *job.levels, options), options);
    return Tried{};
  });

  // The search: another trial, from the first stage on that makes something new of it, or the winner. A trial that
  // fails is one more thing that was tried.
  using Judge =
      flow::multifunction_node<Message<Tried>, std::tuple<Message<EncodedThumbnail>, Message<Tried>,
                                                          Message<FlatCharts>, Message<Atlas>, Message<BakedModel>>>;
  Judge judge(g, flow::unlimited, [](Message<Tried> const& in, Judge::output_ports_type& out) {
    Study* const study = in.job->study ? &*in.job->study : nullptr;
    auto const* failure = std::get_if<Failure>(&in.value);
    if (study && failure) study->add_failure(*failure);
    if (!study) {
      std::get<0>(out).try_put({in.job, *failure});
      return;
    }
    if (!study->advance()) {
      std::get<0>(out).try_put(win(in.job));
      return;
    }
    Makings const& kept = study->makings();
    static_cast<Made&>(in.job->row) = kept.made;
    if (kept.baked)
      std::get<4>(out).try_put({in.job, kept.baked});
    else if (kept.atlas)
      std::get<3>(out).try_put({in.job, kept.atlas});
    else if (kept.charts)
      std::get<2>(out).try_put({in.job, kept.charts});
    else
      std::get<1>(out).try_put({in.job, std::make_shared<Tried const>()});
  });
  auto shape = node.operator()<Tried, SimplifiedMesh>(flow::unlimited, "shape",
                                                      [](In<Tried> const&, Job& job) { return shape_model(job); });
  using Fork =
      flow::multifunction_node<Message<SimplifiedMesh>, std::tuple<Message<SimplifiedMesh>, Message<SimplifiedMesh>>>;
  Fork fork(g, flow::unlimited, [](Message<SimplifiedMesh> const& in, Fork::output_ports_type& out) {
    if (in.job->study->wants_atlas())
      std::get<1>(out).try_put(in);
    else
      std::get<0>(out).try_put(in);
  });
  auto paint_ = node.operator()<SimplifiedMesh, BakedModel>(
      flow::unlimited, "paint", [](In<SimplifiedMesh> const& in, Job& job) { return paint_model(*in, job); });
  auto segment_ = node.operator()<SimplifiedMesh, ChartedMesh>(
      flow::unlimited, "segment",
      [&](In<SimplifiedMesh> const& in, Job&) { return segment(in->mesh, options.segment); });
  auto flatten = node.operator()<ChartedMesh, FlatCharts>(
      flow::unlimited, "parameterize", [](In<ChartedMesh> const& in, Job& job) { return flatten_charts(*in, job); });
  auto pack_ = node.operator()<FlatCharts, Atlas>(
      flow::unlimited, "pack", [](In<FlatCharts> const& in, Job& job) { return pack_charts(in, job); });
  auto bake_ = node.operator()<Atlas, BakedModel>(flow::unlimited, "bake",
                                                  [](In<Atlas> const& in, Job& job) { return bake_maps(in, job); });
  auto encode = node.operator()<BakedModel, EncodedThumbnail>(
      threads, "encode", [](In<BakedModel> const& in, Job& job) { return encode_thumbnail(in, job); });
  auto weigh_ =
      node.operator()<EncodedThumbnail, Tried>(flow::unlimited, "weigh", [](In<EncodedThumbnail> const& in, Job& job) {
        weigh(in, job);
        return Tried{};
      });

  auto certify_ = node.operator()<EncodedThumbnail, Finished>(
      flow::unlimited, "certify",
      [&](In<EncodedThumbnail> const& in, Job& job) { return certify(*in, options.publish, job); });
  auto publish = node.operator()<Finished, Published>(1, "publish", [&](In<Finished> const& in, Job& job) {
    publish_model(*in, options, run.gallery, job);
    return Published{};
  });
  flow::function_node<Message<Published>, Event> report(
      g, flow::serial, [&](Message<Published> const& message) -> Event {
        ModelRow const row = finish(message);
        Job const& job = *message.job;
        if (trace) trace->model(job.number, row.input, job.admitted, Trace::Clock::now());
        finished(row, job.number);
        if (run.occupied) run.occupied(meter.take());
        return Left{job.memory};
      });

  flow::make_edge(discover, admit);
  flow::make_edge(flow::output_port<0>(admit), load);
  flow::make_edge(load, survey_);
  flow::make_edge(survey_, simplify_);
  flow::make_edge(simplify_, judge);
  flow::make_edge(flow::output_port<0>(judge), certify_);
  flow::make_edge(flow::output_port<1>(judge), shape);
  flow::make_edge(flow::output_port<2>(judge), pack_);
  flow::make_edge(flow::output_port<3>(judge), bake_);
  flow::make_edge(flow::output_port<4>(judge), encode);
  flow::make_edge(shape, fork);
  flow::make_edge(flow::output_port<0>(fork), paint_);
  flow::make_edge(paint_, encode);
  flow::make_edge(flow::output_port<1>(fork), segment_);
  flow::make_edge(segment_, flatten);
  flow::make_edge(flatten, pack_);
  flow::make_edge(pack_, bake_);
  flow::make_edge(bake_, encode);
  flow::make_edge(encode, weigh_);
  flow::make_edge(weigh_, judge);
  flow::make_edge(certify_, publish);
  flow::make_edge(publish, report);
  flow::make_edge(report, admit);  // memory given back
  discover.activate();
  g.wait_for_all();
  if (trace) io::publish_file(run.trace, trace->json());
}

}  // namespace vitrine::graph
