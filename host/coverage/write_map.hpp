// SPDX-License-Identifier: Apache-2.0
// Writes a map as files that other programs read (docs/formats.md): all layers in one table, or one file a layer.
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

inline constexpr std::array<std::string_view, 4> format_names = {"csv", "npy", "geotiff", "png"};

// Returns the table of all cells, row by row from the south: ix, iy, x_m, y_m, z_m, lon_deg and lat_deg if they are
// given, then a column for each layer, and `tx`, the name of the server. degrees: longitude and latitude of each cell,
// or nothing.
std::string table_of(const Map& map, std::span<const glm::dvec2> degrees);

// Writes the files into the folder, where they replace those of the same names, and coverage.json, which says what they
// have. formats: of format_names. Throws InputError if the georeference cannot be used, RuntimeError if a file cannot
// be written. Returns the files.
std::vector<std::filesystem::path> write_map(const Map& map, const std::filesystem::path& folder,
                                             const std::vector<std::string>& formats,
                                             const std::optional<Georeference>& georeference);

}  // namespace wavetracer::coverage
