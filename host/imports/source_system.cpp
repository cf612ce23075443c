// SPDX-License-Identifier: Apache-2.0
// Recognises codes of systems in all the spellings that files have, and makes PROJ's objects for them.
// The text is not trusted: only a code of digits reaches PROJ.
#include "imports/source_system.hpp"

#include <fmt/format.h>
#include <proj.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <vector>

#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr double beyond_area_deg = 2;  // a model may reach this far outside of the area of its system

struct SurveyName {
  std::string_view name, code;
};
constexpr auto survey_names = std::to_array<SurveyName>({{"ETRS89_UTM31", "EPSG:25831"},
                                                         {"ETRS89_UTM32", "EPSG:25832"},
                                                         {"ETRS89_UTM33", "EPSG:25833"},
                                                         {"DE_DHDN_3GK2", "EPSG:31466"},
                                                         {"DE_DHDN_3GK3", "EPSG:31467"},
                                                         {"DE_DHDN_3GK4", "EPSG:31468"},
                                                         {"DE_DHDN_3GK5", "EPSG:31469"}});

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string system_code(std::string_view text) {
  std::string upper(text.substr(0, 500));
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (upper.find("CRS84") != upper.npos) return "OGC:CRS84";
  if (upper.find("ADV:CRS:") != upper.npos)
    for (const auto& [name, code] : survey_names)
      if (upper.find(name) != upper.npos) return std::string(code);
  const size_t begin = upper.find("EPSG");
  if (begin == upper.npos) return {};
  const size_t end = std::min(upper.find_first_of(",;+*&? ", begin), upper.size());
  size_t last = end;  // the last run of four to six digits is the code: versions come before it
  while (last > begin && !is_digit(upper[last - 1])) --last;
  size_t first = last;
  while (first > begin && is_digit(upper[first - 1])) --first;
  return last - first >= 4 && last - first <= 6 ? "EPSG:" + upper.substr(first, last - first) : std::string();
}

struct SourceSystem::State {
  PJ_CONTEXT* context = proj_context_create();
  PJ* transformation = nullptr;  // converts from the system's order of axes to (longitude, latitude) in degrees
  std::string name, code;
  double west = -180, south = -90, east = 180, north = 90;
  double metres_per_height = 1;
  bool above_ellipsoid = false, by_authority = true, first_is_second = false, against = false;
  std::vector<PJ*> owned;

  ~State() {
    for (PJ* const object : owned) proj_destroy(object);
    proj_destroy(transformation);
    proj_context_destroy(context);
  }
  PJ* own(PJ* object) {
    if (object) owned.push_back(object);
    return object;
  }

  // Returns nothing if the point has no place.
  std::optional<glm::dvec2> place(const glm::dvec2& p, bool swap) const {
    proj_errno_reset(transformation);
    const PJ_COORD out =
        proj_trans(transformation, PJ_FWD, swap ? proj_coord(p.y, p.x, 0, 0) : proj_coord(p.x, p.y, 0, 0));
    if (!std::isfinite(out.xy.x) || !std::isfinite(out.xy.y)) return {};
    return glm::dvec2(out.xy.x, out.xy.y);
  }
  bool inside(const glm::dvec2& p) const {
    if (!(p.y >= south - beyond_area_deg && p.y <= north + beyond_area_deg)) return false;
    if (west <= east) return p.x >= west - beyond_area_deg && p.x <= east + beyond_area_deg;
    return p.x >= west - beyond_area_deg || p.x <= east + beyond_area_deg;  // the area crosses the date line
  }
  // Returns a positive number if the coordinates have the orientation of east and north.
  double handedness(const glm::dvec2& p, bool swap) const {
    const auto origin = place(p, swap);
    const double step = std::abs(p.x) <= 360 && std::abs(p.y) <= 360 ? 1e-4 : 10;  // a step in degrees or in metres
    const auto x = place(p + glm::dvec2(step, 0), swap), y = place(p + glm::dvec2(0, step), swap);
    if (!origin || !x || !y) return 0;
    return (x->x - origin->x) * (y->y - origin->y) - (x->y - origin->y) * (y->x - origin->x);
  }

