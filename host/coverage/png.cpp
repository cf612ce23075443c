// SPDX-License-Identifier: Apache-2.0
// The form is that of PNG (ISO/IEC 15948): chunks with checksums, rows without a filter, compressed by zlib. Colour 0
// of the palette is the transparent one.
#include "coverage/png.hpp"
#include <fmt/format.h>
#include <zlib.h>
#include <algorithm>
#include <cmath>
#include <vector>
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

constexpr uint32_t colours = 256;

std::string big_endian(uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

void add_chunk(std::string& out, const std::string& name, const std::string& data) {
  const std::string body = name + data;
  out += big_endian(static_cast<uint32_t>(data.size())) + body;
  out += big_endian(
      static_cast<uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               bytes.size()) != Z_OK)
    throw RuntimeError("png: zlib cannot compress the picture");
  out.resize(size);
  return out;
}

// The colours of a layer, and the colour of a value, which is finite or infinite.
struct Palette {
  std::vector<Colour> table;  // colours 1, 2, ... of the picture
  bool counted = false;       // values are places in the table
  ColourRange range;

  uint8_t colour(double value) const {
    if (std::isnan(value)) return 0;
    if (counted) return static_cast<uint8_t>(1 + static_cast<size_t>(value) % table.size());
    const double place = std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
    return static_cast<uint8_t>(1 + std::lround(place * static_cast<double>(table.size() - 1)));
  }
};

Palette palette_of(const LayerKind& layer, const ColourRange& range) {
  const std::span<const Colour> choices = choice_colours(layer);
  if (layer.of_choices()) return {{choices.begin(), choices.end()}, true, {}};
  Palette out{{}, false, range};
  for (uint32_t k = 0; k + 1 < colours; ++k) out.table.push_back(colour_at(viridis, k / (colours - 2.0)));
  return out;
}

}  // namespace

std::span<const Colour> choice_colours(const LayerKind& layer) {
  if (layer.value == &Cell::best_server || layer.of_pair()) return server_colours;
  if (layer.value == &Cell::line_of_sight) return sight_colours;
  return {};
}

ColourRange colour_range(const LayerKind& layer, std::span<const double> values) {
  if (layer.tested) return {0, 1};
  constexpr double trimmed = 0.01, step = 5, widest = 100;
  std::vector<double> finite;
  std::ranges::copy_if(values, std::back_inserter(finite), [](double value) { return std::isfinite(value); });
  if (finite.empty()) return {};
  std::ranges::sort(finite);
  const auto cut = static_cast<size_t>(trimmed * static_cast<double>(finite.size()));
  const double low = finite[cut], high = finite[finite.size() - 1 - cut];
  if (!layer.unit.starts_with("dB")) return {0, high > 0 ? high : 1};
  const double top = step * std::ceil(high / step);
  return {std::min(std::max(step * std::floor(low / step), top - widest), top - step), top};
}

std::string colour_words(const Map& map, const LayerKind& layer, const ColourRange& range) {
  const std::string head = fmt::format("{} of {}", layer.words, map.grid);
  if (layer.of_choices()) return head;
  const std::string unit = layer.unit.empty() ? "" : fmt::format(" {}", layer.unit);
  return fmt::format("{}: {:g}{} is dark, {:g}{} is bright", head, range.low, unit, range.high, unit);
}

std::string png(const Map& map, const LayerKind& layer, std::span<const double> values, const ColourRange& range) {
  const Palette palette = palette_of(layer, range);
  std::string out("\x89PNG\r\n\x1a\n", 8), table(3, '\0'), rows;
  for (const Colour& colour : palette.table)
    for (const uint8_t part : colour) table += static_cast<char>(part);
  for (uint32_t row = map.rows; row-- > 0;) {
    rows += '\0';  // no filter
    for (uint32_t column = 0; column < map.columns; ++column)
      rows += static_cast<char>(palette.colour(values[size_t{row} * map.columns + column]));
  }
  const std::string eight_bits_palette("\x08\x03\x00\x00\x00", 5);
  add_chunk(out, "IHDR", big_endian(map.columns) + big_endian(map.rows) + eight_bits_palette);
  add_chunk(out, "PLTE", table);
  add_chunk(out, "tRNS", std::string(1, '\0'));
  add_chunk(out, "tEXt", "Description" + std::string(1, '\0') + colour_words(map, layer, range));
  add_chunk(out, "IDAT", compressed(rows));
  add_chunk(out, "IEND", "");
  return out;
}

std::string world_file(const MapPlace& place) {
  return fmt::format("{}\n0\n0\n{}\n{}\n{}\n", place.step_m.x, -place.step_m.y, place.west_m + 0.5 * place.step_m.x,
                     place.north_m - 0.5 * place.step_m.y);
}

}  // namespace wavetracer::coverage
