// SPDX-License-Identifier: Apache-2.0
// All files are made in memory first, so that one that cannot be made leaves the folder as it was.
#include "coverage/write_map.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include "base/csv.hpp"
#include "base/npy.hpp"
#include "base/pending_folder.hpp"
#include "coverage/geotiff.hpp"
#include "coverage/png.hpp"

namespace wavetracer::coverage {
namespace {

namespace fs = std::filesystem;

// Names and contents of files, in the order of their names.
using Files = std::map<std::string, std::string>;

std::string server_name(const Map& map, size_t cell) {
  if (!map.reached(cell)) return "";
  return map.transmitters[map.tx ? *map.tx : static_cast<size_t>(map.cells[cell].best_server)];
}

// Longitudes and latitudes of all cells in degrees; none without a georeference.
std::vector<glm::dvec2> degrees_of(const Map& map, const std::optional<Georeference>& georeference) {
  std::vector<glm::dvec2> out;
  if (!georeference) return out;
  const Projection projection(*georeference);
  for (size_t cell = 0; cell < map.cells.size(); ++cell)
    out.push_back(projection.geographic({map.x_m(cell), map.y_m(cell)}));
  return out;
}

std::string npy(const std::vector<double>& values, const std::vector<size_t>& shape) {
  return npy_header("<f8", shape) + std::string(reinterpret_cast<const char*>(values.data()), 8 * values.size());
}

void add_arrays(const Map& map, std::span<const glm::dvec2> degrees, Files& files) {
  const std::vector<size_t> shape = {map.rows, map.columns};
  std::vector<double> x_m, y_m, longitudes, latitudes;
  for (uint32_t column = 0; column < map.columns; ++column) x_m.push_back(map.x_m(column));
  for (uint32_t row = 0; row < map.rows; ++row) y_m.push_back(map.y_m(size_t{row} * map.columns));
  files["x_m.npy"] = npy(x_m, {x_m.size()});
  files["y_m.npy"] = npy(y_m, {y_m.size()});
  files["z_m.npy"] = npy(map.z_m, shape);
  for (const LayerKind* layer : map.layers) files[std::string(layer->name) + ".npy"] = npy(map.values(*layer), shape);
  if (degrees.empty()) return;
  for (const glm::dvec2& place : degrees) {
    longitudes.push_back(place.x);
    latitudes.push_back(place.y);
  }
  files["lon_deg.npy"] = npy(longitudes, shape);
  files["lat_deg.npy"] = npy(latitudes, shape);
}

std::string description(const Map& map, const std::optional<Georeference>& georeference) {
  nlohmann::ordered_json json = {{"grid", map.grid},
                                 {"frame", map.frame},
                                 {"time_s", map.time_s},
                                 {"tx", nullptr},
                                 {"transmitters", map.transmitters},
                                 {"columns", map.columns},
                                 {"rows", map.rows},
                                 {"first_m", {map.first_m.x, map.first_m.y}},
                                 {"step_m", {map.step_m.x, map.step_m.y}},
                                 {"projection", nullptr}};
  if (map.tx) json["tx"] = map.transmitters[*map.tx];
  if (georeference) {
    json["projection"] = georeference->projection;
    json["offset_m"] = {georeference->offset_m.x, georeference->offset_m.y};
    json["attribution"] = georeference->attribution;
  }
  json["layers"] = nlohmann::ordered_json::object();
  for (const LayerKind* layer : map.layers) {
    nlohmann::ordered_json& row = json["layers"][std::string(layer->name)];
    row = {{"unit", layer->unit}, {"about", layer->words}};
    if (layer->of_choices()) {
      for (const Colour& c : choice_colours(*layer)) row["colours"].push_back(hex(c));
    } else {
      const ColourRange range = colour_range(*layer, map.values(*layer));
      row["dark_to_bright"] = {range.low, range.high};
    }
  }
  json["left_out"] = map.left_out;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string table_of(const Map& map, std::span<const glm::dvec2> degrees) {
  std::vector<std::string> names = {"ix", "iy", "x_m", "y_m", "z_m"};
  if (!degrees.empty()) names.insert(names.end(), {"lon_deg", "lat_deg"});
  for (const LayerKind* layer : map.layers) names.emplace_back(layer->name);
  names.emplace_back("tx");
  Csv table(names);
  const auto text = [](double value) { return fmt::format("{}", value); };
  for (size_t cell = 0; cell < map.cells.size(); ++cell) {
    std::vector<std::string> row = {std::to_string(cell % map.columns), std::to_string(cell / map.columns)};
    for (const double value : {map.x_m(cell), map.y_m(cell), map.z_m[cell]}) row.push_back(text(value));
    if (!degrees.empty()) row.insert(row.end(), {text(degrees[cell].x), text(degrees[cell].y)});
    for (const LayerKind* layer : map.layers) row.push_back(text(map.cells[cell].*layer->value));
    row.push_back(server_name(map, cell));
    table.add_texts(row);
  }
  return table.text();
}

std::vector<fs::path> write_map(const Map& map, const fs::path& folder, const std::vector<std::string>& formats,
                                const std::optional<Georeference>& georeference) {
  const auto wanted = [&](const char* format) { return std::ranges::find(formats, format) != formats.end(); };
  const MapPlace place = place_of(map, georeference);
  Files files = {{"coverage.json", description(map, georeference)}};
  std::vector<glm::dvec2> degrees;
  if (wanted("csv") || wanted("npy")) degrees = degrees_of(map, georeference);
  if (wanted("csv")) files["coverage.csv"] = table_of(map, degrees);
  if (wanted("npy")) add_arrays(map, degrees, files);
  for (const LayerKind* layer : map.layers) {
    const std::string name(layer->name);
    const std::vector<double> values = map.values(*layer);
    if (wanted("geotiff")) files[name + ".tif"] = geotiff(map, *layer, values, place);
    if (!wanted("png")) continue;
    files[name + ".png"] = png(map, *layer, values);
    files[name + ".pgw"] = world_file(place);
  }
  PendingFolder pending(folder, PendingFolder::Earlier::kept);
  for (const auto& [name, content] : files) pending.append(name, content);
  const fs::path done = pending.commit();
  std::vector<fs::path> out;
  for (const auto& [name, content] : files) out.push_back(done / name);
  return out;
}

}  // namespace wavetracer::coverage
