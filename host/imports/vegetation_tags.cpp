// SPDX-License-Identifier: Apache-2.0
// Heights above 100 m and crowns wider than 50 m count as mistakes. Heights that are not given are those of OSM2World
// (TreeModule.java: 10 m for trees, 20 m for woods, and trees twice as high as wide).
// Degrees are converted to metres by a sphere: a crown may be wrong by half a percent of its size.
#include "imports/vegetation_tags.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavetracer::imports {
namespace {

constexpr double highest_tree_m = 100, widest_crown_m = 50, usual_tree_m = 10, usual_wood_m = 20;
constexpr double m_per_degree = 111195;

using Counts = std::map<std::string, uint64_t>;
constexpr double least_plant_m = 1e-3;

std::optional<double> tree_height_m(const Tags& tags, Counts& guessed) {
  return tagged_value(
      tags, {"height of a tree or wood", {"height", "est_height"}, parse_length_m, least_plant_m, highest_tree_m},
      guessed);
}

double tree_crown_m(const Tags& tags, double height_m, Counts& guessed) {
  const double slender = tag(tags, "leaf_type") == "needleleaved" ? 1.0 / 3 : 0.5;
  return tagged_value(tags, {"diameter_crown", {"diameter_crown"}, parse_length_m, least_plant_m, widest_crown_m},
                      guessed)
      .value_or(slender * height_m);
}

// Returns metres per unit of both coordinates.
glm::dvec2 metres_at(const glm::dvec2& place, MapUnit unit) {
  if (unit == MapUnit::metre) return {1, 1};
  return {m_per_degree * std::max(std::cos(place.y * std::numbers::pi / 180), 1e-3), m_per_degree};
}

}  // namespace

bool is_vegetation(std::string_view material) { return material.ends_with("vegetation"); }

TreeSize tree_size(const Tags& tags) {
  Counts counted_later;  // vegetation_shape() counts these later
  const double height_m = tree_height_m(tags, counted_later).value_or(usual_tree_m);
  return {height_m, tree_crown_m(tags, height_m, counted_later)};
}

std::vector<glm::dvec2> crown_ring(const glm::dvec2& place, double crown_m, MapUnit unit) {
  constexpr int corners = 8;
  constexpr double angle = 2 * std::numbers::pi / corners;
  const double radius_m = 0.5 * crown_m * std::sqrt(angle / std::sin(angle));
  const glm::dvec2 metres = metres_at(place, unit);
  std::vector<glm::dvec2> out;
  for (int i = 0; i < corners; ++i)
    out.push_back(place + radius_m * glm::dvec2(std::cos(i * angle), std::sin(i * angle)) / metres);
  return out;
}

std::vector<glm::dvec2> planted(const std::vector<glm::dvec2>& line, MapUnit unit) {
  std::vector<glm::dvec2> out;
  double next_m = 0;  // distance along the next piece
  for (size_t i = 1; i < line.size(); ++i) {
    const glm::dvec2 piece_m = (line[i] - line[i - 1]) * metres_at(line[i], unit);
    const double length_m = std::hypot(piece_m.x, piece_m.y);
    for (; next_m < length_m && out.size() <= most_trees_of_row; next_m += tree_distance_m)
      out.push_back(line[i - 1] + (line[i] - line[i - 1]) * (next_m / length_m));
    if (out.size() > most_trees_of_row) break;
    next_m -= length_m;
  }
  return out;
}

Shape vegetation_shape(const Tags& tags, std::map<std::string, uint64_t>& guessed) {
  const std::string_view kind = tag(tags, "vegetation"), leaves = tag(tags, "leaf_type");
  const bool tree = kind != "wood";
  Shape shape;
  shape.plant = kind == "row" ? Plant::tree_of_row : tree ? Plant::tree : Plant::wood;
  const std::optional<double> height_m = tree_height_m(tags, guessed);
  shape.top_m = height_m.value_or(tree ? usual_tree_m : usual_wood_m);
  shape.bottom_m = tree ? shape.top_m / 3 : 0;
  if (tree) tree_crown_m(tags, shape.top_m, guessed);  // only counts: the outline has the crown already
  if (!height_m) ++guessed[tree ? "tree without a height: 10 m used" : "wood without a height: 20 m used"];
  if (tree && tag(tags, "diameter_crown").empty())
    ++guessed["tree without diameter_crown: half of its height used, a third with needles"];
  if (!leaves.empty() && leaves != "broadleaved" && leaves != "needleleaved" && leaves != "mixed")
    ++guessed["leaf_type that is not known: mixed vegetation used"];
  shape.walls = shape.roof = leaves == "broadleaved" ? "deciduous_vegetation" : "vegetation";
  return shape;
}

}  // namespace wavetracer::imports
