// SPDX-License-Identifier: Apache-2.0
// Files are written frame by frame into a folder that appears as a whole, so one that cannot be made leaves everything
// as it was.
#include "coverage/write_map.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include "base/csv.hpp"
#include "base/npy.hpp"
#include "base/pending_folder.hpp"
#include "coverage/geotiff.hpp"
#include "coverage/kml.hpp"
#include "coverage/png.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

namespace fs = std::filesystem;

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

std::string_view bytes_of(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), sizeof(double) * values.size()};
}

class MapWriter {
 public:
  MapWriter(const MapsToWrite& what, const fs::path& folder)
      : what_(what), first_(what.maps.front()), pending_(folder, PendingFolder::Earlier::kept) {
    if (wanted("csv") || wanted("npy")) degrees_ = degrees_of(first_, what.georeference);
    for (const LayerKind* layer : first_.layers) ranges_.push_back(range_of(*layer));
  }

  void write() {
    put("coverage.json", description());
    if (wanted("csv")) put_table();
    if (wanted("npy")) put_arrays();
    for (const Map& map : what_.maps) {
      put_pictures(map);
      if (wanted("kml")) put_overlays(map);
    }
  }
  std::vector<fs::path> finish() {
    const fs::path done = pending_.commit();
    std::vector<fs::path> out;
    for (const std::string& name : names_) out.push_back(done / name);
    return out;
  }

 private:
  const MapsToWrite& what_;
  const Map& first_;
  PendingFolder pending_;
  std::set<std::string> names_;
  std::vector<glm::dvec2> degrees_;
  std::vector<ColourRange> ranges_;  // values of the darkest and brightest colours, layer by layer

  bool wanted(const char* format) const { return std::ranges::find(what_.formats, format) != what_.formats.end(); }
  // Appends to the file of that name.
  void put(const std::string& name, std::string_view bytes) {
    names_.insert(name);
    pending_.append(name, bytes);
  }
  ColourRange range_of(const LayerKind& layer) const;
  std::string description() const;
  std::string ending(const Map& map) const;
  void put_table();
  void put_array(const std::string& name, const std::vector<double>& values, const std::vector<size_t>& shape);
  void put_arrays();
  void put_places(const std::vector<size_t>& shape);
  void put_pictures(const Map& map);
  void put_overlays(const Map& map);
};

ColourRange MapWriter::range_of(const LayerKind& layer) const {
  std::vector<double> all;
  if (layer.of_choices()) return {};
  for (const Map& map : what_.maps)
    for (const double value : map.values(layer)) all.push_back(value);
  return colour_range(layer, all);
}

