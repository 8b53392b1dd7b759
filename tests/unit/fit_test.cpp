// SPDX-License-Identifier: Apache-2.0
// The search in worlds whose bytes and errors are formulas.
#include "stages/fit.h"

#include "stages/error.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vitrine {
namespace {

using testing::HasSubstr;

/// What a recipe costs and how far off it is.
struct World {
  double facet_rate = 1.3, vertex_rate = 0.5, map_bits = 0.8;
  std::function<double(Recipe const&)> penalty = [](Recipe const&) { return 1.0; };

  Trial operator()(Recipe const& recipe) const {
    double map = 0, quality = 0, rate = facet_rate + 0.1 * (recipe.position_bits - 10);
    if (recipe.painting == Painting::vertices) rate += vertex_rate;
    if (is_textured(recipe)) rate += 0.8;
    if (has_normals(recipe)) rate += 0.5;
    if (is_textured(recipe)) {
      double const at_50 = map_bits / 8 * recipe.texture * recipe.texture,
                   room = 0.99 * recipe.ceiling - 700 - rate * recipe.triangles;
      quality = recipe.map_quality > 0 ? recipe.map_quality : std::clamp(50 * room / at_50, 5.0, 95.0);
      map = at_50 * quality / 50;
    }
    double const error = 2000 * penalty(recipe) / std::pow(recipe.triangles, 1.2);
    return {recipe,      std::size_t(700 + map + rate * recipe.triangles), std::size_t(map), int(quality), error,
            error * 0.05};
  }
};

std::vector<Trial> search(Subject const& subject, FitOptions const& options, World const& world) {
  std::vector<Trial> history;
  while (std::optional<Recipe> const recipe = next_trial(subject, options, history)) {
    history.push_back(world(*recipe));
    if (history.size() > 40) break;
  }
  return history;
}

Trial winner(Subject const& subject, FitOptions const& options, World const& world) {
  std::vector<Trial> const history = search(subject, options, world);
  return history[best_trial(subject, options, history)];
}

constexpr Subject kPlain{100'000}, kPainted{100'000, true};

TEST(Fit, ShrinksWhatNotEvenThePoorestQualityMakesSmallEnough) {
  constexpr Subject holes{.triangles = 100'000, .coloured = true, .needs_map = true};
  World const noise{.map_bits = 80};  // unlike any map that the byte model was made by
  for (double kb : {2.0, 8.0, 16.0}) EXPECT_LE(double(winner(holes, {.max_kb = kb}, noise).bytes), 1000 * kb);
}

/// Facets want fine places, and normals only want them not too coarse.
double penalty_of_shading(Recipe const& recipe) {
  if (recipe.shading == Shading::facets) return 1 + 0.3 * std::max(0, 14 - recipe.position_bits);
  return recipe.position_bits < 12 ? 3 : 0.3;
}

TEST(Fit, PlacesAreCoarserAgainWhereNormalsPayAfterAll) {
  Trial const best = winner(kPlain, {}, {.penalty = penalty_of_shading});
  EXPECT_EQ(best.recipe.shading, Shading::smooth);
  EXPECT_EQ(best.recipe.position_bits, 12);
}

TEST(Fit, FacetsOnCoarserPlacesAreAskedWhereNormalsWinNarrowly) {
  Trial const best = winner(kPlain, {}, {.penalty = [](Recipe const& recipe) {
                              if (recipe.shading == Shading::smooth) return 0.65;
                              return recipe.position_bits == 9 ? 0.8 : 1.0;
                            }});
  EXPECT_EQ(best.recipe.shading, Shading::facets);
  EXPECT_EQ(best.recipe.position_bits, 9);
}

TEST(Fit, NormalsAreAsFineAsPays) {
  for (int finest : {4, 6, 8}) {
    Trial const best = winner(kPlain, {}, {.penalty = [=](Recipe const& recipe) {
                                double const off = 0.3 * std::abs(recipe.normal_bits - finest);
                                return recipe.shading == Shading::smooth ? 0.3 * (1 + off) : 1.0;
                              }});
    EXPECT_EQ(best.recipe.normal_bits, finest);
  }
}

TEST(Fit, FillsTheCeilingAndNeverExceedsIt) {
  for (Subject const& subject : {kPlain, kPainted})
    for (double kb : {2.0, 5.0, 8.0, 16.0, 32.0, 100.0}) {
      Trial const best = winner(subject, {.max_kb = kb}, {});
      EXPECT_LE(double(best.bytes), 1000 * kb);
      EXPECT_GE(double(best.bytes), 940 * kb) << kb;
    }
}

TEST(Fit, EndsSoon) {
  for (Subject const& subject : {kPlain, kPainted})
    for (double kb : {0.5, 1.0, 8.0, 32.0})
      for (World const& world :
           {World{}, World{.penalty = [](Recipe const& r) { return r.painting == Painting::map ? 1e-3 : 1; }}})
        EXPECT_LE(search(subject, {.max_kb = kb}, world).size(), 30u) << kb;
}

TEST(Fit, TakesWhatLowersTheErrorAtEqualBytes) {
  World maps_win, vertices_win;
  maps_win.penalty = [](Recipe const& r) { return r.painting == Painting::map ? 0.2 : 1; };
  vertices_win.penalty = [](Recipe const& r) { return r.painting == Painting::map ? 2 : 1; };
  EXPECT_EQ(winner(kPainted, {.max_kb = 16}, maps_win).recipe.painting, Painting::map);
  EXPECT_EQ(winner(kPainted, {.max_kb = 16}, vertices_win).recipe.painting, Painting::vertices);
}

TEST(Fit, ColoursPerVertexAreComparedWithAnAtlasAtTheirOwnBest) {
  World edges_pay;  // with normals alone
  edges_pay.penalty = [](Recipe const& r) {
    if (r.painting == Painting::map) return 0.3;
    return r.shading == Shading::smooth && r.colour_weight > 0 ? 0.2 : r.shading == Shading::smooth ? 0.5 : 1.0;
  };
  EXPECT_EQ(winner(kPainted, {}, edges_pay).recipe.painting, Painting::vertices);
}

TEST(Fit, UsesNormalsOnlyWhereTheyPay) {
  World normals_win;
  normals_win.penalty = [](Recipe const& r) { return r.shading == Shading::smooth ? 0.3 : 1; };
  EXPECT_EQ(winner(kPlain, {.max_kb = 24}, normals_win).recipe.shading, Shading::smooth);
  EXPECT_EQ(winner(kPlain, {.max_kb = 24}, {}).recipe.shading, Shading::facets);
}

TEST(Fit, AsksForCreasesWhereTheOriginalHasThem) {
  World creases_win;
  creases_win.penalty = [](Recipe const& r) { return r.shading == Shading::creased ? 0.3 : 1; };
  constexpr Subject creased{.triangles = 100'000, .creased = true};
  EXPECT_EQ(winner(creased, {}, creases_win).recipe.shading, Shading::creased);
  EXPECT_EQ(winner(kPlain, {}, creases_win).recipe.shading, Shading::facets);
  EXPECT_EQ(winner(creased, {.without = Choice::creases}, creases_win).recipe.shading, Shading::facets);
}

TEST(Fit, KeepsFlatColoursWhereTheyPay) {
  World swatches_win, swatches_lose;
  swatches_win.penalty = [](Recipe const& r) { return r.painting == Painting::swatches ? 0.3 : 1; };
  swatches_lose.penalty = [](Recipe const& r) { return r.painting == Painting::swatches ? 2 : 1; };
  Subject flat = kPainted;
  flat.flat = true;
  EXPECT_EQ(winner(flat, {}, swatches_win).recipe.painting, Painting::swatches);
  EXPECT_EQ(winner(flat, {}, swatches_lose).recipe.painting, Painting::vertices);
  EXPECT_EQ(winner(flat, {.without = Choice::swatches}, swatches_win).recipe.painting, Painting::vertices);
  EXPECT_EQ(winner(kPainted, {}, swatches_win).recipe.painting, Painting::vertices);
}

TEST(Fit, LeavesVerticesWhereTheyWereMadeIfAllHaveRoom) {
  World exact_wins;
  exact_wins.penalty = [](Recipe const& r) { return r.fitted ? 1 : 0.3; };
  constexpr Subject whole{.triangles = 2000, .creased = true}, scan{.triangles = 2000};
  EXPECT_FALSE(winner(whole, {.max_kb = 64}, exact_wins).recipe.fitted);
  EXPECT_TRUE(winner(whole, {.max_kb = 64}, {}).recipe.fitted);
  EXPECT_TRUE(winner({.triangles = 100'000, .creased = true}, {}, exact_wins).recipe.fitted);
  EXPECT_TRUE(winner(scan, {.max_kb = 64}, exact_wins).recipe.fitted);
}

TEST(Fit, AsksNoNearlySameRecipeTwice) {
  World facets_win;
  facets_win.penalty = [](Recipe const& r) { return r.shading == Shading::smooth ? 2.0 : 1.0; };
  for (Subject const& subject : {kPlain, kPainted}) {
    std::vector<Trial> const history = search(subject, {.max_kb = 16}, facets_win);
    std::size_t const explored = history.size() - (is_filled(history.back().recipe) ? 0 : 6);  // land() may come close
    for (std::size_t i = 0; i < explored; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        Recipe alike = history[j].recipe;
        if (std::abs(alike.triangles - history[i].recipe.triangles) < 0.01 * alike.triangles)
          alike.triangles = history[i].recipe.triangles;
        EXPECT_NE(alike, history[i].recipe) << i << " and " << j;
      }
  }
}

TEST(Fit, AsksOfNormalsOverAMapOnceWhereTheyLose) {
  World facets_win;
  facets_win.penalty = [](Recipe const& r) {
    return (r.painting == Painting::map ? 0.2 : 1) * (r.shading == Shading::smooth ? 2 : 1);
  };
  auto const history = search(kPainted, {.max_kb = 16}, facets_win);
  auto const unfolded = std::ranges::find(history, Unfolding::rigid, [](Trial const& t) { return t.recipe.unfolding; });
  auto const smooth = [](Trial const& t) {
    return t.recipe.painting == Painting::map && t.recipe.shading == Shading::smooth;
  };
  ASSERT_NE(unfolded, history.end());
  EXPECT_TRUE(std::any_of(history.begin(), unfolded, smooth));
  EXPECT_FALSE(std::any_of(unfolded, history.end(), smooth));
}

TEST(Fit, SpendsOnTheMapWhatTheOriginalsFewTrianglesLeave) {
  World world;
  world.penalty = [](Recipe const& r) { return r.painting == Painting::map ? 256.0 / r.texture : 4; };
  Subject const box{24, true};
  Trial const best = winner(box, {.max_kb = 16}, world);
  EXPECT_LE(best.recipe.triangles, 40);
  EXPECT_GT(best.recipe.texture, 256);
}

TEST(Fit, BeginsWithFinePlacesWhereAllTrianglesFit) {  // coarse ones would hide what each of the other choices is worth
  Subject const spider{1368, true};
  std::vector<Trial> const history = search(spider, {.max_kb = 16}, {});
  EXPECT_EQ(history.front().recipe.position_bits, 13);
  EXPECT_TRUE(
      std::ranges::all_of(history, [](Trial const& t) { return t.recipe.colour_weight == 0; }));  // nothing collapses
  EXPECT_EQ(search(kPainted, {.max_kb = 16}, {}).front().recipe.position_bits, 10);
}

TEST(Fit, KeepsTheOriginalsTextureWhereThatIsBestAndNoLargerThanItIs) {
  World world;
  world.penalty = [](Recipe const& r) { return r.painting == Painting::own ? 0.1 : 1; };
  Subject const knot{.triangles = 2880, .coloured = true, .own_texture = 64};
  for (Trial const& trial : search(knot, {.max_kb = 16}, world))
    EXPECT_TRUE(trial.recipe.painting != Painting::own || trial.recipe.texture <= 64);
  EXPECT_EQ(winner(knot, {.max_kb = 16}, world).recipe.painting, Painting::own);
  for (Trial const& trial : search(kPainted, {.max_kb = 16}, world)) EXPECT_NE(trial.recipe.painting, Painting::own);
}

TEST(Fit, ComparesAnAtlasWithTheOriginalsTextureAtTheSizeThatIsBest) {
  World world;
  world.penalty = [](Recipe const& r) {
    return r.painting == Painting::map ? 100.0 / r.texture : r.painting == Painting::own ? 0.25 : 1;
  };
  Subject const amphora{.triangles = 12'000, .coloured = true, .own_texture = 256};
  std::vector<Trial> const history = search(amphora, {.max_kb = 16}, world);
  auto const first = std::ranges::find(history, Painting::map, [](Trial const& t) { return t.recipe.painting; });
  ASSERT_NE(first, history.end());
  EXPECT_GT(world.penalty(first->recipe), 0.25);
  EXPECT_EQ(history[best_trial(amphora, {.max_kb = 16}, history)].recipe.painting, Painting::map);
}

TEST(Fit, AsksForAnotherCodingBeforeAMapOfPoorQualityLoses) {
  World noise{.map_bits = 6};
  noise.penalty = [](Recipe const& r) { return r.painting != Painting::map ? 0.6 : r.avif ? 0.1 : 0.27; };
  Subject painted = kPainted;
  EXPECT_EQ(winner(painted, {}, noise).recipe.painting, Painting::vertices);
  painted.avif = true;
  EXPECT_EQ(winner(painted, {}, noise).recipe.painting, Painting::map);
}

constexpr Subject kInAvif{.triangles = 100'000, .coloured = true, .avif = true};

TEST(Fit, FullChromaIsTakenUnlessItScoresClearlyWorse) {
  for (double score : {0.9, 1.03, 1.2}) {
    World world;
    world.penalty = [=](Recipe const& r) {
      return (r.painting == Painting::map ? 0.1 : 1) * (r.avif ? 0.5 : 1) * (r.full_chroma ? score : 1) *
             (r.polished ? 0.9 : 1);
    };
    EXPECT_EQ(winner(kInAvif, {}, world).recipe.full_chroma, score < 1.1) << score;
  }
}

TEST(Fit, TheBestMapIsPolishedOnceAtTheEnd) {
  World world;
  world.penalty = [](Recipe const& r) {
    return (r.painting == Painting::map ? 0.1 : 1) * (r.avif ? 0.5 : 1) * (r.polished ? 0.9 : 1);
  };
  std::vector<Trial> const history = search(kInAvif, {}, world);
  EXPECT_TRUE(history.back().recipe.polished);
  EXPECT_EQ(std::ranges::count(history, true, [](Trial const& t) { return t.recipe.polished; }), 1);
  EXPECT_EQ(best_trial(kInAvif, {}, history), history.size() - 1);
}

TEST(Fit, KeepsWhatCutsOutInAMap) {
  Subject const leaf{.triangles = 50'000, .coloured = true, .needs_map = true};
  for (Trial const& trial : search(leaf, {.max_kb = 8}, {})) EXPECT_EQ(trial.recipe.painting, Painting::map);
}

TEST(Fit, FindsTheSmallestFileBelowAnError) {
  Trial const best = winner(kPlain, {.max_kb = 100, .max_error = 0.3}, {});
  EXPECT_LE(best.error, 0.3);
  EXPECT_GE(best.error, 0.28);
}

TEST(Fit, LandsOnAnErrorWhereAllTrianglesTakeMostOfTheBytes) {
  World world{.facet_rate = 2, .map_bits = 1.6};
  world.penalty = [](Recipe const& r) {
    return (r.painting == Painting::map ? 50.0 / r.texture : 5) * (r.triangles < 1300 ? 20 : 1);
  };
  Trial const best = winner({1300, true}, {.max_kb = 60, .max_error = 0.06}, world);
  EXPECT_EQ(best.recipe.triangles, 1300);
  EXPECT_LT(best.map_bytes, best.bytes / 2);
  EXPECT_LE(best.error, 0.06);
  EXPECT_GE(best.error, 0.055);
}

TEST(Fit, ComesBackFromFilesTooSmallForAnError) {  // where error falls faster than any usual power of the bytes
  World steep;
  steep.penalty = [](Recipe const& r) {
    return std::pow(1300.0 / r.triangles, 4) * (r.painting == Painting::map ? 0.002 : 1);
  };
  Trial const best = winner({1300, true}, {.max_kb = 16, .max_error = 0.01}, steep);
  EXPECT_LE(best.error, 0.01);
  EXPECT_LT(best.bytes, 5500u);
}

TEST(Fit, HalvesTheGapWhereTheErrorFallsAllAtOnce) {
  constexpr double kMost = 0.1, kEnough = 12'000;
  World cliff;
  cliff.penalty = [](Recipe const& r) {
    return (r.triangles < kEnough ? 1.3 : 0.2) * kMost * std::pow(r.triangles, 1.2) / 2000;
  };
  Trial const best = winner(kPlain, {.max_kb = 200, .max_error = kMost}, cliff);
  EXPECT_LE(best.error, kMost);
  EXPECT_LT(best.recipe.triangles, 1.1 * kEnough);
}

TEST(Fit, AMapThatFitsAtNoQualityGetsFewerTexels) {
  World const noise{.map_bits = 16,
                    .penalty = [](Recipe const& r) { return r.painting == Painting::map ? 0.05 : 1.0; }};
  std::vector<Trial> const history = search(kPainted, {}, noise);
  auto const map = std::ranges::find(history, Painting::map, [](Trial const& t) { return t.recipe.painting; });
  ASSERT_LT(map + 1, history.end());
  EXPECT_GT(map->bytes, 16'000u);
  EXPECT_EQ(map[1].recipe.painting, Painting::map);
  EXPECT_LT(map[1].recipe.texture, map->recipe.texture);
  EXPECT_LE(map[1].bytes, 16'000u);
}

TEST(Fit, GrowsTheMapAsAnErrorNeedsWhereTheOriginalHasNoMoreTriangles) {
  World world;
  world.penalty = [](Recipe const& r) { return r.painting == Painting::map ? 5000.0 / r.ceiling : 4; };
  Subject const box{1000, true};
  for (double error : {0.2, 0.05}) {
    Trial const best = winner(box, {.max_kb = 400, .max_error = error}, world);
    EXPECT_LE(best.error, error);
    EXPECT_GE(best.error, 0.9 * error);
    EXPECT_EQ(best.recipe.triangles, 1000);
  }
}

TEST(Fit, LeavesTheTrianglesThatADeviationNeeds) {
  Subject const bust{.triangles = 100'000, .fixed_triangles = 3000};
  for (Trial const& trial : search(bust, {.max_kb = 50}, {})) EXPECT_EQ(trial.recipe.triangles, 3000);
  EXPECT_THROW(best_trial(bust, {.max_kb = 2}, search(bust, {.max_kb = 2}, {})), Error);
}

TEST(Fit, SaysWhatItReachedWhenALimitCannotBeMet) {
  FitOptions const tiny{.max_kb = 1};
  World heavy;
  heavy.facet_rate = 20;
  std::vector<Trial> const history = search(kPlain, tiny, heavy);
  try {
    best_trial(kPlain, tiny, history);
    FAIL() << "1 KB was met";
  } catch (Error const& e) {
    EXPECT_THAT(e.what(), HasSubstr("1.00 KB"));
    EXPECT_THAT(e.remedy(), HasSubstr("--max-kb"));
  }
  FitOptions const strict{.max_kb = 4, .max_error = 1e-4};
  EXPECT_THROW(best_trial(kPlain, strict, search(kPlain, strict, {})), Error);
}

}  // namespace
}  // namespace vitrine
