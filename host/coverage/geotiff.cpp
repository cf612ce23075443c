// SPDX-License-Identifier: Apache-2.0
// The file is the header, the values, the numbers that do not fit into a tag, and the tags. Tags and keys are sorted.
// GDAL_METADATA and GDAL_NODATA are tags of GDAL (https://gdal.org/drivers/raster/gtiff.html).
#include "coverage/geotiff.hpp"
#include <fmt/format.h>
#include <bit>
#include <cstring>
#include <vector>
#include "base/xml_text.hpp"

namespace wavetracer::coverage {
namespace {

static_assert(std::endian::native == std::endian::little);

enum TagType : uint16_t { ascii = 2, word = 3, long_word = 4, real = 12 };

class Tiff {
 public:
  void append(const void* bytes, size_t size) { file_.append(static_cast<const char*>(bytes), size); }
  uint32_t end() const { return static_cast<uint32_t>(file_.size()); }

  // Values of more than four bytes go to the file, where they begin at an even place.
  template <class T>
  void tag(uint16_t number, TagType type, const std::vector<T>& values) {
    const size_t bytes = values.size() * sizeof(T);
    uint32_t field = 0;
    if (bytes > sizeof field) {
      if (file_.size() % 2 != 0) file_ += '\0';
      field = end();
      append(values.data(), bytes);
    } else {
      std::memcpy(&field, values.data(), bytes);
    }
    const auto count = static_cast<uint32_t>(values.size());
    put(tags_, number);
    put(tags_, static_cast<uint16_t>(type));
    put(tags_, count);
    put(tags_, field);
    ++count_;
  }
  void tag(uint16_t number, const std::string& text) {
    std::vector<char> bytes(text.begin(), text.end());
    bytes.push_back('\0');
    tag(number, ascii, bytes);
  }
  // Returns the whole file, with the place of the tags in its header.
  std::string finish() {
    if (file_.size() % 2 != 0) file_ += '\0';
    const uint32_t place = end();
    std::memcpy(file_.data() + sizeof place, &place, sizeof place);
    put(file_, count_);
    file_ += tags_;
    put(file_, uint32_t{0});  // there is no other picture
    return std::move(file_);
  }

 private:
  std::string file_ = std::string("II*\0\0\0\0\0", 8), tags_;
  uint16_t count_ = 0;

  template <class T>
  static void put(std::string& out, T value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
};

// The tags of keys: a table of words, and the numbers that it points to.
struct GeoKeys {
  static constexpr uint16_t numbers_tag = 34736, user_defined = 32767;
  std::vector<uint16_t> table = {1, 1, 1, 0};  // version 1.1.1, and the number of keys
  std::vector<double> numbers;

  void add(uint16_t key, uint32_t value) {
    table.insert(table.end(), {key, 0, 1, static_cast<uint16_t>(value)});
    ++table[3];
  }
  void add_number(uint16_t key, double value) {
    table.insert(table.end(), {key, numbers_tag, 1, static_cast<uint16_t>(numbers.size())});
    numbers.push_back(value);
    ++table[3];
  }
};

// The names of these keys are those of GeoTIFF's specification.
GeoKeys keys_of(const MapPlace& place) {
  constexpr uint16_t model_type = 1024, raster_type = 1025, geodetic_system = 2048, projected_system = 3072,
                     projection = 3074, method = 3075, linear_units = 3076, origin_longitude = 3080,
                     origin_latitude = 3081, false_easting = 3082, false_northing = 3083, origin_scale = 3092;
  constexpr uint16_t projected = 1, pixel_is_area = 1, wgs84 = 4326, transverse_mercator = 1, metre = 9001;
  GeoKeys keys;
  if (!place.georeference) {
    keys.add(model_type, GeoKeys::user_defined);
    keys.add(raster_type, pixel_is_area);
    keys.add(linear_units, metre);
    return keys;
  }
  const NamedProjection p = named_projection(place.georeference->projection);
  keys.add(model_type, projected);
  keys.add(raster_type, pixel_is_area);
  if (p.epsg != 0) {
    keys.add(projected_system, p.epsg);
    keys.add(linear_units, metre);
    return keys;
  }
  keys.add(geodetic_system, wgs84);
  keys.add(projected_system, GeoKeys::user_defined);
  keys.add(projection, GeoKeys::user_defined);
  keys.add(method, transverse_mercator);
  keys.add(linear_units, metre);
  keys.add_number(origin_longitude, p.longitude_deg);
  keys.add_number(origin_latitude, p.latitude_deg);
  keys.add_number(false_easting, p.false_east_m);
  keys.add_number(false_northing, p.false_north_m);
  keys.add_number(origin_scale, p.scale);
  return keys;
}

std::string metadata(const LayerKind& layer) {
  return fmt::format(
      "<GDALMetadata><Item name=\"DESCRIPTION\" sample=\"0\" role=\"description\">{}</Item>"
      "<Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">{}</Item></GDALMetadata>",
      xml_text(layer.name), xml_text(layer.unit));
}

}  // namespace

std::string geotiff(const Map& map, const LayerKind& layer, std::span<const double> values, const MapPlace& place) {
  const GeoKeys keys = keys_of(place);
  Tiff out;
  const uint32_t begin = out.end();
  for (uint32_t row = map.rows; row-- > 0;)
    for (uint32_t column = 0; column < map.columns; ++column) {
      const auto value = static_cast<float>(values[size_t{row} * map.columns + column]);
      out.append(&value, sizeof value);
    }
  const uint32_t bytes = out.end() - begin;
  using Words = std::vector<uint16_t>;
  using Longs = std::vector<uint32_t>;
  out.tag(256, long_word, Longs{map.columns});                                         // width
  out.tag(257, long_word, Longs{map.rows});                                            // height
  out.tag(258, word, Words{32});                                                       // bits of a sample
  out.tag(259, word, Words{1});                                                        // not compressed
  out.tag(262, word, Words{1});                                                        // large values are bright
  out.tag(270, fmt::format("{} of {} by wavetracer", layer.words, map.grid));          // description
  out.tag(273, long_word, Longs{begin});                                               // place of the values
  out.tag(277, word, Words{1});                                                        // samples of a pixel
  out.tag(278, long_word, Longs{map.rows});                                            // rows of a strip
  out.tag(279, long_word, Longs{bytes});                                               // bytes of the strip
  out.tag(339, word, Words{3});                                                        // floating point
  out.tag(33550, real, std::vector{place.step_m.x, place.step_m.y, 0.0});              // size of a pixel
  out.tag(33922, real, std::vector{0.0, 0.0, 0.0, place.west_m, place.north_m, 0.0});  // place of the corner
  out.tag(34735, word, keys.table);
  if (!keys.numbers.empty()) out.tag(GeoKeys::numbers_tag, real, keys.numbers);
  out.tag(42112, metadata(layer));
  out.tag(42113, std::string("nan"));  // the value of empty cells
  return out.finish();
}

}  // namespace wavetracer::coverage
