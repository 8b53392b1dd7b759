// SPDX-License-Identifier: Apache-2.0
#include "tests/support/certificates.h"

namespace vitrine::test {

nlohmann::ordered_json certificate(std::string const& input, std::size_t bytes, double mse1e4) {
  using Json = nlohmann::ordered_json;
  Json series = {{"8", {{"bytes", 8000}, {"codingMse1e4", 0.5}, {"turningMse1e4", 20.0}}},
                 {"16", {{"bytes", 16000}, {"codingMse1e4", 0.5}, {"turningMse1e4", 6.0}}},
                 {"32", {{"bytes", 32000}, {"codingMse1e4", 0.5}, {"turningMse1e4", 0.5}}}};
  return {
      {"schema", 1},
      {"input",
       {{"path", input}, {"hash", "0011223344556677"}, {"bytes", 5000000}, {"triangles", 250000}, {"coloured", true}}},
      {"program", {{"name", "vitrine"}, {"version", "1"}}},
      {"options", Json::object()},
      {"measure",
       {{"set", "turntable"},
        {"views", 32},
        {"size", 200},
        {"light", "head"},
        {"mse1e4", mse1e4},
        {"ssim", 0.98},
        {"worstView", 3},
        {"coverage", 0.25}}},
      {"bytes",
       {{"total", bytes},
        {"geometry", bytes / 2},
        {"colour", bytes / 4},
        {"normal", bytes / 4},
        {"occlusion", 0},
        {"other", 0}}},
      {"mesh", {{"triangles", 3000}}},
      {"series", {{"jpeg90", series}, {"webp80", series}}}};
}

nlohmann::ordered_json certified_row(std::string const& input, std::string const& title, std::string const& slug) {
  return {
      {"input", input}, {"title", title}, {"status", "done"}, {"certificate", "models/" + slug + "/certificate.json"}};
}

}  // namespace vitrine::test
