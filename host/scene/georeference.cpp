// SPDX-License-Identifier: Apache-2.0
// Projects by PROJ and reads the JSON file beside a scene.
// Projection strings come from unknown files, so only plain projections of PROJ are allowed, and none that opens other
// files.
#include "scene/georeference.hpp"

#include <fmt/format.h>
#include <proj.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view file_name = "georeference.json";
constexpr size_t longest_projection = 500, largest_file = 1 << 16;

void check(const std::string& projection) {
  bool plain = projection.starts_with("+proj=") && projection.size() <= longest_projection;
  for (const char* word : {"pipeline", "+init", "grids", "+file", "+step"}) {
    plain = plain && projection.find(word) == std::string::npos;
  }
  for (const char c : projection) plain = plain && c >= ' ' && c <= '~';
  if (!plain) {
    throw InputError(
        fmt::format("the projection '{}' is not a plain PROJ string such as '+proj=utm +zone=32 +ellps=WGS84 +units=m'",
                    projection.substr(0, longest_projection)));
  }
}

}  // namespace

struct Projection::State {
  PJ_CONTEXT* context = proj_context_create();
  PJ* transformation = nullptr;
  glm::dvec2 offset_m{0};
  std::string projection;

  ~State() {
    proj_destroy(transformation);
    proj_context_destroy(context);
  }
  PJ_COORD transform(PJ_DIRECTION direction, double x, double y) const {
    const PJ_COORD out = proj_trans(transformation, direction, proj_coord(x, y, 0, 0));
    if (std::isfinite(out.xy.x) && std::isfinite(out.xy.y)) return out;
    throw InputError(fmt::format("({}, {}) is outside of the area of the projection '{}'", x, y, projection));
  }
};

Projection::Projection(const Georeference& reference) : state_(std::make_unique<State>()) {
  check(reference.projection);
  state_->offset_m = reference.offset_m;
  state_->projection = reference.projection;
  proj_log_level(state_->context, PJ_LOG_NONE);
  proj_context_set_enable_network(state_->context, 0);
  state_->transformation = proj_create(state_->context, reference.projection.c_str());
  if (!state_->transformation || !proj_angular_input(state_->transformation, PJ_FWD)) {
    throw InputError(fmt::format("PROJ does not know the projection '{}'", reference.projection));
  }
}
Projection::~Projection() = default;
Projection::Projection(Projection&&) noexcept = default;

glm::dvec2 Projection::geographic(const glm::dvec2& scene_m) const {
  const PJ_COORD out = state_->transform(PJ_INV, scene_m.x - state_->offset_m.x, scene_m.y - state_->offset_m.y);
  return {proj_todeg(out.lp.lam), proj_todeg(out.lp.phi)};
}

glm::dvec2 Projection::scene(const glm::dvec2& longitude_latitude) const {
  const PJ_COORD out = state_->transform(PJ_FWD, proj_torad(longitude_latitude.x), proj_torad(longitude_latitude.y));
  return glm::dvec2(out.xy.x, out.xy.y) + state_->offset_m;
}

void write_georeference(const std::filesystem::path& file, const Georeference& reference) {
  nlohmann::ordered_json json = {
      {"about", "scene coordinate = coordinate of this PROJ projection + offset, in m"},
      {"projection", reference.projection},
      {"offset_m", {reference.offset_m.x, reference.offset_m.y}},
      {"attribution", reference.attribution},
  };
  if (reference.elevation_m) json["elevation_m"] = *reference.elevation_m;
  write_file(file, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::filesystem::path georeference_file(const std::filesystem::path& scene_file) {
  const std::filesystem::path file = scene_file.parent_path() / file_name;
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) ? file : std::filesystem::path();
}

std::optional<Georeference> find_georeference(const std::filesystem::path& scene_file) {
  const std::filesystem::path file = georeference_file(scene_file);
  if (file.empty()) return {};
  std::error_code error;
  if (std::filesystem::file_size(file, error) > largest_file || error) {
    throw InputError(fmt::format("{}: the file is too large for a georeference", file.string()));
  }
  const nlohmann::json json = nlohmann::json::parse(read_file(file), nullptr, false);
  const auto text = [&](const char* key) {
    if (!json.contains(key)) return std::string();
    if (!json[key].is_string()) throw InputError(fmt::format("{}: \"{}\" must be a string", file.string(), key));
    return json[key].get<std::string>();
  };
  if (!json.is_object() || !json.contains("projection")) {
    throw InputError(fmt::format("{}: must be a JSON object with \"projection\" and \"offset_m\"", file.string()));
  }
  Georeference out{text("projection"), {0, 0}, text("attribution"), {}};
  if (json.contains("offset_m")) {
    const nlohmann::json& offset = json["offset_m"];
    if (!offset.is_array() || offset.size() != 2 || !offset[0].is_number() || !offset[1].is_number()) {
      throw InputError(fmt::format("{}: \"offset_m\" must be two numbers, in m", file.string()));
    }
    out.offset_m = {offset[0].get<double>(), offset[1].get<double>()};
  }
  if (json.contains("elevation_m")) {
    if (!json["elevation_m"].is_number() || !(std::abs(json["elevation_m"].get<double>()) < 1e5))
      throw InputError(
          fmt::format("{}: \"elevation_m\" must be the height of z = 0 above sea level in m", file.string()));
    out.elevation_m = json["elevation_m"].get<double>();
  }
  return out;
}

}  // namespace wavetracer