std::string MapWriter::description() const {
  nlohmann::ordered_json json = {{"grid", first_.grid}};
  if (what_.of_frames)
    for (const Map& map : what_.maps) json["frames"].push_back({{"frame", map.frame}, {"time_s", map.time_s}});
  else
    json.update({{"frame", first_.frame}, {"time_s", first_.time_s}});
  json.update({{"tx", nullptr},
               {"transmitters", first_.transmitters},
               {"columns", first_.columns},
               {"rows", first_.rows},
               {"first_m", {first_.first_m.x, first_.first_m.y}},
               {"step_m", {first_.step_m.x, first_.step_m.y}},
               {"vertical", nullptr},
               {"projection", nullptr}});
  if (first_.only_streets) json["only_streets"] = true;
  if (const auto& plane = first_.plane)
    json["vertical"] = {{"from_m", {plane->from_m.x, plane->from_m.y}},
                        {"to_m", {plane->to_m.x, plane->to_m.y}},
                        {"first_along_m", plane->first_along_m},
                        {"first_z_m", plane->first_z_m}};
  if (first_.tx) json["tx"] = first_.transmitters[*first_.tx];
  if (what_.georeference) {
    json["projection"] = what_.georeference->projection;
    json["offset_m"] = {what_.georeference->offset_m.x, what_.georeference->offset_m.y};
    json["attribution"] = what_.georeference->attribution;
  }
  if (first_.samples > 0) json["samples"] = first_.samples;
  json["layers"] = nlohmann::ordered_json::object();
  for (size_t k = 0; k < first_.layers.size(); ++k) {
    const LayerKind& layer = *first_.layers[k];
    nlohmann::ordered_json& row = json["layers"][std::string(layer.name)];
    row = {{"unit", layer.unit}, {"about", layer.words}};
    for (const Threshold& threshold : first_.thresholds)
      if (threshold.layer == &layer) row["at_least"] = {{std::string(threshold.tested->name), threshold.least}};
    if (layer.of_choices()) {
      for (const Colour& c : choice_colours(layer)) row["colours"].push_back(hex(c));
    } else {
      row["dark_to_bright"] = {ranges_[k].low, ranges_[k].high};
    }
  }
  json["left_out"] = first_.left_out;
  json["notes"] = nlohmann::ordered_json::array();
  for (const Map& map : what_.maps)
    for (const std::string& note : map.notes)
      json["notes"].push_back(what_.of_frames ? fmt::format("frame {}: {}", map.frame, note) : note);
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

// Returns the end of the names of a frame's files: its number, with as many digits as the last one has.
std::string MapWriter::ending(const Map& map) const {
  if (!what_.of_frames) return "";
  return fmt::format("_{:0{}}", map.frame, std::to_string(what_.maps.back().frame).size());
}

void MapWriter::put_table() {
  for (const Map& map : what_.maps) {
    const std::string table = table_of(map, degrees_, what_.of_frames);
    const size_t begin = &map == &first_ ? 0 : table.find('\n') + 1;  // there is one row of names
    put("coverage.csv", std::string_view(table).substr(begin));
  }
}

void MapWriter::put_array(const std::string& name, const std::vector<double>& values,
                          const std::vector<size_t>& shape) {
  put(name + ".npy", npy_header("<f8", shape));
  put(name + ".npy", bytes_of(values));
}

void MapWriter::put_arrays() {
  const std::vector<size_t> shape = {first_.rows, first_.columns};
  std::vector<double> time_s;
  put_places(shape);
  for (const Map& map : what_.maps) time_s.push_back(map.time_s);
  if (what_.of_frames) put_array("time_s", time_s, {time_s.size()});
  for (const LayerKind* layer : first_.layers) {
    const std::string name = std::string(layer->name) + ".npy";
    put(name, npy_header("<f8", what_.of_frames ? std::vector{what_.maps.size(), shape[0], shape[1]} : shape));
    for (const Map& map : what_.maps) put(name, bytes_of(map.values(*layer)));
  }
}

// Writes the axes, and the places of cells. On a vertical plane those of a row hold for all rows.
void MapWriter::put_places(const std::vector<size_t>& shape) {
  std::vector<double> x_m, y_m, along_m, z_m, longitudes, latitudes;
  for (uint32_t column = 0; column < first_.columns; ++column) {
    x_m.push_back(first_.x_m(column));
    if (!first_.plane) continue;
    y_m.push_back(first_.y_m(column));
    along_m.push_back(first_.along_m(column));
  }
  for (uint32_t row = 0; row < first_.rows; ++row) {
    const size_t cell = size_t{row} * first_.columns;
    if (first_.plane)
      z_m.push_back(first_.z_m[cell]);
    else
      y_m.push_back(first_.y_m(cell));
  }
  put_array("x_m", x_m, {x_m.size()});
  put_array("y_m", y_m, {y_m.size()});
  if (first_.plane) {
    put_array("along_m", along_m, {along_m.size()});
    put_array("z_m", z_m, {z_m.size()});
  } else {
    put_array("z_m", first_.z_m, shape);
  }
  if (degrees_.empty()) return;
  const size_t places = first_.plane ? first_.columns : degrees_.size();
  for (size_t cell = 0; cell < places; ++cell) {
    longitudes.push_back(degrees_[cell].x);
    latitudes.push_back(degrees_[cell].y);
  }
  const std::vector<size_t> of_places = first_.plane ? std::vector<size_t>{first_.columns} : shape;
  put_array("lon_deg", longitudes, of_places);
  put_array("lat_deg", latitudes, of_places);
}

void MapWriter::put_pictures(const Map& map) {
  const MapPlace place = place_of(map, what_.georeference);
  for (size_t k = 0; k < map.layers.size(); ++k) {
    const LayerKind& layer = *map.layers[k];
    const std::string name = std::string(layer.name) + ending(map);
    const std::vector<double> values = map.values(layer);
    if (wanted("geotiff")) put(name + ".tif", geotiff(map, layer, values, place));
    if (wanted("png") || wanted("kml")) put(name + ".png", png(map, layer, values, ranges_[k]));
    if (wanted("png") && !map.plane) put(name + ".pgw", world_file(place));
  }
}

void MapWriter::put_overlays(const Map& map) {
  std::vector<Overlay> overlays;
  for (size_t k = 0; k < map.layers.size(); ++k)
    overlays.push_back({map.layers[k], ranges_[k], std::string(map.layers[k]->name) + ending(map) + ".png"});
  put("coverage" + ending(map) + ".kml", kml(map, georeference_for_kml(what_.georeference, ""), overlays));
}

}  // namespace

void check_formats_of(const std::string& grid, bool vertical, const std::vector<std::string>& formats) {
  const auto refuse = [&](const char* format, const char* reason) {
    if (vertical && std::ranges::find(formats, format) != formats.end())
      throw ConfigError(
          fmt::format("--format {}: the grid \"{}\" stands on a vertical plane, and {}: choose csv, npy or "
                      "png",
                      format, grid, reason));
  };
  refuse("geotiff", "a GeoTIFF has a place in x and y alone");
  refuse("kml", "KML lays pictures on the ground and cannot put one upright");
}

std::string table_of(const Map& map, std::span<const glm::dvec2> degrees, bool of_frames) {
  std::vector<std::string> names = {"ix", "iy", "x_m", "y_m", "z_m"};
  if (of_frames) names.insert(names.begin(), {"frame", "time_s"});
  if (map.plane) names.emplace_back("along_m");
  if (!degrees.empty()) names.insert(names.end(), {"lon_deg", "lat_deg"});
  for (const LayerKind* layer : map.layers) names.emplace_back(layer->name);
  names.emplace_back("tx");
  Csv table(names);
  const auto text = [](double value) { return fmt::format("{}", value); };
  for (size_t cell = 0; cell < map.cells.size(); ++cell) {
    std::vector<std::string> row;
    if (of_frames) row = {std::to_string(map.frame), text(map.time_s)};
    row.insert(row.end(), {std::to_string(cell % map.columns), std::to_string(cell / map.columns)});
    for (const double value : {map.x_m(cell), map.y_m(cell), map.z_m[cell]}) row.push_back(text(value));
    if (map.plane) row.push_back(text(map.along_m(cell)));
    if (!degrees.empty()) row.insert(row.end(), {text(degrees[cell].x), text(degrees[cell].y)});
    for (const LayerKind* layer : map.layers) row.push_back(text(map.value(*layer, cell)));
    row.push_back(server_name(map, cell));
    table.add_texts(row);
  }
  return table.text();
}

std::vector<fs::path> write_maps(const MapsToWrite& what, const fs::path& folder) {
  check_formats_of(what.maps.front().grid, what.maps.front().plane.has_value(), what.formats);
  MapWriter writer(what, folder);
  writer.write();
  return writer.finish();
}

}  // namespace wavetracer::coverage
