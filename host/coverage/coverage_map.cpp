// SPDX-License-Identifier: Apache-2.0
// A layer that a run cannot tell is left out, or refused if somebody has named it.
#include "coverage/coverage_map.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <utility>
#include "base/spelling.hpp"
#include "coverage/cell_area.hpp"
#include "coverage/grid_cells.hpp"
#include "coverage/served_cells.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

// Returns what the run lacks for a layer; empty if it can tell it.
std::string lack_of(const LayerKind& layer, const RadioConfig& radio, const Map& map) {
  if (layer.of_beams && !map.beams)
    return "the links.csv of a run where a transmitter or the grid has an [[array]] with a codebook";
  std::string keys;
  if (layer.of_powers && !radio.transmit_power_dbm) keys = "radio.transmit_power_dbm";
  if (layer.of_noise && !radio.bandwidth_hz) keys += (keys.empty() ? "" : " and ") + std::string("radio.bandwidth_hz");
  return keys.empty() ? "" : keys + ", which the run's configuration does not set";
}

void choose_layers(const std::vector<std::string>& wanted, const RadioConfig& radio, Map& map) {
  for (const std::string& name : wanted) {
    const LayerKind& layer = layer_kind(name);
    check_layer(layer, radio, map, "--layers");
    if (std::ranges::find(map.layers, &layer) == map.layers.end()) map.layers.push_back(&layer);
  }
  if (!wanted.empty()) return;
  std::vector<std::pair<std::string, std::vector<std::string_view>>> lacking;  // the lack, and the layers that have it
  for (const LayerKind& layer : layer_kinds) {
    if (layer.of_areas && !map.areas) continue;
    const std::string lack = lack_of(layer, radio, map);
    if (lack.empty()) {
      map.layers.push_back(&layer);
      continue;
    }
    const auto same = std::ranges::find(lacking, lack, [](const auto& each) { return each.first; });
    if (same == lacking.end())
      lacking.push_back({lack, {layer.name}});
    else
      same->second.push_back(layer.name);
  }
  for (const auto& [lack, names] : lacking)
    map.left_out.push_back(fmt::format("{} {} {}", fmt::join(names, ", "), names.size() == 1 ? "needs" : "need", lack));
}

// Computes the layers of areas if they are wanted, and notes what limits of output have taken from them.
void choose_areas(const SavedFrame& frame, double frequency_hz, const std::vector<uint32_t>& cell_of,
                  const std::vector<Heard>& heard, const MapChoice& choice, Map& map) {
  map.areas = choice.layers.empty() ? choice.areas : std::ranges::any_of(choice.layers, [](const std::string& name) {
    return layer_kind(name).of_areas;
  });
  if (!map.areas) return;
  constexpr double least = 1e-9;  // smaller shares are rounding errors of links.csv
  std::vector<uint32_t> servers;
  double left_out = 0;
  for (const Heard& cell : heard) {
    servers.push_back(cell.server ? cell.server->link.tx : no_cell);
    if (cell.server) left_out = std::max(left_out, cell.server->left_out_power_share);
  }
  add_areas(frame.paths, frequency_hz, cell_of, servers, map);
  if (left_out > least)
    map.notes.push_back(fmt::format(
        "cell_mean_db and fading_db are those of the paths in paths.h5, where limits of output ([output] paths, min_gain_db, "
        "dynamic_range_db, max_paths_per_link) have left out up to {:.3g}% of the power of a cell",
        100 * left_out));
}

Map map_without_layers(const SavedRun& run, const RadioConfig& radio, const SavedFrame& frame,
                       const std::vector<LinkRow>& links, const ReceiverGridConfig& grid, const MapChoice& choice) {
  Map map{.grid = grid.name, .tx = choice.tx, .frame = frame.number, .time_s = frame.time_s};
  for (const RadioEnd& end : run.transmitters()) map.transmitters.push_back(end.name);
  const std::vector<uint32_t> cell_of =
      place_cells({run.receivers(), frame.receiver_position_m, run.file().string()}, grid, map);
  const std::vector<Heard> heard = heard_links(links, cell_of, size_t{map.columns} * map.rows, choice.tx);
  map.cells.reserve(heard.size());
  for (const Heard& cell : heard) map.cells.push_back(values_of(cell, radio));
  choose_areas(frame, run.frequency_hz(), cell_of, heard, choice, map);
  for (const LinkRow& link : links) map.beams |= cell_of[link.link.rx] != no_cell && !std::isnan(link.beam_gain_db);
  return map;
}

}  // namespace

std::vector<std::string> layer_names() {
  std::vector<std::string> out;
  for (const LayerKind& layer : layer_kinds) out.emplace_back(layer.name);
  return out;
}

const LayerKind& layer_kind(const std::string& name) {
  for (const LayerKind& layer : layer_kinds)
    if (layer.name == name) return layer;
  const std::vector<std::string> known = layer_names();
  throw ConfigError(fmt::format("\"{}\" is no layer of a map, there are {}{}", name, fmt::join(known, ", "),
                                spelling_hint(name, known)));
}

void check_layer(const LayerKind& layer, const RadioConfig& radio, const Map& map, const std::string& option) {
  if (const std::string lack = lack_of(layer, radio, map); !lack.empty())
    throw ConfigError(fmt::format("{} {} needs {}", option, layer.name, lack));
}

size_t Map::reached_cells() const {
  size_t count = 0;
  for (size_t cell = 0; cell < cells.size(); ++cell) count += reached(cell) ? 1 : 0;
  return count;
}

std::vector<double> Map::values(const LayerKind& layer) const {
  std::vector<double> out;
  out.reserve(cells.size());
  for (size_t cell = 0; cell < cells.size(); ++cell) out.push_back(value(layer, cell));
  return out;
}

Map coverage_map(const SavedRun& run, const RadioConfig& radio, const SavedFrame& frame,
                 const std::vector<LinkRow>& links, const ReceiverGridConfig& grid, const MapChoice& choice) {
  Map map = map_without_layers(run, radio, frame, links, grid, choice);
  choose_layers(choice.layers, radio, map);
  return map;
}

std::vector<Map> coverage_maps(const SavedRun& run, const RadioConfig& radio, size_t first_row, size_t last_row,
                               const LinkTable& table, const ReceiverGridConfig& grid, const MapChoice& choice) {
  for (const std::string& name : choice.layers) layer_kind(name);  // before frames are read
  std::vector<Map> maps;
  bool beams = false;
  for (size_t row = first_row; row <= last_row; ++row) {
    const SavedFrame frame = run.frame(row);
    const std::vector<LinkRow> links = link_rows(frame, table, run.first_link(row), run.frequency_hz());
    maps.push_back(map_without_layers(run, radio, frame, links, grid, choice));
    beams |= maps.back().beams;
  }
  for (Map& map : maps) {
    map.beams = beams;
    choose_layers(choice.layers, radio, map);
  }
  return maps;
}

}  // namespace wavetracer::coverage
