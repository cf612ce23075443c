// SPDX-License-Identifier: Apache-2.0
// Until the map is finished, shares are counts, and the deviation is the sum of squared distances from the mean (B. P.
// Welford, Technometrics 4(3), 1962), which keeps its digits where values hardly differ.
#include "coverage/chance_map.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include "base/spelling.hpp"
#include "coverage/grid_cells.hpp"
#include "coverage/served_cells.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

const LayerKind& tested_by(const LayerKind& chance) {
  return *std::ranges::find(layer_kinds, chance.tested, [](const LayerKind& kind) { return kind.value; });
}

// Returns a finite number, or nothing if the text is none.
std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Threshold read_threshold(const std::string& text, const std::string& option) {
  const std::vector<std::string> known = tested_names();
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto layer = std::ranges::find_if(
      chance_kinds, [&](const LayerKind& kind) { return kind.tested && tested_by(kind).name == name; });
  if (layer == chance_kinds.end())
    throw ConfigError(fmt::format("{} {}: \"{}\" has no threshold, it can be that of {}{}", option, text, name,
                                  fmt::join(known, ", "), spelling_hint(name, known)));
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  const std::optional<double> least = number_in(value);
  if (!least)
    throw ConfigError(
        fmt::format("{} {}: \"{}\" is no number: give one in {}", option, text, value, tested_by(*layer).unit));
  return {&*layer, &tested_by(*layer), *least};
}

}  // namespace

std::vector<std::string> tested_names() {
  std::vector<std::string> out;
  for (const LayerKind& kind : chance_kinds)
    if (kind.tested) out.emplace_back(tested_by(kind).name);
  return out;
}

std::vector<Threshold> read_thresholds(const std::vector<std::string>& texts, const std::string& option) {
  std::vector<Threshold> out;
  for (const std::string& text : texts) {
    const Threshold next = read_threshold(text, option);
    if (std::ranges::find(out, next.layer, &Threshold::layer) != out.end())
      throw ConfigError(
          fmt::format("{} {}: {} has a threshold already: give each name once", option, text, next.tested->name));
    out.push_back(next);
  }
  return out;
}

ChanceMap::ChanceMap(Map map, std::vector<uint32_t> cell_of, const RadioConfig& radio)
    : map_(std::move(map)), cell_of_(std::move(cell_of)), radio_(radio) {
  Chances none;
  none.path_gain_mean_db = none.path_gain_deviation_db = 0;
  for (const Threshold& threshold : map_.thresholds) none.*threshold.layer->chance = 0;
  map_.chances.assign(size_t{map_.columns} * map_.rows, none);
}

std::vector<Cell> ChanceMap::cells(std::span<const LinkFigures> links) const {
  std::vector<LinkRow> rows;
  for (const LinkFigures& link : links)
    if (cell_of_[link.rx] != no_cell)
      rows.push_back({.link = {link.tx, link.rx},
                      .paths = link.paths,
                      .los = link.los,
                      .path_gain_db = link.path_gain_db,
                      .narrowband_gain_db = link.narrowband_gain_db,
                      .rms_delay_spread_s = link.rms_delay_spread_s,
                      .k_factor = link.k_factor});
  std::vector<Cell> out;
  for (const Heard& cell : heard_links(rows, cell_of_, map_.chances.size(), map_.tx))
    out.push_back(values_of(cell, radio_));
  return out;
}

void ChanceMap::set_nominal(std::span<const LinkFigures> links) { map_.cells = cells(links); }

void ChanceMap::add_sample(std::span<const LinkFigures> links) {
  const std::vector<Cell> found = cells(links);
  ++map_.samples;
  for (size_t k = 0; k < found.size(); ++k) {
    Chances& sums = map_.chances[k];
    const double gain_db = found[k].path_gain_db;
    if (std::isnan(gain_db)) continue;
    const double before = gain_db - sums.path_gain_mean_db;
    sums.path_gain_mean_db += before / ++sums.samples;
    sums.path_gain_deviation_db += before * (gain_db - sums.path_gain_mean_db);
    for (const Threshold& threshold : map_.thresholds)
      sums.*threshold.layer->chance += found[k].*threshold.tested->value >= threshold.least ? 1 : 0;
  }
}

Map ChanceMap::finish() {
  for (Chances& cell : map_.chances) {
    if (cell.samples < 1) cell.path_gain_mean_db = Cell::none;
    cell.path_gain_deviation_db =
        cell.samples < 2 ? Cell::none : std::sqrt(cell.path_gain_deviation_db / (cell.samples - 1));
    for (const Threshold& threshold : map_.thresholds) cell.*threshold.layer->chance /= map_.samples;
  }
  map_.layers = {&layer_kind("path_gain_db")};
  for (const LayerKind& kind : chance_kinds)
    if (!kind.tested || std::ranges::find(map_.thresholds, &kind, &Threshold::layer) != map_.thresholds.end())
      map_.layers.push_back(&kind);
  return std::move(map_);
}

}  // namespace wavetracer::coverage
