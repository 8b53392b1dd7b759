// SPDX-License-Identifier: Apache-2.0
#include "stages/inquiry.h"

#include "stages/byte_model.h"
#include "stages/landing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace vitrine {
namespace {

constexpr double kFill = 0.975;        ///< of the ceiling: what explorations aim for
constexpr double kFirstKb = 8;         ///< where a search by error begins
constexpr double kMiss = 0.12;         ///< relative: a trial this far from what was aimed at is asked again
constexpr double kSame = 0.02;         ///< relative: between numbers of triangles
constexpr double kHopeless = 0.7;      ///< in the cost's logarithm
constexpr double kMostMapShare = 0.8;  ///< of the bytes: a map that no quality makes smaller has too many texels
constexpr double kExcessPower = 3;     ///< with which error rises where a map that fits at no quality is made to fit
constexpr int kSmallestFile = 1000;    ///< bytes
constexpr int kLargestTexture = 8192;
constexpr int kLandings = 9;  ///< trials that may be spent on meeting the limit

}  // namespace

double size_cost(Trial const& trial) {
  return std::log(std::max(trial.score, 1e-9)) + kErrorPower * std::log(double(trial.bytes));
}

Inquiry::Inquiry(Subject const& subject, FitOptions const& options, std::span<Trial const> history)
    : subject_(subject), options_(options), history_(history), usual_(ceiling()) {
  if (options_.max_error > 0) usual_ = std::min(1000 * kFirstKb, usual_);
}

double Inquiry::aim() const { return kFill * usual_; }

int Inquiry::most() const { return int(std::min<std::size_t>(subject_.triangles, 1u << 20)); }

Inquiry::Answer Inquiry::ask_with(Change change) {
  Recipe recipe = best();
  change(recipe);
  return ask(recipe);
}

