// SPDX-License-Identifier: Apache-2.0
// A PROJ string is read word by word; a word that is not known is refused, since it could change coordinates.
#include "coverage/map_place.hpp"
#include <fmt/format.h>
#include <charconv>
#include <map>
#include <sstream>
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

[[noreturn]] void refuse(const std::string& proj, const std::string& why) {
  throw InputError(fmt::format(
      "geotiff: the projection of the scene, \"{}\", cannot be written: {}; +proj=utm and +proj=tmerc on WGS84 can, and "
      "the formats csv and npy give every cell its longitude and latitude",
      proj, why));
}

std::map<std::string, std::string> words_of(const std::string& proj) {
  std::map<std::string, std::string> out;
  std::istringstream in(proj);
  for (std::string word; in >> word;) {
    const size_t equals = word.find('=');
    if (word.starts_with('+'))
      out[word.substr(1, equals - 1)] = equals == std::string::npos ? "" : word.substr(equals + 1);
    else
      refuse(proj, fmt::format("\"{}\" does not begin with +", word));
  }
  return out;
}

class Words {
 public:
  explicit Words(const std::string& proj) : proj_(proj), words_(words_of(proj)) {}

  // Returns the value and forgets the word; `otherwise` if it is not there.
  std::string take(const std::string& word, const std::string& otherwise = "") {
    const auto found = words_.find(word);
    if (found == words_.end()) return otherwise;
    const std::string value = found->second;
    words_.erase(found);
    return value;
  }
  double number(const std::string& word, double otherwise) {
    if (!has(word)) return otherwise;
    const std::string text = take(word);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) refuse(proj_, fmt::format("+{} is no number", word));
    return value;
  }
  bool has(const std::string& word) const { return words_.contains(word); }
  void end() const {
    if (!words_.empty()) refuse(proj_, fmt::format("+{} is not known", words_.begin()->first));
  }

 private:
  const std::string& proj_;
  std::map<std::string, std::string> words_;
};

// Takes the words that mean metres on WGS84. GRS80 has the same ellipsoid to .1 mm, and the scene's degrees are those
// of WGS84.
void take_earth(Words& words, const std::string& proj) {
  const std::string ellipsoid = words.take("ellps", "WGS84"), datum = words.take("datum", "WGS84"),
                    units = words.take("units", "m");
  if ((ellipsoid != "WGS84" && ellipsoid != "GRS80") || datum != "WGS84") refuse(proj, "it is not on WGS84");
  if (units != "m") refuse(proj, "its coordinates are not metres");
  words.take("no_defs");
  words.take("type");
}

}  // namespace

NamedProjection named_projection(const std::string& proj) {
  constexpr double zones = 60, north = 32600, south = 32700;
  Words words(proj);
  const std::string kind = words.take("proj");
  take_earth(words, proj);
  NamedProjection out;
  if (kind == "utm") {
    const double zone = words.number("zone", 0);
    if (!(zone >= 1 && zone <= zones)) refuse(proj, "it has no zone from 1 to 60");
    out.epsg = static_cast<uint32_t>((words.has("south") ? south : north) + zone);
    words.take("south");
  } else if (kind == "tmerc") {
    out.latitude_deg = words.number("lat_0", 0);
    out.longitude_deg = words.number("lon_0", 0);
    out.scale = words.number("k_0", words.number("k", 1));
    out.false_east_m = words.number("x_0", 0);
    out.false_north_m = words.number("y_0", 0);
  } else {
    refuse(proj, fmt::format("+proj={} is not known", kind));
  }
  words.end();
  return out;
}

MapPlace place_of(const Map& map, const std::optional<Georeference>& georeference) {
  const glm::dvec2 offset_m = georeference ? georeference->offset_m : glm::dvec2(0);
  return {map.first_m.x - 0.5 * map.step_m.x - offset_m.x, map.first_m.y + (map.rows - 0.5) * map.step_m.y - offset_m.y,
          map.step_m, georeference};
}

}  // namespace wavetracer::coverage
