// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr Object kObjects[] = {
    {"amphora", "ceramics", "Amphora with warriors and horses", amphora, Format::obj, Colour::jpeg, true, false,
     400'000},
    {"bowl", "ceramics", "Bowl, mended with gold", bowl, Format::ply_big, Colour::vertices, false, false, 250'000},
    {"sherd", "ceramics", "Sherd of a vase, found 1931", sherd, Format::ply_big, Colour::vertices, false, false,
     200'000},
    {"coin", "metal", "Silver coin, owl", coin, Format::ply_little, Colour::vertices, true, false, 300'000},
    {"mask", "metal", "Mask of a king", mask, Format::glb, Colour::jpeg, false, false, 400'000},
    {"necklace", "metal", "Necklace of gold, carnelian, lapis and turquoise", necklace, Format::ply_little,
     Colour::vertices, true, false, 300'000},
    {"ring", "metal", "Signet ring with a ship", ring, Format::off, Colour::none, true, false, 200'000},
    {"sword", "metal", "Bronze sword", sword, Format::ply_ascii, Colour::vertices, true, false, 250'000},
    {"bust", "sculpture", "Bust of a philosopher", bust, Format::ply_little, Colour::none, true, true, 500'000},
    {"column", "sculpture", "Column with Doric capital", column, Format::stl, Colour::none, true, false, 400'000},
    {"knot", "stone", "Serpent of jade, knotted", knot, Format::glb, Colour::vertices, true, false, 300'000},
    {"fossil", "stone", "Ammonite", fossil, Format::obj, Colour::png, true, false, 250'000},
    {"mosaic", "stone", "Floor mosaic with a dolphin", mosaic, Format::obj, Colour::jpeg, false, false, 400'000},
    {"tablet", "stone", "Clay tablet, a merchant's letter", tablet, Format::ply_ascii, Colour::vertices, true, false,
     300'000},
};

}  // namespace

std::span<Object const> objects() { return kObjects; }

}  // namespace vitrine::sample
