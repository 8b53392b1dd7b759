// SPDX-License-Identifier: Apache-2.0
#include "graph/study.h"

#include "stages/byte_model.h"

#include <algorithm>
#include <utility>

namespace vitrine::graph {
namespace {

/// The options as a recipe has them. Colours and shapes are fitted, so the maps need no normals.
ModelOptions with_recipe(ModelOptions options, Recipe const& recipe) {
  options.simplify.triangles = recipe.triangles;
  options.quantize.position_bits = recipe.position_bits;
  options.quantize.normal_bits = recipe.normal_bits;
  options.parameterize.unfolding = recipe.unfolding;
  options.pack.texture = recipe.texture;
  options.bake.samples = 4;
  options.bake.normal_map = false;
  options.bake.vertex_normals = has_normals(recipe);
  if (recipe.map_quality > 0) options.encode.colour_quality = recipe.map_quality;
  if (recipe.avif) options.encode.colour_codec = MapCodec::avif;
  options.encode.full_chroma = recipe.full_chroma;
  options.encode.draft = !recipe.polished;
  return options;
}

/// What --triangles and --texture leave open.
ModelOptions settled(ModelOptions options) {
  if (options.simplify.triangles == 0) options.simplify.triangles = SimplifyOptions{}.triangles;
  if (options.pack.texture == 0) options.pack.texture = PackOptions{}.texture;
  return options;
}

}  // namespace

Study::Study(Subject const& subject, ModelOptions const& options)
    : subject_(subject), options_(options), trial_options_(settled(options)) {}

bool Study::advance() {
  if (!searches(options_)) return history_.empty();
  std::optional<Recipe> const next = next_trial(subject_, options_.fit, history_);
  if (!next) return false;
  recipe_ = *next;
  makings_ = best_makings_.shared_with(recipe_);
  trial_options_ = with_recipe(options_, recipe_);
  if (int const quality = first_quality(); is_filled(recipe_) && quality > 0)
    trial_options_.encode.colour_quality = quality;
  return true;
}

/// Where the quality of the recipe's map is looked for first, by the best map in its coding, or else in another; 0
/// where there is none.
int Study::first_quality() const {
  Trial const* like = nullptr;
  for (Trial const& trial : history_)
    if (trial.map_quality > 0 && (!like || std::pair(trial.recipe.avif != recipe_.avif, trial.score) <
                                               std::pair(like->recipe.avif != recipe_.avif, like->score)))
      like = &trial;
  return like ? likely_quality(recipe_, *like) : 0;
}

bool Study::wants_atlas() const { return !searches(options_) || recipe_.painting == Painting::map; }

void Study::add(Made const& made, std::shared_ptr<EncodedThumbnail const> file, double error, double score) {
  std::size_t const maps = made.bytes.colour + made.bytes.normal + made.bytes.occlusion;
  history_.push_back({recipe_, made.bytes.total, maps, file->colour_quality, error, score});
  made_.push_back({made, std::move(file)});
  if (!searches(options_)) return;
  if (score < best_score_) {
    best_score_ = score;
    best_makings_ = std::move(makings_);
    best_makings_.made = made;
  }
  made_.back().made.recipe = recipe_;
  made_.back().made.map_quality = made_.back().file->colour_quality;
}

void Study::add_failure(Failure const& failure) {
  history_.push_back(failed_trial(recipe_));
  made_.emplace_back();
  last_failure_ = failure;
}

Failure const* Study::failure() const {
  bool const any = std::any_of(made_.begin(), made_.end(), [](Winner const& made) { return made.file != nullptr; });
  return any ? nullptr : &last_failure_;
}

Study::Winner const& Study::winner() const {
  return made_[searches(options_) ? best_trial(subject_, options_.fit, history_) : 0];
}

}  // namespace vitrine::graph
