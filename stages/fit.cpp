// SPDX-License-Identifier: Apache-2.0
#include "stages/fit.h"

#include "stages/byte_model.h"
#include "stages/error.h"
#include "stages/landing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace vitrine {
namespace {

constexpr double kFill = 0.975;     ///< of the ceiling: what explorations aim for
constexpr double kFirstKb = 8;      ///< where a search by error begins
constexpr double kMiss = 0.12;      ///< relative: a trial this far from what was aimed at is asked again
constexpr double kHopeless = 0.7;   ///< in the cost's logarithm: what is so much worse is not asked again
constexpr double kMapShare = 0.5;   ///< of the bytes: for a first map
constexpr int kUsualQuality = 50;   ///< of a map that does not fill its ceiling, to begin with
constexpr int kSmallestFile = 1000; ///< bytes
constexpr int kSmallestTexture = 16, kLargestTexture = 8192;
constexpr int kFewest = 40;         ///< triangles
constexpr int kSteps = 3;           ///< in one direction
constexpr int kLeastBits = 8, kMostBits = 14;  ///< of a place
constexpr int kFineBits = 13;       ///< of a place, where there is room for all triangles
constexpr int kLandings = 6;        ///< trials that may be spent on meeting the limit

/// Where the number of triangles is fixed, bytes are saved as long as that shows little.
double size_cost(Trial const& trial) {
  return std::log(std::max(trial.score, 1e-9)) + kErrorPower * std::log(double(trial.bytes));
}

/// What the winner has the least of.
double rank(Subject const& subject, FitOptions const& options, Trial const& trial) {
  if (options.max_error > 0) return double(trial.bytes);
  return subject.fixed_triangles > 0 ? size_cost(trial) : trial.score;
}

/// The best trial that keeps within the limits.
std::optional<std::size_t> best_within(Subject const& subject, FitOptions const& options, std::span<Trial const> history) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < history.size(); ++i) {
    Trial const& t = history[i];
    if (double(t.bytes) > 1000 * options.max_kb || (options.max_error > 0 && t.error > options.max_error)) continue;
    if (!best || rank(subject, options, t) < rank(subject, options, history[*best])) best = i;
  }
  return best;
}

class Search {
 public:
  Search(Subject const& subject, FitOptions const& options, std::span<Trial const> history)
      : subject_(subject), options_(options), history_(history), usual_(ceiling()) {
    if (options_.max_error > 0) usual_ = std::min(1000 * kFirstKb, usual_);
  }

  /// Asks the same questions in the same order each time, and answers those that the history answers.
  std::optional<Recipe> next() {
    if (explore() == Answer::none) return asked_;
    if (subject_.fixed_triangles > 0) return {};
    return is_filled(best()) && options_.max_error == 0 ? std::nullopt : land();
  }

 private:
  double ceiling() const { return 1000 * options_.max_kb; }
  double aim() const { return kFill * usual_; }
  int most() const { return int(std::min<std::size_t>(subject_.triangles, 1u << 20)); }

  enum class Answer { none, worse, better };
  using Change = void (*)(Recipe&);

  Answer explore() {
    using Question = Answer (Search::*)();
    constexpr std::pair<Choice, Question> questions[] = {{Choice::none, &Search::start},
                                                         {Choice::none, &Search::choose_size},
                                                         {Choice::none, &Search::choose_painting},
                                                         {Choice::none, &Search::choose_size},
                                                         {Choice::none, &Search::choose_size},  // from nearer
                                                         {Choice::colour_edges, &Search::choose_colour_quadrics},
                                                         {Choice::none, &Search::choose_texture},
                                                         {Choice::none, &Search::choose_share},
                                                         {Choice::avif, &Search::choose_coding},
                                                         {Choice::none, &Search::choose_quality},
                                                         {Choice::unfolding, &Search::choose_unfolding},
                                                         {Choice::normals, &Search::choose_shading},
                                                         {Choice::bits, &Search::choose_bits},
                                                         {Choice::normals, &Search::reconsider_shading},
                                                         {Choice::colours, &Search::choose_colours}};
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
    recipe.ceiling = int(usual_);
    if (subject_.fixed_triangles > 0) recipe.map_quality = kUsualQuality;
    return ask(recipe);
  }

  int first_texture() const {
    double const texels = kMapShare * aim() / expected_bytes_per_texel(kUsualQuality);
    return std::clamp(int(std::sqrt(texels)) / 4 * 4, kSmallestTexture, 1024);
  }

