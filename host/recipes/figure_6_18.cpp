// Figure 6.18: average time of a frame with a moving end, with reordering against without.
// The thesis drives through traffic; here a transmitter moves through a standing scene.
#include <fmt/format.h>
#include "recipes/ray_counts.hpp"
#include "recipes/recipe.hpp"
#include "recipes/words.hpp"

namespace wavetracer::recipes {
namespace {

std::string paragraph(const std::vector<Row>& rows, const std::string& device) {
  const Series h3dh = ordered("hilbert3d-histogram");
  return fmt::format(
      "Without a cache, the thesis finds reordering to take 23% less time than no reordering (WS) at 1,000 rays and "
      "almost 60% less, 2.5 times the speed, at 49,000, and the gain to grow with the number of rays (section 6.3.2, "
      "figure 6.18). Measured on {}, averaged over {} frames of a moving transmitter, H3DH is {}. The claimed {}; the "
      "claimed {}.{} Rays born in order, which need no sort, are {}.",
      device, rows.back().frames, gain_words(rows, h3dh),
      verdict_words(rows, h3dh, claimed_few, "23%", claimed_gain_few),
      verdict_words(rows, h3dh, claimed_many, "factor of 2.5", claimed_gain_many), reason_words(rows),
      gain_words(rows, born_ordered()));
}

}  // namespace

Recipe figure_6_18() {
  return {.name = "figure-6.18",
          .doc = "average time of a frame while the transmitter moves, reordered against not",
          .title = "Frames of a moving transmitter, with reordering and without",
          .series = {unordered(), ordered("hilbert3d-histogram"), born_ordered()},
          .frames = 20,
          .paragraph = paragraph};
}

}  // namespace wavetracer::recipes