Inquiry::Answer Inquiry::walk(Answer (Inquiry::*question)(Recipe), Change one, Change other, int steps) {
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

Inquiry::Answer Inquiry::ask(Recipe recipe) {
  std::size_t const before = best_;
  recipe.texture = std::min(recipe.texture, largest_texture(recipe));
  recipe.triangles = affordable(recipe);
  if (is_tried(recipe)) return Answer::worse;
  Answer answer = answer_to(recipe);
  if (answer == Answer::none) return answer;
  Trial const& first = history_[answered_ - 1];
  if (subject_.fixed_triangles > 0 || is_hopeless(first) || std::abs(std::log(double(first.bytes) / aim())) < kMiss)
    return answer;
  double const share = double(first.map_bytes) / aim();
  bool const too_large = share > (is_filled(recipe) ? kMostMapShare : kMapShare);
  if (too_large) recipe.texture = std::max(kSmallestTexture, int(recipe.texture * std::sqrt(kMapShare / share)));
  double const map_bytes = too_large ? kMapShare * aim() : double(first.map_bytes);
  recipe.triangles = is_filled(recipe) ? beside(map_bytes, recipe) : affordable(recipe);
  if (is_tried(recipe)) return answer;
  answer = answer_to(recipe);
  return answer == Answer::none ? answer : best_ == before ? Answer::worse : Answer::better;
}

int Inquiry::largest_texture(Recipe const& recipe) const {
  return recipe.painting == Painting::own ? subject_.own_texture : kLargestTexture;
}

int Inquiry::affordable(Recipe const& recipe) const {
  if (subject_.fixed_triangles > 0) return int(subject_.fixed_triangles);
  if (!is_filled(recipe)) return bounded(ByteModel(recipe, history_.first(answered_)).triangles(aim()));
  bool const like_best = answered_ > 0 && best().painting == recipe.painting;
  if (like_best && is_whole(history_[best_])) return bounded(most());
  return like_best ? bounded(int(best().triangles / relative_size(recipe, best()))) : beside(kMapShare * aim(), recipe);
}

/// Triangles that there is room for beside a map of so many bytes.
int Inquiry::beside(double map_bytes, Recipe const& recipe) const {
  return bounded(ByteModel(recipe, history_.first(answered_)).triangles_beside(map_bytes, aim()));
}

/// Nearly all are all.
int Inquiry::bounded(int triangles) const {
  bool const whole = triangles > most() - most() / 50;
  return std::max(kFewest, whole ? most() : triangles);
}

Inquiry::Answer Inquiry::ask_as_it_is(Recipe recipe) {
  recipe.triangles = bounded(recipe.triangles);
  return is_tried(recipe) ? Answer::worse : answer_to(recipe);
}

Inquiry::Answer Inquiry::answer_to(Recipe recipe) {
  asked_ = recipe;
  if (answered_ == history_.size()) return Answer::none;
  bool const better = answered_ == 0 || cost(history_[answered_]) < cost(history_[best_]) - 0.01;
  if (better) best_ = answered_;
  ++answered_;
  return better ? Answer::better : Answer::worse;
}

bool Inquiry::is_hopeless(Trial const& trial) const { return cost(trial) > cost(history_[best_]) + kHopeless; }

/// Logarithm of the error that the recipe would have with as many triangles as the bytes allow.
double Inquiry::cost(Trial const& trial) const {
  if (std::isinf(trial.error)) return trial.error;
  if (subject_.fixed_triangles > 0) return size_cost(trial);
  if (is_filled(trial.recipe)) {
    double const filled = std::log(double(trial.bytes) / trial.recipe.ceiling);
    bool const could_be_finer = trial.map_quality > 0 && trial.map_quality < kBestQuality;
    double const power = filled > 0 ? kExcessPower : could_be_finer ? kErrorPower : 0;
    return std::log(std::max(trial.score, 1e-9)) + power * filled;
  }
  double const allowed = (aim() - kHeaderBytes - double(trial.map_bytes)) / bytes_per_triangle(trial);
  double const triangles = std::clamp(allowed, 1.0, std::max(1.0, double(most())));
  return std::log(std::max(trial.score, 1e-9)) - kErrorPower * std::log(triangles / trial.recipe.triangles);
}

std::optional<Recipe> Inquiry::land() {
  bool const by_error = options_.max_error > 0, by_map = is_filled(best());
  Landing const limits{ceiling(), options_.max_error, by_map ? kSmallestFile : kFewest,
                       by_map ? int(ceiling()) : most()};
  std::vector<Trial> like;
  for (std::size_t i = 0; i < answered_; ++i)
    if (is_like(history_[i])) like.push_back(history_[i]);
  for (int landing = 0; landing < kLandings && !like.empty(); ++landing) {
    std::optional<int> const extent = by_error ? extent_for_error(like, limits) : triangles_for_bytes(like, limits);
    if (!extent) return {};
    asked_ = of_extent(history_[best_], *extent);
    if (answered_ == history_.size()) return asked_;
    if (is_like(history_[answered_])) like.push_back(history_[answered_]);
    ++answered_;
  }
  return {};
}

Recipe Inquiry::of_extent(Trial const& like, int wanted) const {
  Recipe recipe = like.recipe;
  if (!is_filled(recipe)) {
    recipe.triangles = wanted;
    return recipe;
  }
  double const growth = double(wanted) / recipe.ceiling;
  double const geometry = kHeaderBytes + bytes_per_triangle(like) * recipe.triangles;
  double const share = std::clamp((1 - geometry / recipe.ceiling) / 2, 0.0, kMapShare);
  double const room = (wanted * (1 - share) - kHeaderBytes) / bytes_per_triangle(like);
  double const triangles = !is_whole(like) ? recipe.triangles * growth : growth >= 1 ? recipe.triangles : room;
  recipe.triangles = bounded(int(std::clamp(triangles, 0.0, double(most()))));
  recipe.ceiling = wanted;
  recipe.texture = std::clamp(int(recipe.texture * std::sqrt(growth)), kSmallestTexture, largest_texture(recipe));
  return recipe;
}

bool Inquiry::is_like(Trial const& trial) const {
  return trial.recipe == of_extent(history_[best_], extent(trial.recipe)) && !std::isinf(trial.error);
}

bool Inquiry::is_tried(Recipe const& recipe) const {
  auto const tried = history_.first(answered_);
  return std::any_of(tried.begin(), tried.end(), [&](Trial const& trial) {
    Recipe alike = trial.recipe;
    if (std::abs(alike.triangles - recipe.triangles) <= kSame * recipe.triangles) alike.triangles = recipe.triangles;
    if (!is_filled(recipe)) alike.ceiling = recipe.ceiling;
    return alike == recipe;
  });
}

Inquiry::Answer Inquiry::resize() {
  constexpr int kMost = 2;
  std::size_t const like = best_;
  std::optional<std::size_t> before;
  for (int resized = 0; resized < kMost; ++resized) {
    double const needed = bytes_for_error(history_[best_], before ? &history_[*before] : nullptr);
    double const size = std::clamp(needed, std::min(1.0 * kSmallestFile, ceiling()), ceiling());
    if (std::abs(std::log(size / usual_)) < kMiss) break;
    usual_ = size;
    Recipe recipe = of_extent(history_[like], is_filled(best()) ? int(size) : affordable(best()));
    recipe.ceiling = int(size);
    if (is_tried(recipe)) break;
    if (answer_to(recipe) == Answer::none) return Answer::none;
    before = std::exchange(best_, answered_ - 1);
  }
  return Answer::worse;
}

/// By the power of the bytes with which error fell between two trials, or usually falls.
double Inquiry::bytes_for_error(Trial const& here, Trial const* before) const {
  constexpr double kLeastPower = 0.5, kMostPower = 6;
  double power = kErrorPower;
  if (before && before->bytes != here.bytes)
    power = std::log(before->error / here.error) / std::log(double(here.bytes) / double(before->bytes));
  double const excess = std::max(here.error, 1e-6) / options_.max_error;
  return double(here.bytes) *
         std::pow(excess, 1 / (power > 0 ? std::clamp(power, kLeastPower, kMostPower) : kErrorPower));
}

}  // namespace vitrine
