// SPDX-License-Identifier: Apache-2.0
#include "graph/events.h"

namespace vitrine::graph {

VITRINE_JSON_MEMBERS(Occupancy, seconds, available, computed, taken, memory, reading, writing, ending, within,
                     disk_bytes, peak, admitted, most_admitted, allowed)

namespace {

using json = StrictJson;

json entry_json(io::ArchiveEntry const& e) {
  return {{"path", e.path},
          {"file", e.file.native()},
          {"bytes", e.bytes},
          {"slug", e.slug},
          {"up", int(e.up)},
          {"metadata", e.metadata},
          {"triangles", e.estimate.triangles},
          {"memory", e.estimate.memory},
          {"thinned", e.estimate.thinned}};
}

io::ArchiveEntry entry_from(json const& in) {
  return {in.at("path"),
          in.at("file").get<std::string>(),
          in.at("bytes"),
          in.at("slug"),
          io::UpAxis(in.at("up").get<int>()),
          in.at("metadata"),
          {in.at("triangles"), in.at("memory"), in.at("thinned")}};
}

json archive_json(io::Archive const& archive) {
  json entries = json::array();
  for (io::ArchiveEntry const& entry : archive.entries) entries.push_back(entry_json(entry));
  return {{"event", "archive"}, {"entries", std::move(entries)}, {"notes", archive.notes}};
}

io::Archive archive_from(json const& in) {
  io::Archive archive;
  for (json const& entry : in.at("entries")) archive.entries.push_back(entry_from(entry));
  archive.notes = in.at("notes");
  return archive;
}

void with_record(json const& message, std::function<void(Record const&)> const& hear) {
  if (std::optional<Record> const record = record_from(message.at("record"))) hear(*record);
}

}  // namespace

WorkEvents sending(std::function<void(json const&)> const& send) {
  WorkEvents events;
  events.archive = [=](io::Archive const& archive) { send(archive_json(archive)); };
  events.stage = [=](std::string const& slug, std::string const& stage) {
    send({{"event", "stage"}, {"slug", slug}, {"stage", stage}});
  };
  events.fresh = [=](Record const& record) { send({{"event", "fresh"}, {"record", to_bytes(record)}}); };
  events.todo = [=](std::string const& slug, std::string const& why) {
    send({{"event", "todo"}, {"slug", slug}, {"why", why}});
  };
  events.converting = [=] { send({{"event", "converting"}}); };
  events.occupied = [=](Occupancy const& occupancy) { send({{"event", "occupied"}, {"cores", occupancy}}); };
  events.finished = [=](Record const& record) { send({{"event", "finished"}, {"record", to_bytes(record)}}); };
  return events;
}

bool deliver(json const& message, WorkEvents const& events) try {
  std::string const event = message.at("event");
  if (event == "archive")
    events.archive(archive_from(message));
  else if (event == "stage")
    events.stage(message.at("slug"), message.at("stage"));
  else if (event == "fresh")
    with_record(message, events.fresh);
  else if (event == "todo")
    events.todo(message.at("slug"), message.at("why"));
  else if (event == "converting")
    events.converting();
  else if (event == "occupied")
    events.occupied(message.at("cores"));
  else if (event == "finished")
    with_record(message, events.finished);
  else
    return false;
  return true;
} catch (json::exception const&) {
  return false;
}

}  // namespace vitrine::graph
