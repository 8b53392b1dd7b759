// SPDX-License-Identifier: Apache-2.0
// What the reports say of a model is the same whether it was made just now, came from the worker, the ledger, or its
// certificate.
#include "graph/record.h"

#include "graph/certificate.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace vitrine::graph {
namespace {

/// As unlike a fresh one as can be.
Recipe recipe() {
  return {.triangles = 1234,
          .shading = Shading::smooth,
          .painting = Painting::map,
          .colour_weight = 0.02,
          .fitted = false,
          .position_bits = 13,
          .normal_bits = 8,
          .unfolding = Unfolding::detail,
          .texture = 370,
          .map_quality = 0,
          .ceiling = 16'000,
          .avif = true,
          .full_chroma = true,
          .polished = true};
}

ModelRow finished() {
  ModelRow row;
  row.input = "hall/vase.ply", row.slug = "hall-vase-0123", row.title = "Vase", row.status = "done";
  row.charts = 7, row.triangles = 1230, row.vertices = 700, row.atlas_fill = 0.75f;
  row.bytes = {15'900, 6000, 9000, 0, 0, 900};
  row.recipe = recipe(), row.map_quality = 46;
  row.normal_angle = AngleError{1.5f, 7.25f};
  row.trials = {{recipe(), 15'900, 9000, 46, 0.25, 0.01}, failed_trial(recipe())};
  row.series_written = ModelRow::SeriesWritten{32, 1, 200'000};
  row.sphere = BoundingSphere{V3d(1, 2, 3), 2};
  return row;
}

TEST(Record, SaysOfAModelWhatWasSaidWhenItWasMade) {
  ModelRow const row = finished();
  std::optional<Record> const kept = record_from(to_bytes({row, "settings", {}, 0, ""}));
  ASSERT_TRUE(kept);
  EXPECT_EQ(certificate_text(kept->row, {}), certificate_text(row, {}));
  EXPECT_EQ(kept->row.recipe, row.recipe);
}

TEST(Record, ComesBackFromTheCertificate) {
  ModelRow const row = finished();
  std::optional<Record> kept = record_from_certificate(certificate_text(row, {}), row.slug);
  ASSERT_TRUE(kept);
  EXPECT_EQ(outcome_json(kept->row), outcome_json(row));
  kept->row.files = row.files;  // to which its own hash was added
  EXPECT_EQ(certificate_text(kept->row, {}), certificate_text(row, {}));
}

TEST(Record, IsNotTakenFromACertificateThatWasChanged) {
  std::string text = certificate_text(finished(), {});
  text.replace(text.find("Vase"), 4, "Vane");
  EXPECT_FALSE(record_from_certificate(text, "hall-vase-0123"));
}

TEST(Record, IsNotTakenFromWhatIsNestedWithoutEnd) {
  std::string const deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_FALSE(record_from_certificate("{\"schema\": 1, \"seal\": " + deep + "}", "hall-vase-0123"));
}

TEST(Record, NamesNoChoiceThatThereIsNot) {
  nlohmann::json record = nlohmann::json::from_cbor(to_bytes({finished(), "settings", {}, 0, ""}));
  for (int const choice : {-1, 99}) {
    record["row"]["recipe"]["shading"] = choice;
    std::string bytes;
    nlohmann::json::to_cbor(record, bytes);
    EXPECT_FALSE(record_from(bytes)) << choice;
  }
}

TEST(Record, TakesNoNumberForACountThatIsNone) {
  nlohmann::json record = nlohmann::json::from_cbor(to_bytes({finished(), "settings", {}, 0, ""}));
  auto certificate = nlohmann::ordered_json::parse(certificate_text(finished(), {}));
  for (nlohmann::json const& count :
       {nlohmann::json(1.5), nlohmann::json(1e51), nlohmann::json(-1), nlohmann::json(1ll << 32)}) {
    record["row"]["triangles"] = count;
    std::string bytes;
    nlohmann::json::to_cbor(record, bytes);
    EXPECT_FALSE(record_from(bytes)) << count;
    certificate["mesh"]["triangles"] = count;
    certificate["seal"] = seal_of(certificate);
    EXPECT_FALSE(record_from_certificate(to_text(certificate), "hall-vase-0123")) << count;
  }
}

}  // namespace
}  // namespace vitrine::graph
