// SPDX-License-Identifier: Apache-2.0
// Decides by tags which objects of OpenStreetMap are built.
// Keys are those of https://wiki.openstreetmap.org/wiki/Map_features.
#pragma once
#include <array>
#include <osmium/osm/tag.hpp>
#include <string_view>

#include "imports/building_tags.hpp"

namespace wavetracer::imports {

constexpr auto kept_tags = std::to_array<const char*>({"building",
                                                       "building:part",
                                                       "height",
                                                       "building:height",
                                                       "est_height",
                                                       "min_height",
                                                       "building:min_height",
                                                       "building:levels",
                                                       "building:min_level",
                                                       "building:levels:underground",
                                                       "roof:levels",
                                                       "roof:height",
                                                       "roof:shape",
                                                       "layer",
                                                       "building:material",
                                                       "building:facade:material",
                                                       "building:cladding",
                                                       "roof:material",
                                                       "location",
                                                       "diameter_crown",
                                                       "leaf_type"});

inline bool is_yes(const osmium::TagList& tags, const char* key) {
  const char* const value = tags.get_value_by_key(key);
  return value && std::string_view(value) != "no";
}
inline bool is_tree(const osmium::TagList& tags) { return tags.has_tag("natural", "tree"); }
inline bool is_row(const osmium::TagList& tags) { return tags.has_tag("natural", "tree_row"); }
inline bool is_wood(const osmium::TagList& tags) {
  return tags.has_tag("natural", "wood") || tags.has_tag("landuse", "forest");
}
inline Tags kept_of(const osmium::TagList& tags) {
  Tags out;
  for (const char* key : kept_tags)
    if (const char* const value = tags.get_value_by_key(key)) out[key] = value;
  return out;
}

// Returns the kind of an object that attenuates waves and is no building, or empty for other objects. The first three
// are built if ImportOptions::vegetation asks for them, the others never.
inline std::string_view greenery(const osmium::TagList& tags) {
  if (is_tree(tags)) return "tree (natural=tree)";
  if (is_row(tags)) return "row of trees (natural=tree_row)";
  if (is_wood(tags)) return "forest (landuse=forest, natural=wood)";
  if (tags.has_tag("barrier", "hedge")) return "hedge (barrier=hedge)";
  if (tags.has_tag("natural", "scrub")) return "scrub (natural=scrub)";
  if (tags.has_tag("landuse", "orchard")) return "orchard (landuse=orchard)";
  return {};
}
inline bool is_building(const osmium::TagList& tags) {
  return is_yes(tags, "building") || is_yes(tags, "building:part");
}
// Returns the kind of greenery that is not built, or empty. vegetation: trees, rows and woods are built.
inline std::string_view left_out_greenery(const osmium::TagList& tags, bool vegetation) {
  const bool built = is_building(tags) || (vegetation && (is_tree(tags) || is_row(tags) || is_wood(tags)));
  return built ? std::string_view() : greenery(tags);
}

}  // namespace wavetracer::imports
