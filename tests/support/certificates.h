// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Galleries' reports and certificates, made up.

#include <nlohmann/json.hpp>

#include <string>

namespace vitrine::test {

/// Of a thumbnail with this much error; its series have 8, 16 and 32 frames of 1 KB each.
nlohmann::ordered_json certificate(std::string const& input, std::size_t bytes, double mse1e4);

/// A row of report.json for it.
nlohmann::ordered_json certified_row(std::string const& input, std::string const& title, std::string const& slug);

}  // namespace vitrine::test
