// SPDX-License-Identifier: Apache-2.0
#include "imports/mapped_trees.hpp"

#include <fmt/format.h>

#include <utility>

namespace wavetracer::imports {

bool is_tree_point(const Tags& tags) {
  const std::string_view natural = tag(tags, "natural");
  return natural == "tree" || (natural.empty() && !tag(tags, "diameter_crown").empty());
}

bool is_row_line(const Tags& tags) { return tag(tags, "natural") == "tree_row"; }

void plant(Map& map, const std::vector<MappedTrees>& trees, MapUnit unit) {
  size_t of_rows = 0;
  for (const MappedTrees& one : trees) {
    const bool row = one.line.size() > 1;
    const std::vector<glm::dvec2> places = row ? planted(one.line, unit) : one.line;
    if (row && (places.size() > most_trees_of_row || (of_rows += places.size()) > most_trees_of_rows)) {
      ++map.left_out[too_many_trees];
      continue;
    }
    for (size_t i = 0; i < places.size(); ++i) {
      Footprint crown;
      crown.id = row ? fmt::format("{}_{}", one.id, i + 1) : one.id;
      crown.name = one.name;
      crown.tags = one.tags;
      crown.tags.erase("natural");
      crown.tags["vegetation"] = row ? "row" : "tree";
      crown.outer = crown_ring(places[i], tree_size(crown.tags).crown_m, unit);
      map.footprints.push_back(std::move(crown));
    }
  }
}

}  // namespace wavetracer::imports
