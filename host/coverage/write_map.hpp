// SPDX-License-Identifier: Apache-2.0
// Writes maps as files that other programs read (docs/formats.md): all layers in one table, or one file a layer.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include "coverage/coverage_map.hpp"
#include "scene/georeference.hpp"

namespace wavetracer::coverage {

inline constexpr std::array<std::string_view, 5> format_names = {"csv", "npy", "geotiff", "png", "kml"};

// The maps to write: that of one frame, or those of several frames in their order, which have the same layers.
struct MapsToWrite {
  std::span<const Map> maps;
  bool of_frames = false;  // tables and arrays have the frames too, and pictures the number of the frame in their name
  std::vector<std::string> formats = {};          // words of format_names
  std::optional<Georeference> georeference = {};  // without it kml is refused
};

// Throws ConfigError for a format that cannot show a map on a vertical plane; `vertical`: whether the map is one. grid:
// its name.
void check_formats_of(const std::string& grid, bool vertical, const std::vector<std::string>& formats);

// Returns the table of all cells, row by row from the south or from below: ix, iy, x_m, y_m, z_m, along_m if the map
// stands on a vertical plane, lon_deg and lat_deg if they are given, then a column for each layer, and `tx`, the name
// of the server. degrees: longitude and latitude of each cell, or nothing. of_frames: each row begins with the frame
// and time_s.
std::string table_of(const Map& map, std::span<const glm::dvec2> degrees, bool of_frames = false);

// Writes the files into the folder, where they replace those of the same names, and coverage.json, which says what they
// have. Colours mean the same in all frames. Throws as check_formats_of does, InputError if the georeference cannot be
// used, RuntimeError if a file cannot be written; then the folder is as it was. Returns the files.
std::vector<std::filesystem::path> write_maps(const MapsToWrite& what, const std::filesystem::path& folder);

}  // namespace wavetracer::coverage