  Answer choose_painting() {
    if (subject_.textured && best().painting == Painting::vertices && !is_left_out(Choice::normals) && choose_shading() == Answer::none)
      return Answer::none;
    for (Painting painting : {Painting::map, Painting::own})
      if (offers(painting) && try_texture(painting) == Answer::none) return Answer::none;
    return Answer::worse;
  }

  bool offers(Painting painting) const {
    if (painting == Painting::own) return subject_.own_texture > 0 && !is_left_out(Choice::own_texture);
    return subject_.textured && !is_left_out(Choice::atlas) && best().painting != Painting::map;
  }

  /// Smooth first where the original has as few triangles as are shown, then the other way, unless that leads nowhere.
  Answer try_texture(Painting painting) {
    Recipe recipe = best();
    recipe.painting = painting;
    recipe.texture = first_texture();
    bool const smooth_first = painting == Painting::own;
    for (Shading shading : {smooth_first ? Shading::smooth : Shading::facets, smooth_first ? Shading::facets : Shading::smooth}) {
      if (shading == Shading::smooth && is_left_out(Choice::normals)) continue;
      recipe.shading = shading;
      if (ask(recipe) == Answer::none) return Answer::none;
      if (is_hopeless(history_[answered_ - 1])) break;
      recipe = asked_;  // its size of the map
    }
    return Answer::worse;
  }

  /// About as many bytes as the error needs: what is best for others need not be best for these.
  Answer choose_size() {
    if (options_.max_error == 0 || subject_.fixed_triangles > 0) return Answer::worse;
    double const needed = usual_ * std::pow(history_[best_].error / options_.max_error, 1 / kErrorPower);
    double const size = std::clamp(needed, std::min(1.0 * kSmallestFile, ceiling()), ceiling());
    if (std::abs(std::log(size / usual_)) < kMiss) return Answer::worse;
    usual_ = size;
    Recipe recipe = of_extent(is_filled(best()) ? int(size) : affordable(best()));
    recipe.ceiling = int(size);
    if (is_tried(recipe)) return Answer::worse;
    Answer const answer = answer_to(recipe);
    if (answer != Answer::none) best_ = answered_ - 1;
    return answer;
  }

  Answer choose_colour_quadrics() {
    if (!subject_.coloured || best().painting == Painting::own || is_whole(history_[best_])) return Answer::worse;
    return ask_with([](Recipe& r) { r.colour_weight = 0.02; });
  }

  Answer choose_texture() {
    if (!is_textured(best())) return Answer::worse;
    return walk(&Search::ask, [](Recipe& r) { r.texture = r.texture * 5 / 4; },
                [](Recipe& r) { r.texture = r.texture * 4 / 5; });
  }

  Answer choose_share() {
    if (!is_filled(best())) return Answer::worse;
    return walk(&Search::ask_as_it_is, [](Recipe& r) { r.triangles += r.triangles / 4; }, [](Recipe& r) { r.triangles -= r.triangles / 5; });
  }

  Answer choose_coding() {
    if (!is_textured(best()) || !subject_.avif) return Answer::worse;
    Recipe recipe = best();
    recipe.avif = true;
    return ask(recipe);
  }

