// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the program vouches for, beside each thumbnail.

#include "graph/options.h"
#include "graph/record.h"
#include "graph/report.h"
#include "graph/strict_json.h"

#include <optional>
#include <string>

namespace vitrine::graph {

/// Which program it was.
nlohmann::ordered_json program_json();

/// certificate.json (schema 1) of a measured model: what it was made from, how, and how good it is. The same model,
/// options and program give the same certificate.
nlohmann::ordered_json certificate_json(ModelRow const& row, ModelOptions const& options);

/// The hash of all members but `seal`.
std::string seal_of(nlohmann::ordered_json certificate);

/// The certificate's file: its last member is its seal.
std::string certificate_text(ModelRow const& row, ModelOptions const& options);

/// Of the certificate's member `series`. Throws nlohmann::json::exception.
std::vector<SeriesSizes> read_series(StrictOrderedJson const& in);

/// All that the reports say of a finished model, times and estimates apart, from its certificate's text. Nothing when
/// the seal does not fit, or it is not one of this schema.
std::optional<Record> record_from_certificate(std::string const& text, std::string const& slug);

}  // namespace vitrine::graph
