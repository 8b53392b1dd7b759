// SPDX-License-Identifier: Apache-2.0
#include "stages/fit.h"

#include "stages/byte_model.h"
#include "stages/inquiry.h"
#include "stages/winner.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrine {
namespace {

/// Of the cost's logarithm. No texture that was so much worse at first, or with both shadings, became the best one.
constexpr double kOutOfReach = 0.85, kWithinReach = 0.4;
constexpr int kUsualQuality = 50;              ///< of a map that does not fill its ceiling, to begin with
constexpr int kLeastBits = 8, kMostBits = 14;  ///< of a place
constexpr int kExactBits = 16;                 ///< the same, where all triangles have room
constexpr int kLeastNormalBits = 4, kMostNormalBits = 10, kMostColourBits = 8;
constexpr int kFineBits = 13;     ///< of a place, where there is room for all triangles
constexpr double kClearly = 0.1;  ///< of the cost's logarithm: what wins or loses by more is not asked again
constexpr double kClose = 0.05;   ///< the same, of what wins by something else

class Search : private Inquiry {
 public:
  Search(Subject const& subject, FitOptions const& options, std::span<Trial const> history)
      : Inquiry(subject, options, history), subject_(subject), options_(options), history_(history) {}

  /// Asks the same questions in the same order each time, and answers those that the history answers.
  std::optional<Recipe> next() {
    if (explore() == Answer::none) return asked();
    if (subject_.fixed_triangles > 0) return {};
    return is_filled(best()) && options_.max_error == 0 ? shrunk(subject_, options_, history_) : land();
  }

 private:
  using Question = Answer (Search::*)();

  Answer explore() {
    constexpr std::pair<Choice, Question> questions[] = {{Choice::none, &Search::start},
                                                         {Choice::none, &Search::choose_size},
                                                         {Choice::swatches, &Search::choose_swatches},
                                                         {Choice::normals, &Search::choose_shading_of_vertices},
                                                         {Choice::refit, &Search::choose_exact},
                                                         {Choice::colour_edges, &Search::choose_colour_quadrics},
                                                         {Choice::normals, &Search::choose_shading_of_vertices},
                                                         {Choice::none, &Search::choose_painting},
                                                         {Choice::none, &Search::choose_size},
                                                         {Choice::bits, &Search::choose_bits_under_a_map},
                                                         {Choice::none, &Search::choose_share},
                                                         {Choice::none, &Search::choose_quality},
                                                         {Choice::unfolding, &Search::choose_unfolding},
                                                         {Choice::normals, &Search::choose_shading},
                                                         {Choice::creases, &Search::choose_creases},
                                                         {Choice::bits, &Search::choose_bits},
                                                         {Choice::normals, &Search::reconsider_shading},
                                                         {Choice::refit, &Search::choose_fit},
                                                         {Choice::bits, &Search::choose_normal_bits},
                                                         {Choice::colours, &Search::choose_colours},
                                                         {Choice::avif, &Search::choose_coding},
                                                         {Choice::none, &Search::polish}};
    for (auto const& [choice, question] : questions)
      if (!is_left_out(choice) && (this->*question)() == Answer::none) return Answer::none;
    return Answer::worse;
  }

  bool is_left_out(Choice choice) const { return choice != Choice::none && choice == options_.without; }

  // ---- Questions: a change to the best recipe so far, where it may pay

  Answer start() {
    Recipe recipe;
    recipe.painting = subject_.needs_map ? Painting::map : subject_.coloured ? Painting::vertices : Painting::none;
    recipe.position_bits = kFineBits;
    if (affordable(recipe) < most()) recipe.position_bits = aim() < 6500 ? 9 : Recipe{}.position_bits;
    recipe.texture = first_texture();
    recipe.ceiling = size();
    if (subject_.fixed_triangles > 0) recipe.map_quality = kUsualQuality;
    return ask(recipe);
  }

  int first_texture() const {
    double const texels = kMapShare * aim() / expected_bytes_per_texel(kUsualQuality);
    return std::clamp(int(std::sqrt(texels)) / 4 * 4, kSmallestTexture, 1024);
  }

