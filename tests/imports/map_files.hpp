// SPDX-License-Identifier: Apache-2.0
// Vector maps written for the tests of GDAL, in degrees about a middle, and their import.
// Without the module or the programs of GDAL (Debian: gdal-bin) has_gdal() says so.
#pragma once
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "check_contains.hpp"
#include "imported.hpp"
#include "scene/georeference.hpp"
#include "scene/load.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::test {

namespace fs = std::filesystem;

inline const Georeference middle{"+proj=tmerc +lat_0=48.137 +lon_0=11.575 +ellps=WGS84 +units=m", {0, 0}, {}, {}};

inline bool run(const std::string& command) { return std::system((command + " > /dev/null 2>&1").c_str()) == 0; }

inline bool has_gdal() {
  const bool there = *WAVETRACER_OGR2OGR && *WAVETRACER_GDAL_TRANSLATE && fs::exists(WAVETRACER_MAPS_FILE);
  if (!there) MESSAGE("skipped: no GDAL (Debian: libgdal-dev, gdal-bin)");
  setenv("WAVETRACER_MAPS_MODULE", WAVETRACER_MAPS_FILE, 1);
  return there;
}

// A ring in degrees of points in metres about the middle.
inline std::string ring(const Points& points) {
  static const Projection projection(middle);
  std::string out = "[";
  for (size_t i = 0; i <= points.size(); ++i) {
    const auto& [x, y] = points[i % points.size()];
    const glm::dvec2 p = projection.geographic({x, y});
    out += fmt::format("{}[{:.12f}, {:.12f}]", i > 0 ? ", " : "", p.x, p.y);
  }
  return out + "]";
}

inline std::string feature(const std::string& type, const std::string& coordinates, const std::string& properties) {
  return fmt::format(R"({{"type": "Feature", "properties": {{{}}}, "geometry": {{"type": "{}", "coordinates": {}}}}})",
                     properties, type, coordinates);
}

inline Imported import_file(const fs::path& file, ImportOptions options) {
  options.output = file.string() + " scene";
  const ImportSummary summary = import_city(file, options);
  return {summary, load_scene_file(summary.scene, SceneConfig{})};
}

inline ImportOptions fields(const char* height = "h_m", const char* levels = "floors") {
  ImportOptions options;
  options.height_field = height;
  options.levels_field = levels;
  return options;
}

inline std::string refusal(const fs::path& file, const ImportOptions& options) {
  try {
    import_file(file, options);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace wavetracer::test
