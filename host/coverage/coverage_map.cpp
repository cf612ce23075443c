// SPDX-License-Identifier: Apache-2.0
// Links are walked twice: servers are found first, then the powers of all others are added, so that a weak sum keeps
// its digits beside a strong server. Receivers of a grid must be at their places: a grid does not move.
#include "coverage/coverage_map.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include "base/spelling.hpp"
#include "coverage/cell_area.hpp"
#include "radio/link_budget.hpp"
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

constexpr uint32_t no_cell = std::numeric_limits<uint32_t>::max();

double to_db(double power) { return 10 * std::log10(power); }
double to_power(double db) { return std::pow(10, db / 10); }

// The links of a cell that count.
struct Heard {
  const LinkRow *best = nullptr, *second = nullptr, *server = nullptr;
  double others = 0;  // sum of the path gains of all but the server, as powers

  void add(const LinkRow& link, std::optional<uint32_t> tx) {
    if (!best || link.path_gain_db > best->path_gain_db)
      second = std::exchange(best, &link);
    else if (!second || link.path_gain_db > second->path_gain_db)
      second = &link;
    if (!tx)
      server = best;
    else if (link.link.tx == *tx)
      server = &link;
  }
};

// Sets the place and the steps of a map by its first and last cell.
void set_shape(const glm::dvec3& first, const glm::dvec3& last, const ReceiverGridConfig& grid, Map& map) {
  glm::dvec2 way = glm::dvec2(last) - glm::dvec2(first);
  map.first_m = first;
  if (grid.vertical()) {
    VerticalPlane& plane = map.plane.emplace();
    plane.from_m = {grid.from_m->at(0), grid.from_m->at(1)};
    plane.to_m = {grid.to_m->at(0), grid.to_m->at(1)};
    plane.direction = plane_direction(grid);
    plane.first_along_m = plane.along_and_off_m(first.x, first.y).x;
    plane.first_z_m = first.z;
    way = {glm::length(way), last.z - first.z};
  }
  map.step_m = {map.columns > 1 ? way.x / (map.columns - 1) : grid.step_m,
                map.rows > 1 ? way.y / (map.rows - 1) : grid.step_m};
}

// Returns the cell of each receiver of the run, or no_cell, and sets the shape of the map.
std::vector<uint32_t> find_cells(const SavedRun& run, const SavedFrame& frame, const ReceiverGridConfig& grid,
                                 Map& map) {
  std::vector<uint32_t> cell_of(run.receivers().size(), no_cell);
  std::vector<std::pair<GridCell, uint32_t>> found;
  for (uint32_t rx = 0; rx < run.receivers().size(); ++rx)
    if (const auto place = grid_cell(grid.name, run.receivers()[rx].name)) found.emplace_back(*place, rx);
  for (const auto& [place, rx] : found) {
    map.columns = std::max(map.columns, place.ix + 1);
    map.rows = std::max(map.rows, place.iy + 1);
  }
  std::vector<uint32_t> receiver(found.size(), no_cell);
  bool whole = !found.empty() && uint64_t{map.columns} * map.rows == found.size();
  for (size_t k = 0; whole && k < found.size(); ++k) {
    const auto& [place, rx] = found[k];
    whole = place.ix < map.columns && place.iy < map.rows;  // the largest numbers have no number of columns
    if (!whole) break;
    uint32_t& here = receiver[size_t{place.iy} * map.columns + place.ix];
    whole = here == no_cell;
    here = rx;
  }
  if (!whole)
    throw InputError(
        fmt::format("{}: receivers of the grid \"{}\" are missing, or there twice", run.file().string(), grid.name));
  for (uint32_t k = 0; k < receiver.size(); ++k) {
    cell_of[receiver[k]] = k;
    map.z_m.push_back(frame.receiver_position_m[receiver[k]].z);
  }
  set_shape(frame.receiver_position_m[receiver.front()], frame.receiver_position_m[receiver.back()], grid, map);
  return cell_of;
}

Cell values_of(const Heard& heard, const RadioConfig& radio) {
  Cell cell;
  if (!heard.best) return cell;
  cell.best_server = heard.best->link.tx;
  if (heard.others > 0) cell.interference_dbm = link_budget(radio, to_db(heard.others)).received_dbm;
  if (!heard.server) return cell;
  const LinkRow& server = *heard.server;
  const LinkBudget budget = link_budget(radio, server.path_gain_db);
  cell.path_gain_db = server.path_gain_db;
  cell.narrowband_gain_db = server.narrowband_gain_db;
  cell.received_dbm = budget.received_dbm;
  cell.snr_db = budget.snr_db;
  const double disturbing_mw = to_power(noise_dbm(radio)) + (heard.others > 0 ? to_power(cell.interference_dbm) : 0);
  cell.sinr_db = budget.received_dbm - to_db(disturbing_mw);
  if (const LinkRow* const other = heard.server == heard.best ? heard.second : heard.best)
    cell.margin_db = server.path_gain_db - other->path_gain_db;
  cell.delay_spread_ns = server.rms_delay_spread_s * 1e9;
  cell.k_factor_db = to_db(server.k_factor);
  cell.line_of_sight = server.los ? 1 : 0;
  cell.paths = server.paths;
  cell.beam_gain_db = server.beam_gain_db;
  if (server.tx_beam) cell.tx_beam = *server.tx_beam;
  if (server.rx_beam) cell.rx_beam = *server.rx_beam;
  return cell;
}

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
  const std::vector<uint32_t> cell_of = find_cells(run, frame, grid, map);
  std::vector<Heard> heard(size_t{map.columns} * map.rows);
  const auto each = [&](const auto& visit) {
    for (const LinkRow& link : links)
      if (const uint32_t k = cell_of[link.link.rx]; k != no_cell && std::isfinite(link.path_gain_db))
        visit(heard[k], link);
  };
  each([&](Heard& cell, const LinkRow& link) { cell.add(link, choice.tx); });
  each([&](Heard& cell, const LinkRow& link) {
    if (!cell.server || link.link.tx != cell.server->link.tx) cell.others += to_power(link.path_gain_db);
  });
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
  for (const Cell& cell : cells) out.push_back(cell.*layer.value);
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
