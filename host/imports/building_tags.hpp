// What the tags of a building say: heights and materials, by the Simple 3D Buildings scheme of OpenStreetMap.
// Assumes that tags were written by people: what cannot be read falls back to a default and is counted.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "imports/imports.hpp"

namespace wavetracer::imports {

using Tags = std::map<std::string, std::string, std::less<>>;

// Empty where the tag is missing.
std::string_view tag(const Tags& tags, std::string_view key);

// Whether a tag of this kind says that there is something: it is there, and not "no".
bool says_yes(const Tags& tags, std::string_view key);

// "12", "12.5 m", "12,5m", "1250 cm", "40 ft", "40'", "5'6\"", "5 ft 6 in" in metres; empty for anything else.
std::optional<double> parse_length_m(std::string_view text);

// A number that a tag says.
struct TaggedValue {
  std::string_view name;               // in the report
  std::vector<std::string_view> keys;  // the first that can be read counts
  std::optional<double> (*parse)(std::string_view);
  double least, most;  // what is beyond cannot be read
};
// The number, or the largest of several, "2;3", as mappers write them for a house whose wings differ. Empty where there
// is none. What cannot be read, and what has several values, is counted.
std::optional<double> tagged_value(const Tags& tags, const TaggedValue& what, std::map<std::string, uint64_t>& guessed);

// The ITU material of a value of building:material or roof:material, such as "brick" of "roof_tiles"; empty: unknown.
std::string_view itu_material(std::string_view value);

struct Shape {
  double bottom_m = 0, top_m = 0;  // above the ground; bottom 0: it stands on the ground
  std::string walls, roof;         // ITU names
};

// What is built of it; `guessed` counts what the tags do not say. The reason why nothing can be built goes to
// `left_out`, and the answer is empty.
std::optional<Shape> building_shape(const Tags& tags, const ImportOptions& options,
                                    std::map<std::string, uint64_t>& guessed,
                                    std::map<std::string, uint64_t>& left_out);

}  // namespace wavetracer::imports
