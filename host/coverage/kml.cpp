// SPDX-License-Identifier: Apache-2.0
// A quadrangle has the corners where the projection puts them, so a map may be turned against north, as the axes of a
// projection are. Elements of a GroundOverlay are in the order of KML's schema.
#include "coverage/kml.hpp"
#include <fmt/format.h>
#include <cmath>
#include "base/colours.hpp"
#include "base/xml_text.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

// Returns the names and colours of a layer's choices; colours of beams repeat, so only those of the first ones are
// named.
std::string legend_of(const Map& map, const LayerKind& layer) {
  const std::span<const Colour> colours = choice_colours(layer);
  std::vector<std::string> names;
  if (layer.value == &Cell::best_server)
    names = map.transmitters;
  else if (layer.value == &Cell::line_of_sight)
    names = {"other paths only", "line of sight"};
  else
    for (size_t k = 0; k < colours.size(); ++k) names.push_back(std::to_string(k));
  std::string out;
  for (size_t k = 0; k < names.size(); ++k)
    out += fmt::format("{}{} is {}", k == 0 ? "" : ", ", names[k], hex(colours[k % colours.size()]));
  return layer.of_pair() ? out + ", and so on: colours repeat" : out;
}

std::string description_of(const Map& map, const Overlay& overlay) {
  const std::string words =
      fmt::format("{}, frame {} at {} s", colour_words(map, *overlay.layer, overlay.range), map.frame, map.time_s);
  return overlay.layer->of_choices() ? words + ": " + legend_of(map, *overlay.layer) : words;
}

}  // namespace

const Georeference& georeference_for_kml(const std::optional<Georeference>& georeference,
                                         const std::string& scene_file) {
  if (georeference) return *georeference;
  throw InputError(
      fmt::format("--format kml: where on the earth the scene is, is not known: put a georeference.json {}, or choose "
                  "geotiff or png, which have the scene's own coordinates",
                  scene_file.empty() ? "beside a scene file, since a generated scene has no place"
                                     : fmt::format("beside {}", scene_file)));
}

std::array<glm::dvec2, 4> corners_of(const Map& map, const Georeference& georeference) {
  const Projection projection(georeference);
  const glm::dvec2 low = map.first_m - 0.5 * map.step_m, size = map.step_m * glm::dvec2(map.columns, map.rows);
  std::array<glm::dvec2, 4> out;
  for (size_t k = 0; k < out.size(); ++k) {
    const glm::dvec2 corner_m = low + size * glm::dvec2(k == 1 || k == 2 ? 1 : 0, k >= 2 ? 1 : 0);
    out[k] = projection.geographic(corner_m);
    if (!(std::abs(out[k].x) <= 180 && std::abs(out[k].y) <= 90))
      throw InputError(fmt::format(
          "--format kml: the corner x = {} m, y = {} m of the map is not on the earth in \"{}\": is that the "
          "projection of the scene's coordinates?",
          corner_m.x, corner_m.y, georeference.projection));
    out[k].x += 360 * std::round((out[0].x - out[k].x) / 360);
  }
  return out;
}

std::string kml(const Map& map, const Georeference& georeference, std::span<const Overlay> overlays) {
  std::string quad;
  for (const glm::dvec2& corner : corners_of(map, georeference))
    quad += fmt::format("{}{:.9f},{:.9f}", quad.empty() ? "" : " ", corner.x, corner.y);
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<kml xmlns=\"http://www.opengis.net/kml/2.2\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n"
      "<Document><name>{}</name><description>{}</description>\n",
      xml_text(map.grid), xml_text(georeference.attribution));
  for (const Overlay& overlay : overlays)
    out += fmt::format(
        "<GroundOverlay><name>{}</name><visibility>{:d}</visibility><description>{}</description>\n"
        "<Icon><href>{}</href></Icon><altitudeMode>clampToGround</altitudeMode>\n"
        "<gx:LatLonQuad><coordinates>{}</coordinates></gx:LatLonQuad></GroundOverlay>\n",
        xml_text(overlay.layer->name), &overlay == &overlays.front(), xml_text(description_of(map, overlay)),
        xml_text(overlay.picture), quad);
  return out + "</Document></kml>\n";
}

}  // namespace wavetracer::coverage
