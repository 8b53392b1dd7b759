// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tables of Limper et al. 2015, "Evaluating 3D Thumbnails for Virtual Object Galleries", section 4, for other
/// models.

#include "tools/report/study.h"
#include "tools/report/table.h"

namespace vitrine::report {

Table table1(Study const& study);    ///< the models
Table table2(Study const& study);    ///< bytes of image series
Table table3(Study const& study);    ///< bytes of thumbnails by texture size, series beside
Table table4(Study const& study);    ///< error of thumbnails by texture size
Table verdicts(Study const& study);  ///< 3D or series, model by model

/// "WebP q80" for "webp80".
std::string codec_name(std::string_view codec);

}  // namespace vitrine::report