  Answer choose_quality() {
    if (!is_textured(best()) || is_filled(best())) return Answer::worse;
    return walk(&Search::ask, [](Recipe& r) { r.map_quality -= r.map_quality / 3; },
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

  /// Many facets shade better than fewer smooth triangles, up to some size of the file.
  Answer choose_shading() {
    if ((aim() < 7000 && !is_whole(history_[best_])) || best().shading == Shading::smooth) return Answer::worse;
    return ask_with([](Recipe& r) { r.shading = Shading::smooth; });
  }

  /// Normals cannot pay while coarse places spoil the surface.
  Answer reconsider_shading() {
    return best().position_bits > Recipe{}.position_bits + 1 ? choose_shading() : Answer::worse;
  }

  Answer choose_bits() {
    constexpr int steps = kMostBits - kLeastBits;
    Change const fewer = [](Recipe& r) { r.position_bits = std::max(r.position_bits - 1, kLeastBits); };
    Change const more = [](Recipe& r) { r.position_bits = std::min(r.position_bits + 1, kMostBits); };
    return aim() < 11000 ? walk(&Search::ask, fewer, more, steps) : walk(&Search::ask, more, fewer, steps);
  }

  Answer choose_colours() {
    if (best().painting != Painting::vertices) return Answer::worse;
    bool const small = aim() < 12000;
    Answer const bits = small ? ask_with([](Recipe& r) { --r.colour_bits; }) : ask_with([](Recipe& r) { ++r.colour_bits; });
    if (bits == Answer::none) return bits;
    return small ? ask_with([](Recipe& r) { r.smoothing *= 10; }) : ask_with([](Recipe& r) { r.smoothing /= 10; });
  }

  // ---- Answers

  Recipe const& best() const { return history_[best_].recipe; }

  Answer ask_with(Change change) {
    Recipe recipe = best();
    change(recipe);
    return ask(recipe);
  }

  /// One way as long as that pays, else the other way.
  Answer walk(Answer (Search::*question)(Recipe), Change one, Change other, int steps = kSteps) {
    for (Change change : {one, other}) {
      for (int step = 0; step < steps; ++step) {
        Recipe recipe = best();
        change(recipe);
        Answer const answer = (this->*question)(recipe);
        if (answer == Answer::none) return answer;
        if (answer == Answer::worse && step == 0) break;
        if (answer == Answer::worse || step == steps - 1) return answer;
      }
    }
    return Answer::worse;
  }

  /// The recipe with as many triangles as the bytes allow; once more where it misses them by far, as then two recipes
  /// cannot be compared.
  Answer ask(Recipe recipe) {
    std::size_t const before = best_;
    recipe.texture = std::min(recipe.texture, largest_texture(recipe));
    recipe.triangles = affordable(recipe);
    if (is_tried(recipe)) return Answer::worse;
    Answer answer = answer_to(recipe);
    if (answer == Answer::none) return answer;
    Trial const& first = history_[answered_ - 1];
    if (subject_.fixed_triangles > 0 || is_hopeless(first) || std::abs(std::log(double(first.bytes) / aim())) < kMiss) return answer;
    double const share = double(first.map_bytes) / (kMapShare * aim());
    if (share > 1 && !is_filled(recipe)) recipe.texture = std::max(kSmallestTexture, int(recipe.texture / std::sqrt(share)));
    recipe.triangles = is_filled(recipe) ? beside(double(first.map_bytes), recipe) : affordable(recipe);
    if (is_tried(recipe)) return answer;
    answer = answer_to(recipe);
    return answer == Answer::none ? answer : best_ == before ? Answer::worse : Answer::better;
  }

  int largest_texture(Recipe const& recipe) const {
    return recipe.painting == Painting::own ? subject_.own_texture : kLargestTexture;
  }

  int affordable(Recipe const& recipe) const {
    if (subject_.fixed_triangles > 0) return int(subject_.fixed_triangles);
    if (!is_filled(recipe)) return bounded(ByteModel(recipe, history_.first(answered_)).triangles(aim()));
    bool const like_best = answered_ > 0 && best().painting == recipe.painting;
    if (like_best && is_whole(history_[best_])) return bounded(most());
    return like_best ? bounded(int(best().triangles / relative_size(recipe, best()))) : beside(kMapShare * aim(), recipe);
  }

  /// Triangles that there is room for beside a map of so many bytes.
  int beside(double map_bytes, Recipe const& recipe) const {
    return bounded(ByteModel(recipe, history_.first(answered_)).triangles_beside(map_bytes, aim()));
  }

  /// Nearly all are all.
  int bounded(int triangles) const {
    bool const whole = triangles > most() - most() / 50;
    return std::max(kFewest, whole ? most() : triangles);
  }

  /// Another split between triangles and map.
  Answer ask_as_it_is(Recipe recipe) {
    recipe.triangles = bounded(recipe.triangles);
    return is_tried(recipe) ? Answer::worse : answer_to(recipe);
  }

  /// What the history says; the better of both recipes is the best one from here on.
  Answer answer_to(Recipe recipe) {
    asked_ = recipe;
    if (answered_ == history_.size()) return Answer::none;
    bool const better = answered_ == 0 || cost(history_[answered_]) < cost(history_[best_]) - 0.01;
    if (better) best_ = answered_;
    ++answered_;
    return better ? Answer::better : Answer::worse;
  }

  bool is_hopeless(Trial const& trial) const { return cost(trial) > cost(history_[best_]) + kHopeless; }

  bool is_whole(Trial const& trial) const { return trial.recipe.triangles >= most(); }

  /// Logarithm of the error that the recipe would have with as many triangles as the bytes allow.
  double cost(Trial const& trial) const {
    if (std::isinf(trial.error)) return trial.error;
    if (subject_.fixed_triangles > 0) return size_cost(trial);
    if (is_filled(trial.recipe) && trial.bytes <= std::size_t(trial.recipe.ceiling)) return std::log(std::max(trial.score, 1e-9));
    double const allowed = (aim() - kHeaderBytes - double(trial.map_bytes)) / bytes_per_triangle(trial);
    double const triangles = std::clamp(allowed, 1.0, std::max(1.0, double(most())));
    return std::log(std::max(trial.score, 1e-9)) - kErrorPower * std::log(triangles / trial.recipe.triangles);
  }

  // ---- The end: as many triangles as the limit allows, or as few as it needs

  std::optional<Recipe> land() {
    bool const by_error = options_.max_error > 0, by_map = is_filled(best());
    Landing const limits{ceiling(), options_.max_error, by_map ? kSmallestFile : kFewest, by_map ? int(ceiling()) : most()};
    std::vector<Trial> like;
    for (std::size_t i = 0; i < answered_; ++i)
      if (is_like(history_[i])) like.push_back(history_[i]);
    for (int landing = 0; landing < kLandings && !like.empty(); ++landing) {
      std::optional<int> const extent = by_error ? extent_for_error(like, limits) : triangles_for_bytes(like, limits);
      if (!extent) return {};
      asked_ = of_extent(*extent);
      if (answered_ == history_.size()) return asked_;
      if (is_like(history_[answered_])) like.push_back(history_[answered_]);
      ++answered_;
    }
    return {};
  }

  /// The best one, larger or smaller; all triangles stay as long as they leave the map its share.
  Recipe of_extent(int wanted) const {
    Recipe recipe = best();
    if (!is_filled(recipe)) {
      recipe.triangles = wanted;
      return recipe;
    }
    double const growth = double(wanted) / recipe.ceiling;
    double const room = (wanted * (1 - kMapShare) - kHeaderBytes) / bytes_per_triangle(history_[best_]);
    double const triangles = is_whole(history_[best_]) ? room : recipe.triangles * growth;
    recipe.triangles = bounded(int(std::clamp(triangles, 0.0, double(most()))));
    recipe.ceiling = wanted;
    recipe.texture = std::clamp(int(recipe.texture * std::sqrt(growth)), kSmallestTexture, largest_texture(recipe));
    return recipe;
  }

  bool is_like(Trial const& trial) const { return trial.recipe == of_extent(extent(trial.recipe)) && !std::isinf(trial.error); }

  bool is_tried(Recipe const& recipe) const {
    auto const tried = history_.first(answered_);
    return std::any_of(tried.begin(), tried.end(), [&](Trial const& trial) { return trial.recipe == recipe; });
  }

  Subject subject_;
  FitOptions options_;
  std::span<Trial const> history_;
  double usual_;  ///< bytes of the files that are compared
  std::size_t answered_ = 0, best_ = 0;
  Recipe asked_;
};

std::string text(double value) {
  std::string digits = std::to_string(value);
  return digits.substr(0, digits.find('.') + 3);
}

}  // namespace

bool is_textured(Recipe const& recipe) { return recipe.painting == Painting::map || recipe.painting == Painting::own; }

bool is_filled(Recipe const& recipe) { return is_textured(recipe) && recipe.map_quality == 0; }

Trial failed_trial(Recipe const& recipe) {
  constexpr double worst = std::numeric_limits<double>::infinity();
  return {recipe, std::numeric_limits<std::size_t>::max(), 0, 0, worst, worst};
}

std::optional<Recipe> next_trial(Subject const& subject, FitOptions const& options, std::span<Trial const> history) {
  return Search(subject, options, history).next();
}

std::size_t best_trial(Subject const& subject, FitOptions const& options, std::span<Trial const> history) {
  if (std::optional<std::size_t> const best = best_within(subject, options, history)) return *best;
  auto const smaller = [](Trial const& a, Trial const& b) { return a.bytes < b.bytes; };
  auto const nearer = [](Trial const& a, Trial const& b) { return a.error < b.error; };
  Trial const smallest = *std::min_element(history.begin(), history.end(), smaller);
  Trial const nearest = *std::min_element(history.begin(), history.end(), nearer);
  if (options.max_error > 0)
    throw Error(ErrorKind::no_solution,
                "no file of " + text(options.max_kb) + " KB has an error of " + text(options.max_error) + "; the least found is " +
                    text(nearest.error) + " at " + text(double(nearest.bytes) / 1000) + " KB",
                "raise --max-kb or --max-error");
  throw Error(ErrorKind::no_solution,
              "no file keeps to " + text(options.max_kb) + " KB; the smallest found has " + text(double(smallest.bytes) / 1000) + " KB",
              "raise --max-kb");
}

}  // namespace vitrine
