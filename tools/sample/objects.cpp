// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr Object kObjects[] = {
    {"amphora", "ceramics", "Amphora with warriors and horses", amphora, Format::obj, Colour::jpeg, true, false,
     400'000},
    {"coin", "metal", "Silver coin, owl", coin, Format::ply_little, Colour::vertices, true, false, 300'000},
    {"bust", "sculpture", "Bust of a philosopher", bust, Format::ply_little, Colour::none, true, true, 500'000},
    {"knot", "stone", "Jade serpent, knotted", knot, Format::glb, Colour::vertices, true, false, 300'000},
};

}  // namespace

std::span<Object const> objects() { return kObjects; }

}  // namespace vitrine::sample
