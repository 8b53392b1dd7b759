// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What visitors of the gallery load, in 3D and as series of pictures.

#include "tools/report/gallery.h"
#include "tools/report/table.h"

namespace vitrine::report {

/// Bytes until the first object is there and until all are, and how long lines of three kinds take for them alone;
/// viewer and decoder count (by gzip), posters do not, and series are shown without code. Without rows where
/// report.json does not say.
Table page_table(Gallery const& gallery);

/// Seconds that visitors waited in Chromium, where tools/page_speed.mjs measured the gallery; else without rows.
Table wait_table(Gallery const& gallery);

}  // namespace vitrine::report
