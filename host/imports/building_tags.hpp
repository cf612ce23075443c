// SPDX-License-Identifier: Apache-2.0
// Reads heights and materials of a building from its tags, by the Simple 3D Buildings scheme of OpenStreetMap. People
// write tags by hand: a value that cannot be read is replaced by a default and counted.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "imports/imports.hpp"

namespace wavetracer::imports {

using Tags = std::map<std::string, std::string, std::less<>>;

// Returns the value, or empty if the tag is missing.
std::string_view tag(const Tags& tags, std::string_view key);

// Tells whether a tag is present and not "no".
bool says_yes(const Tags& tags, std::string_view key);

// Parses "12", "12.5 m", "12,5m", "1250 cm", "40 ft", "40'", "5'6\"", "5 ft 6 in" to metres; returns nothing for any
// other text.
std::optional<double> parse_length_m(std::string_view text);

// A number that tags give.
struct TaggedValue {
  std::string_view name;               // its name in the report
  std::vector<std::string_view> keys;  // the first tag that can be read counts
  std::optional<double> (*parse)(std::string_view);
  double least, most;  // values outside these limits count as unreadable
};
// Returns the number, or the largest of several ("2;3", as mappers write them for a house whose wings differ), or
// nothing. Values that cannot be read, and lists of values, are counted.
std::optional<double> tagged_value(const Tags& tags, const TaggedValue& what, std::map<std::string, uint64_t>& guessed);

// Returns the ITU material for a value of building:material or roof:material, such as "brick" for "roof_tiles"; empty
// if unknown.
std::string_view itu_material(std::string_view value);

enum class Plant : uint8_t { none, tree, tree_of_row, wood };  // none: a building

struct Shape {
  double bottom_m = 0, top_m = 0;  // heights above the ground; with bottom 0 it stands on the ground
  std::string walls, roof;         // ITU names, or names of wall classes (imports/wall_classes.hpp)
  Plant plant = Plant::none;
};

// Returns the shape to build; `guessed` counts values that the tags do not give. If nothing can be built, it returns
// nothing, and `left_out` counts the reason.
std::optional<Shape> building_shape(const Tags& tags, const ImportOptions& options,
                                    std::map<std::string, uint64_t>& guessed,
                                    std::map<std::string, uint64_t>& left_out);

}  // namespace wavetracer::imports
