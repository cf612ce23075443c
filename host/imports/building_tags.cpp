// SPDX-License-Identifier: Apache-2.0
// Reads the tags. Keys are those of https://wiki.openstreetmap.org/wiki/Simple_3D_Buildings.
// Heights may be up to 1000 m and 300 levels: larger values count as mistakes.
#include "imports/building_tags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "imports/vegetation_tags.hpp"
#include "imports/wall_classes.hpp"

namespace wavetracer::imports {
namespace {

constexpr double least_m = 1e-3, highest_m = 1000, most_levels = 300;
constexpr double foot_m = 0.3048, inch_m = 0.0254;

void skip_blanks(std::string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
}

// Takes a number without exponent from the front of the text; a comma counts as a decimal point.
std::optional<double> take_number(std::string_view& text) {
  size_t end = 0;
  while (end < text.size() && ((text[end] >= '0' && text[end] <= '9') || text[end] == '.' || text[end] == ',' ||
                               (end == 0 && text[end] == '-'))) {
    ++end;
  }
  std::string digits(text.substr(0, end));
  if (std::count(digits.begin(), digits.end(), ',') + std::count(digits.begin(), digits.end(), '.') > 1) return {};
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || stop != digits.data() + digits.size()) return {};
  text.remove_prefix(end);
  skip_blanks(text);
  return value;
}

// Levels may be negative, below the ground, as in building:min_level.
std::optional<double> parse_levels(std::string_view text) {
  skip_blanks(text);
  const auto value = take_number(text);
  return value && text.empty() && std::abs(*value) <= most_levels ? value : std::nullopt;
}

struct Unit {
  std::string_view name;
  double metres;
};
constexpr auto units = std::to_array<Unit>({{"m", 1},
                                            {"metre", 1},
                                            {"metres", 1},
                                            {"meter", 1},
                                            {"meters", 1},
                                            {"mtr", 1},
                                            {"cm", 0.01},
                                            {"'", foot_m},
                                            {"ft", foot_m},
                                            {"foot", foot_m},
                                            {"feet", foot_m},
                                            {"\"", inch_m},
                                            {"in", inch_m},
                                            {"inch", inch_m},
                                            {"inches", inch_m}});

// Takes a unit from the front of the text, letters or one sign of feet or inches, and returns its length in metres; 0
// if there is none.
double take_unit(std::string_view& text) {
  size_t end = 0;
  while (end < text.size() && text[end] >= 'a' && text[end] <= 'z') ++end;
  if (end == 0 && !text.empty()) end = 1;
  const auto* const found = std::ranges::find(units, text.substr(0, end), &Unit::name);
  if (found == units.end()) return 0;
  text.remove_prefix(end);
  skip_blanks(text);
  return found->metres;
}

// Returns the text in lower case, with typographic signs of feet and inches replaced by those of a keyboard.
std::string plain(std::string_view text) {
  std::string out(text);
  for (const auto& [from, to] :
       {std::pair<std::string_view, const char*>{"\u2032", "'"}, {"\u2019", "'"}, {"\u2033", "\""}, {"\u201D", "\""}})
    for (size_t at = out.find(from); at != out.npos; at = out.find(from, at)) out.replace(at, from.size(), to);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

struct Entry {
  std::string_view value, itu;
};
constexpr auto materials = std::to_array<Entry>({
    {"concrete", "concrete"},
    {"reinforced_concrete", "concrete"},
    {"cement", "concrete"},
    {"cement_block", "concrete"},
    {"concrete_block", "concrete"},
    {"eternit", "concrete"},
    {"gravel", "concrete"},
    {"tar_paper", "concrete"},
    {"bitumen", "concrete"},
    {"asphalt", "concrete"},
    {"grass", "concrete"},
    {"plaster", "brick"},
    {"stucco", "brick"},
    {"brick", "brick"},
    {"bricks", "brick"},
    {"masonry", "brick"},
    {"clay", "brick"},
    {"adobe", "brick"},
    {"loam", "brick"},
    {"roof_tiles", "brick"},
    {"tile", "brick"},
    {"tiles", "brick"},
    {"slate", "marble"},
    {"stone", "marble"},
    {"sandstone", "marble"},
    {"limestone", "marble"},
    {"granite", "marble"},
    {"marble", "marble"},
    {"wood", "wood"},
    {"timber", "wood"},
    {"timber_framing", "wood"},
    {"log", "wood"},
    {"bamboo", "wood"},
    {"thatch", "wood"},
    {"glass", "glass"},
    {"mirror", "glass"},
    {"acrylic_glass", "glass"},
    {"solar_panels", "glass"},
    {"metal", "metal"},
    {"metal_plates", "metal"},
    {"steel", "metal"},
    {"iron", "metal"},
    {"copper", "metal"},
    {"aluminium", "metal"},
    {"aluminum", "metal"},
    {"zinc", "metal"},
    {"tin", "metal"},
    {"metal_sheet", "metal"},
    {"plasterboard", "plasterboard"},
    {"chipboard", "chipboard"},
    {"plywood", "plywood"},
});

std::string material(const Tags& tags, std::string_view key, const std::string& otherwise,
                     std::map<std::string, uint64_t>& guessed) {
  const std::string_view value = tag(tags, key);
  if (value.empty()) return otherwise;
  const std::string_view known = itu_material(value);
  if (!known.empty()) return std::string(known);
  ++guessed["material that ITU-R P.2040 does not have: " + otherwise];
  return otherwise;
}

}  // namespace

std::string_view tag(const Tags& tags, std::string_view key) {
  const auto found = tags.find(key);
  return found == tags.end() ? std::string_view{} : std::string_view(found->second);
}

bool says_yes(const Tags& tags, std::string_view key) {
  const std::string_view value = tag(tags, key);
  return !value.empty() && value != "no";
}

std::optional<double> parse_length_m(std::string_view given) {
  const std::string lower = plain(given);
  std::string_view text = lower;
  skip_blanks(text);
  const auto value = take_number(text);
  if (!value || text.empty()) return value;
  const double unit_m = take_unit(text);
  if (unit_m == 0) return {};
  if (text.empty()) return *value * unit_m;
  const auto inches = take_number(text);
  if (unit_m != foot_m || !inches || take_unit(text) != inch_m || !text.empty()) return {};
  return *value * foot_m + *inches * inch_m;
}

std::string_view itu_material(std::string_view value) {
  const auto found = std::find_if(materials.begin(), materials.end(), [&](const Entry& e) { return e.value == value; });
  return found == materials.end() ? std::string_view{} : found->itu;
}

std::optional<double> tagged_value(const Tags& tags, const TaggedValue& what,
                                   std::map<std::string, uint64_t>& guessed) {
  for (const std::string_view key : what.keys) {
    std::string_view text = tag(tags, key);
    if (text.empty()) continue;
    std::optional<double> largest;
    size_t count = 0;
    for (; !text.empty(); ++count) {
      const size_t end = std::min(text.find(';'), text.size());
      const auto value = what.parse(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      largest = value && *value >= what.least && *value <= what.most ? std::max(largest.value_or(*value), *value)
                                                                     : std::optional<double>();
      if (!largest) break;
    }
    if (largest && count > 1) ++guessed[fmt::format("several values of {}: the largest is used", what.name)];
    if (largest) return largest;
    ++guessed[fmt::format("{} that cannot be read", what.name)];
  }
  return {};
}

namespace {

// Returns the tag that says that the whole building is below the ground, or empty.
std::string_view below_ground(const Tags& tags) {
  const std::string_view location = tag(tags, "location");
  if (location == "underground") return "underground";
  const auto levels = [&](std::string_view key) { return parse_levels(tag(tags, key)); };
  if (location.empty() && levels("layer").value_or(0) < 0) return "underground: its layer is below 0";
  const bool none_above = levels("building:levels") == 0.0 && tag(tags, "height").empty() &&
                          levels("roof:levels").value_or(0) == 0 && tag(tags, "roof:height").empty();
  if (none_above && (levels("building:levels:underground").value_or(0) > 0 || levels("building:min_level") < 0.0))
    return "underground: all of its levels are";
  return {};
}

// Returns the height of the roof's ridge, from the tags alone.
double top_of(const Tags& tags, const ImportOptions& options, std::map<std::string, uint64_t>& guessed) {
  const auto height = tagged_value(
      tags, {"height", {"height", "building:height", "est_height"}, parse_length_m, least_m, highest_m}, guessed);
  if (height) return *height;
  const auto levels = tagged_value(tags, {"levels", {"building:levels"}, parse_levels, 0, most_levels}, guessed);
  const auto roof = tagged_value(tags, {"roof:height", {"roof:height"}, parse_length_m, 0, highest_m}, guessed);
  const auto roof_levels = tagged_value(tags, {"roof:levels", {"roof:levels"}, parse_levels, 0, most_levels}, guessed);
  if (levels) {
    const double top_m =
        *levels * options.level_height_m + roof.value_or(roof_levels.value_or(0) * options.level_height_m);
    if (top_m > 0) return top_m;
  }
  const bool given = !tag(tags, "height").empty() || !tag(tags, "building:levels").empty();
  ++guessed[given ? "neither height nor levels that can be used: default height used"
                  : "neither height nor levels given: default height used"];
  return options.default_height_m;
}

double bottom_of(const Tags& tags, const ImportOptions& options, std::map<std::string, uint64_t>& guessed) {
  const auto height = tagged_value(
      tags, {"min_height", {"min_height", "building:min_height"}, parse_length_m, -highest_m, highest_m}, guessed);
  const auto level = tagged_value(
      tags, {"building:min_level", {"building:min_level"}, parse_levels, -most_levels, most_levels}, guessed);
  return std::max(0.0, height.value_or(level.value_or(0) * options.level_height_m));
}

}  // namespace

std::optional<Shape> building_shape(const Tags& tags, const ImportOptions& options,
                                    std::map<std::string, uint64_t>& guessed,
                                    std::map<std::string, uint64_t>& left_out) {
  if (says_yes(tags, "vegetation")) return vegetation_shape(tags, guessed);
  if (const std::string_view below = below_ground(tags); !below.empty()) {
    ++left_out[std::string(below)];
    return {};
  }
  if (tag(tags, "building") == "roof" || tag(tags, "building:part") == "roof") {
    ++left_out["roof on posts"];
    return {};
  }
  Shape shape{
      .bottom_m = bottom_of(tags, options, guessed), .top_m = top_of(tags, options, guessed), .walls = {}, .roof = {}};
  if (shape.bottom_m >= shape.top_m) {
    ++left_out["min_height is above the height"];
    return {};
  }
  const std::string_view roof = tag(tags, "roof:shape");
  if (!roof.empty() && roof != "flat") ++guessed["roof that is not flat: built flat at its full height"];
  shape.walls = options.wall_classes ? wall_class_of(tags, options.wall_material, guessed)
                                     : material(tags, "building:material", options.wall_material, guessed);
  shape.roof = material(tags, "roof:material", options.roof_material, guessed);
  return shape;
}

}  // namespace wavetracer::imports
