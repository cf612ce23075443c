// Reading of the tags. Keys are those of https://wiki.openstreetmap.org/wiki/Simple_3D_Buildings.
// Assumes heights of up to 1000 m and 300 levels: more is a slip of the pen.
#include "imports/building_tags.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "imports/vegetation_tags.hpp"

namespace wavetracer::imports {
namespace {

constexpr double highest_m = 1000, most_levels = 300;
constexpr double foot_m = 0.3048, inch_m = 0.0254;

void skip_blanks(std::string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
}

// Takes a number without exponent from the front of the text; the comma of many languages is a point.
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

std::optional<double> parse_levels(std::string_view text) {
  skip_blanks(text);
  const auto value = take_number(text);
  return value && text.empty() && *value >= 0 && *value <= most_levels ? value : std::nullopt;
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

std::optional<double> parse_length_m(std::string_view text) {
  skip_blanks(text);
  const auto value = take_number(text);
  if (!value) return {};
  if (text.empty() || text == "m" || text == "metres" || text == "meters" || text == "metre" || text == "meter") {
    return value;
  }
  if (text == "ft" || text == "feet" || text == "foot") return *value * foot_m;
  if (text.front() != '\'') return {};
  text.remove_prefix(1);
  skip_blanks(text);
  if (text.empty()) return *value * foot_m;
  const auto inches = take_number(text);
  if (!inches || text != "\"") return {};
  return *value * foot_m + *inches * inch_m;
}

std::string_view itu_material(std::string_view value) {
  const auto found = std::find_if(materials.begin(), materials.end(), [&](const Entry& e) { return e.value == value; });
  return found == materials.end() ? std::string_view{} : found->itu;
}

std::optional<Shape> building_shape(const Tags& tags, const ImportOptions& options,
                                    std::map<std::string, uint64_t>& guessed,
                                    std::map<std::string, uint64_t>& left_out) {
  if (says_yes(tags, "vegetation")) return vegetation_shape(tags, guessed);
  if (tag(tags, "location") == "underground") {
    ++left_out["underground"];
    return {};
  }
  if (tag(tags, "building") == "roof" || tag(tags, "building:part") == "roof") {
    ++left_out["roof on posts"];
    return {};
  }
  Shape shape;
  const auto levels = parse_levels(tag(tags, "building:levels"));
  const std::string_view height_text = tag(tags, "height");
  const auto height = parse_length_m(height_text);
  const bool height_is_good = height && *height > 0 && *height <= highest_m;
  if (!height_text.empty() && !height_is_good) ++guessed["height that cannot be read"];
  if (height_is_good) {
    shape.top_m = *height;
  } else if (levels && *levels > 0) {
    shape.top_m = (*levels + parse_levels(tag(tags, "roof:levels")).value_or(0)) * options.level_height_m;
  } else {
    shape.top_m = options.default_height_m;
    ++guessed["neither height nor levels given: default height used"];
  }
  const auto min_height = parse_length_m(tag(tags, "min_height"));
  const auto min_level = parse_levels(tag(tags, "building:min_level"));
  shape.bottom_m = std::max(0.0, min_height.value_or(min_level.value_or(0) * options.level_height_m));
  if (shape.bottom_m >= shape.top_m) {
    ++left_out["min_height is above the height"];
    return {};
  }
  const std::string_view roof = tag(tags, "roof:shape");
  if (!roof.empty() && roof != "flat") ++guessed["roof that is not flat: built flat at its full height"];
  shape.walls = material(tags, "building:material", options.wall_material, guessed);
  shape.roof = material(tags, "roof:material", options.roof_material, guessed);
  return shape;
}

}  // namespace wavetracer::imports