  /// Each painting is compared as it is with the answers that decide most about it.
  Answer choose_painting() {
    if (subject_.needs_map && choose_map() == Answer::none) return Answer::none;
    for (Painting painting : {Painting::map, Painting::own})
      if (offers(painting) && try_texture(painting) == Answer::none) return Answer::none;
    return Answer::worse;
  }

  bool offers(Painting painting) const {
    if (painting == Painting::own) return subject_.own_texture > 0 && !is_left_out(Choice::own_texture);
    return subject_.coloured && !is_left_out(Choice::atlas) && best().painting != Painting::map;
  }

  /// The original's own texture smooth first, an atlas in facets; then the other way, unless the first leads nowhere. Where
  /// normals have won with all triangles, an atlas is not left before it had them.
  Answer try_texture(Painting painting) {
    Recipe recipe = best();
    recipe.painting = painting;
    recipe.colour_weight = 0;
    recipe.avif = recipe.full_chroma = recipe.polished = false;
    recipe.texture = first_texture();
    bool const smooth_first = painting == Painting::own && !is_left_out(Choice::normals);
    bool const smooth_won = !smooth_first && has_normals(best()) && is_whole(best_trial());
    wear(smooth_first ? Shading::smooth : Shading::facets, recipe);
    if (ask(recipe) == Answer::none) return Answer::none;
    if (!smooth_won && last_cost() > cost(best_trial()) + kOutOfReach) return Answer::worse;
    std::size_t const rival = take_last();
    if (!is_left_out(Choice::normals)) {
      double const first = last_cost();
      Recipe other = asked();
      wear(smooth_first ? Shading::facets : Shading::smooth, other);
      if (ask(other) == Answer::none) return Answer::none;
      normals_lost_[std::size_t(painting)] = (smooth_first ? first - last_cost() : last_cost() - first) > kClearly;
    }
    if (cost(best_trial()) < cost(trial(rival)) + kWithinReach && choose_map() == Answer::none) return Answer::none;
    take_better(rival, 0);
    return Answer::worse;
  }

  /// AVIF mostly wins, and at its best has so many more texels than a first map whose room is not too small already.
  Answer choose_map() {
    bool const has_room = best_trial().map_quality > kWorstQuality;
    Change const in_avif = [](Recipe& r) { r.avif = true; };
    Change const finer_in_avif = [](Recipe& r) { r.avif = true, r.texture = r.texture * 7 / 4; };
    bool const may_be_avif = subject_.avif && !is_left_out(Choice::avif);
    if (may_be_avif && ask_with(has_room ? finer_in_avif : in_avif) == Answer::none) return Answer::none;
    if (choose_chroma() == Answer::none) return Answer::none;
    return choose_texture();
  }

  /// Structure is judged by luminance: where the score is close, full chroma has the lower error.
  Answer choose_chroma() {
    if (!best().avif) return Answer::worse;
    if (ask_with([](Recipe& r) { r.full_chroma = true; }) == Answer::none) return Answer::none;
    take_better(take_last(), kClose);
    return Answer::worse;
  }

  /// What is best for others need not be best for files of the size that the error needs.
  Answer choose_size() { return options_.max_error > 0 && subject_.fixed_triangles == 0 ? resize() : Answer::worse; }

  Answer choose_swatches() {
    if (!subject_.flat || best().painting != Painting::vertices) return Answer::worse;
    return ask_with([](Recipe& r) { r.painting = Painting::swatches; });
  }

  /// Normals and edges of colour pay together, or one of them alone.
  Answer choose_shading_of_vertices() {
    bool const in_vertices = best().painting == Painting::vertices || best().painting == Painting::swatches;
    return in_vertices ? choose_shading() : Answer::worse;
  }

  Answer choose_colour_quadrics() {
    bool const in_vertices = subject_.coloured && !is_textured(best());
    if (!in_vertices || is_whole(best_trial())) return Answer::worse;
    return ask_with([](Recipe& r) { r.colour_weight = 0.02; });
  }