  double unit_of_axis(const PJ* crs, int axis) const {
    double factor = 1;
    PJ* const system = proj_crs_get_coordinate_system(context, crs);
    if (system)
      proj_cs_get_axis_info(context, system, axis, nullptr, nullptr, nullptr, &factor, nullptr, nullptr, nullptr);
    proj_destroy(system);
    return factor;
  }
  // Returns the part of the system for longitude and latitude, or east and north; sets the meaning of heights.
  const PJ* horizontal(const PJ* crs) {
    const PJ_TYPE type = proj_get_type(crs);
    if (type == PJ_TYPE_COMPOUND_CRS) {
      if (const PJ* vertical = own(proj_crs_get_sub_crs(context, crs, 1)))
        metres_per_height = unit_of_axis(vertical, 0);
      return own(proj_crs_get_sub_crs(context, crs, 0));
    }
    if (type == PJ_TYPE_GEOGRAPHIC_3D_CRS) {
      above_ellipsoid = true;
      metres_per_height = unit_of_axis(crs, 2);
      return crs;  // heights do not change longitudes and latitudes
    }
    // The default if the system says nothing else.
    if (type == PJ_TYPE_PROJECTED_CRS) metres_per_height = unit_of_axis(crs, 0);
    return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_PROJECTED_CRS ? crs : nullptr;
  }
};

SourceSystem::SourceSystem(const std::string& text, const std::string& name) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.name = name;
  s.code = system_code(text);
  const std::string shown(text.substr(0, 100));
  if (s.code.empty())
    throw InputError(fmt::format(
        "{}: the coordinate system '{}' is not one of EPSG; name it by its code, such as EPSG:25832", name, shown));
  proj_log_level(s.context, PJ_LOG_NONE);
  proj_context_set_enable_network(s.context, 0);
  const PJ* const crs = s.own(proj_create(s.context, s.code.c_str()));
  if (!crs && !proj_context_get_database_path(s.context))
    throw RuntimeError(
        fmt::format("{}: the coordinate system {} is looked up in the database of PROJ, and there is none: "
                    "install Debian's proj-data, or name the folder of proj.db in PROJ_DATA",
                    name, s.code));
  const PJ* const horizontal = crs ? s.horizontal(crs) : nullptr;
  if (!horizontal)
    throw InputError(fmt::format("{}: the coordinate system '{}' ({}) {}", name, shown, s.code,
                                 crs ? "is none of places on a map" : "is not known to PROJ"));
  if (!proj_get_area_of_use(s.context, horizontal, &s.west, &s.south, &s.east, &s.north, nullptr) || s.south < -90)
    s.west = -180, s.south = -90, s.east = 180, s.north = 90;
  const PJ* const degrees = s.own(proj_create(s.context, "OGC:CRS84"));
  s.transformation =
      degrees ? proj_create_crs_to_crs_from_pj(s.context, horizontal, degrees, nullptr, nullptr) : nullptr;
  if (!s.transformation) throw InputError(fmt::format("{}: PROJ knows no way from {} to WGS84", name, s.code));
  // "EPSG:4326" alone has always meant longitude first; URNs and URLs use the authority's order.
  const bool is_short = text.size() >= 4 && (text[0] == 'E' || text[0] == 'e') && text.find("://") == text.npos;
  s.by_authority = !is_short;
}
SourceSystem::~SourceSystem() = default;

void SourceSystem::choose_order(const glm::dvec2& middle, double roofs_up) {
  State& s = *state_;
  // The effect of swapping on east and north: the authority's order may be north, east.
  std::array<bool, 2> possible{}, upright{}, east_first{};
  for (const bool swap : {false, true}) {
    const auto place = s.place(middle, swap);
    const double hand = place ? s.handedness(middle, swap) : 0;
    possible[swap] = place && s.inside(*place);
    east_first[swap] = hand > 0;
    upright[swap] = hand * roofs_up > 0;
  }
  if (!possible[0] && !possible[1])
    throw InputError(
        fmt::format("{}: the middle of the model, ({}, {}), is not in the area of its coordinate system {}, "
                    "which is {} to {} degrees east and {} to {} degrees north: is another one meant?",
                    s.name, middle.x, middle.y, s.code, s.west, s.east, s.south, s.north));
  const bool usual = !s.by_authority && !east_first[0] && east_first[1];
  s.first_is_second = usual;
  if (possible[0] != possible[1]) {
    s.first_is_second = possible[1];
  } else if (upright[0] != upright[1]) {
    s.first_is_second = upright[1];
  }
  s.against = s.first_is_second != usual;
  // One transformation is used for all points, so that there are no jumps between them.
  (void)s.place(middle, s.first_is_second);
  if (PJ* const used = proj_trans_get_last_used_operation(s.transformation)) {
    proj_destroy(s.transformation);
    s.transformation = used;
  }
}

bool SourceSystem::swapped() const { return state_->against; }

glm::dvec2 SourceSystem::geographic(const glm::dvec2& file) const {
  const auto out = state_->place(file, state_->first_is_second);
  if (!out)
    throw InputError(fmt::format("{}: ({}, {}) is outside of the area of its coordinate system {}", state_->name,
                                 file.x, file.y, state_->code));
  return *out;
}

double SourceSystem::metres_per_height() const { return state_->metres_per_height; }
bool SourceSystem::above_ellipsoid() const { return state_->above_ellipsoid; }

}  // namespace wavetracer::imports