  static void more_texels(Recipe& recipe) { recipe.texture = recipe.texture * 5 / 4; }

  Answer choose_texture() {
    if (!is_textured(best())) return Answer::worse;
    return walk(&Search::ask, more_texels, [](Recipe& r) { r.texture = r.texture * 4 / 5; });
  }

  Answer choose_share() {
    if (!is_filled(best())) return Answer::worse;
    return walk(
        &Search::ask_as_it_is, [](Recipe& r) { r.triangles += r.triangles / 4; },
        [](Recipe& r) { r.triangles -= r.triangles / 5; });
  }

  /// Where AVIF was not the better one with more texels, it may be with as many.
  Answer choose_coding() {
    if (!is_textured(best()) || best().avif || !subject_.avif) return Answer::worse;
    Answer answer = ask_with([](Recipe& r) { r.avif = true; });
    for (int step = 0; step < kSteps && answer == Answer::better; ++step) answer = ask_with(more_texels);
    return answer == Answer::none ? answer : choose_chroma();
  }

  /// The map as near to its room, and to itself, as its coding can bring it.
  Answer polish() {
    if (!is_textured(best()) || best_trial().map_quality == 0) return Answer::worse;
    Recipe recipe = best();
    recipe.polished = true;
    if (ask_as_it_is(recipe) == Answer::none) return Answer::none;
    take_better(take_last(), kClose);
    return Answer::worse;
  }

  Answer choose_quality() {
    if (!is_textured(best()) || is_filled(best())) return Answer::worse;
    return walk(
        &Search::ask, [](Recipe& r) { r.map_quality -= r.map_quality / 3; },
        [](Recipe& r) { r.map_quality += (100 - r.map_quality) / 3; });
  }

  Answer choose_unfolding() {
    if (best().painting != Painting::map) return Answer::worse;
    for (Unfolding unfolding : {Unfolding::rigid, Unfolding::detail}) {
      Recipe recipe = best();
      recipe.unfolding = unfolding;
      if (answer_to(recipe) == Answer::none) return Answer::none;
    }
    return Answer::worse;
  }

  /// What the simplification did for colours, and where a texture hangs, is kept at first.
  void wear(Shading shading, Recipe& recipe) const {
    bool const kept = shading != Shading::facets && (recipe.colour_weight > 0 || recipe.painting == Painting::own);
    recipe.shading = shading;
    recipe.fitted = !exact_ && !kept;
  }

  Answer ask_wearing(Shading shading) {
    Recipe recipe = best();
    wear(shading, recipe);
    return ask(recipe);
  }

  /// All vertices of what was made, not scanned, lie where they belong.
  bool may_be_exact() const { return is_whole(best_trial()) && (subject_.flat || subject_.creased); }

  /// Where it is close they stay there: the fit pushes faces through those that lie on them, which few views show.
  Answer choose_exact() {
    if (!may_be_exact() || !subject_.flat || !best().fitted) return Answer::worse;
    if (ask_with([](Recipe& r) { r.fitted = false; }) == Answer::none) return Answer::none;
    take_better(take_last(), kClearly);
    exact_ = !best().fitted;
    return Answer::worse;
  }

  Answer choose_fit() {
    bool const stays = best().fitted && !may_be_exact();
    if (stays && (!has_normals(best()) || !subject_.coloured)) return Answer::worse;
    return ask_with([](Recipe& r) { r.fitted = !r.fitted; });
  }

  /// Many facets shade better than fewer smooth triangles, up to some size of the file. Where it is close, coarser
  /// places may yet pay for the facets that they lack.
  Answer choose_shading() {
    if ((aim() < 7000 && !is_whole(best_trial())) || has_normals(best())) return Answer::worse;
    if (normals_lost_[std::size_t(best().painting)]) return Answer::worse;
    Recipe coarser = best();
    fewer_bits(coarser);
    double const facets = cost(best_trial());
    Answer const answer = ask_wearing(Shading::smooth);
    bool const clear = answer != Answer::better || cost(best_trial()) < facets - kClearly;
    if (clear || is_filled(best()) || is_left_out(Choice::bits)) return answer;
    return ask(coarser) == Answer::none ? Answer::none : Answer::better;
  }

  /// Edges are lit as the original's, at the cost of as many more normals.
  Answer choose_creases() {
    if (!subject_.creased || is_left_out(Choice::normals)) return Answer::worse;
    Recipe recipe = best();
    if (!has_normals(recipe)) wear(Shading::smooth, recipe);
    recipe.shading = Shading::creased;
    return ask(recipe);
  }

  /// Neither facets nor normals show what they are worth while coarse places spoil the surface. Where normals pay after
  /// all, places may be coarser again: they no longer decide how it is lit.
  Answer reconsider_shading() {
    if (best().position_bits <= Recipe{}.position_bits) return Answer::worse;
    if (has_normals(best()) && !is_textured(best())) return ask_wearing(Shading::facets);
    Answer answer = best().position_bits > Recipe{}.position_bits + 1 ? choose_shading() : Answer::worse;
    while (answer == Answer::better) answer = ask_with(fewer_bits);
    return answer;
  }

  static void fewer_bits(Recipe& recipe) { recipe.position_bits = std::max(recipe.position_bits - 1, kLeastBits); }

  /// How map and triangles share the bytes depends on what coarse places spoil.
  Answer choose_bits_under_a_map() { return is_filled(best()) ? walk_bits(&Search::ask_as_it_is) : Answer::worse; }
  Answer choose_bits() { return is_filled(best()) ? Answer::worse : walk_bits(&Search::ask); }

  Answer walk_bits(Answer (Inquiry::*question)(Recipe)) {
    constexpr int steps = kExactBits - kLeastBits;
    Change const to_most = [](Recipe& r) { r.position_bits = std::min(r.position_bits + 1, kMostBits); };
    Change const to_exact = [](Recipe& r) { r.position_bits = std::min(r.position_bits + 1, kExactBits); };
    Change const more = is_whole(best_trial()) ? to_exact : to_most;
    return aim() < 11000 ? walk(question, fewer_bits, more, steps) : walk(question, more, fewer_bits, steps);
  }

  Answer choose_normal_bits() {
    if (!has_normals(best())) return Answer::worse;
    return walk(
        is_filled(best()) ? &Search::ask_as_it_is : &Search::ask,
        [](Recipe& r) { r.normal_bits = std::min(r.normal_bits + 1, kMostNormalBits); },
        [](Recipe& r) { r.normal_bits = std::max(r.normal_bits - 1, kLeastNormalBits); });
  }

  Answer choose_colours() {
    if (best().painting != Painting::vertices) return Answer::worse;
    bool const whole = is_whole(best_trial()), small = aim() < 12000 && !whole;
    Change const fewer = [](Recipe& r) { --r.colour_bits; };
    Change const more = [](Recipe& r) { r.colour_bits = std::min(r.colour_bits + 1, kMostColourBits); };
    Answer bits = ask_with(small ? fewer : more);
    while (whole && bits == Answer::better) bits = ask_with(more);
    if (bits == Answer::none) return bits;
    return small ? ask_with([](Recipe& r) { r.smoothing *= 10; }) : ask_with([](Recipe& r) { r.smoothing /= 10; });
  }

  Subject subject_;
  std::array<bool, EnumNames<Painting>::names.size()> normals_lost_{};  ///< against facets, clearly
  bool exact_ = false;  ///< vertices are not fitted, as that won where there is room for all
  FitOptions options_;
  std::span<Trial const> history_;
};

}  // namespace

bool is_textured(Recipe const& recipe) { return recipe.painting == Painting::map || recipe.painting == Painting::own; }

bool is_filled(Recipe const& recipe) { return is_textured(recipe) && recipe.map_quality == 0; }

std::optional<Recipe> next_trial(Subject const& subject, FitOptions const& options, std::span<Trial const> history) {
  return Search(subject, options, history).next();
}

}  // namespace vitrine
