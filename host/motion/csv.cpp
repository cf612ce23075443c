// SPDX-License-Identifier: Apache-2.0
// Reads CSV row by row; a header names the columns, which may be in any order.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motion/input_text.hpp"
#include "motion/text_rows.hpp"
#include "motion/track_builder.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

enum Column : size_t { time_column, id_column, x_column, y_column, z_column, yaw_column, speed_column, type_column };
constexpr std::array<std::string_view, 8> column_names = {"time", "id", "x", "y", "z", "yaw", "speed", "type"};
constexpr size_t needed = 4;  // number of names that are needed
constexpr size_t absent = ~size_t{0};
constexpr std::string_view columns_advice =
    "the first line must be a header with the columns time,id,x,y and optionally z,yaw,speed,type; lat,lon (degrees) "
    "may stand in the place of x,y";

// A column name that replaces x or y if the file is in degrees.
struct DegreeName {
  std::string_view name;
  Column column;
};
constexpr auto degree_names =
    std::to_array<DegreeName>({{"lon", x_column}, {"longitude", x_column}, {"lat", y_column}, {"latitude", y_column}});

class CsvReader {
 public:
  CsvReader(ByteStream& stream, const TrajectoryOptions& options) : rows_(stream), tracks_(stream.file(), options) {
    column_.fill(absent);
  }

  Trajectories read() {
    if (!rows_.next()) throw InputError(fmt::format("{}: the file is empty; {}", tracks_.file(), columns_advice));
    read_header();
    while (rows_.next()) add_row();
    return tracks_.finish(ReferencePoint::centre);
  }

 private:
  [[noreturn]] void fail(std::string_view what) const { rows_.fail(what); }
  const std::vector<std::string>& cells() const { return rows_.cells(); }

  void read_header() {
    std::string unused;
    size_t in_degrees = 0;
    for (size_t i = 0; i < cells().size(); ++i) {
      const std::string name = lower_case(cells()[i]);
      const auto known = std::find(column_names.begin(), column_names.end(), name);
      const auto degree = std::ranges::find(degree_names, name, &DegreeName::name);
      if (known == column_names.end() && degree == degree_names.end()) {
        unused += fmt::format("{}'{}'", unused.empty() ? "" : ", ", cells()[i]);
        continue;
      }
      in_degrees += degree != degree_names.end();
      size_t& column = column_[known != column_names.end() ? static_cast<size_t>(known - column_names.begin())
                                                           : static_cast<size_t>(degree->column)];
      if (column != absent)
        fail(fmt::format("the header has the column '{}' twice{}", name,
                         in_degrees > 0 ? ", in metres or degrees" : ""));
      column = i;
    }
    if (in_degrees == 1) fail("the header must have both lat and lon, which then stand in the place of x and y");
    if (in_degrees > 0) tracks_.in_degrees();
    in_degrees_ = in_degrees > 0;
    for (size_t i = 0; i < needed; ++i) {
      if (column_[i] != absent) continue;
      const bool semicolons = rows_.text().find(';') != std::string_view::npos;
      fail(fmt::format("the header has no column '{}'; {}{}", column_names[i], columns_advice,
                       semicolons ? "; they are separated by commas, not by semicolons" : ""));
    }
    if (!unused.empty()) {
      tracks_.warn(fmt::format("{}:{}: the columns {} are not used", tracks_.file(), rows_.number(), unused));
    }
    width_ = cells().size();
  }

  bool has(Column column) const { return column_[column] != absent && !cells()[column_[column]].empty(); }
  const std::string& cell(Column column) const { return cells()[column_[column]]; }

  double number(Column column) const {
    const std::optional<double> value = finite_number(cell(column));
    if (!value) {
      fail(fmt::format("column {} ({}): '{}' is not a finite number", column_[column] + 1, column_names[column],
                       cell(column)));
    }
    return *value;
  }
  double optional_number(Column column) const { return has(column) ? number(column) : not_given; }

  void add_row() {
    if (cells().size() != width_) {
      fail(fmt::format("the row has {} cells, the header {}; a decimal point is '.', and ids with commas need quotes",
                       cells().size(), width_));
    }
    if (!has(id_column)) fail(fmt::format("column {} (id) is empty", column_[id_column] + 1));
    const double x = number(x_column), y = number(y_column);
    if (tracks_.off_network(x, y)) return;
    if (in_degrees_ && (std::abs(x) > 180 || std::abs(y) > 90))
      fail(fmt::format("latitude {} and longitude {} are no place on the earth", y, x));
    Sample sample;
    sample.time_s = number(time_column);
    sample.position_m = {x, y, column_[z_column] == absent ? 0 : number(z_column)};
    sample.yaw_rad = std::remainder(optional_number(yaw_column), 360.0) * (std::numbers::pi / 180);
    sample.speed_m_s = optional_number(speed_column);
    const std::string_view type = has(type_column) ? std::string_view(cell(type_column)) : "passenger";
    const std::string& id = cell(id_column);
    tracks_.add(id, type, sample, rows_.number(), fmt::format("vehicle '{}'", id));
  }

  CsvRows rows_;
  TrackBuilder tracks_;
  std::array<size_t, column_names.size()> column_;  // index of each name's column in a row
  size_t width_ = 0;                                // cells of a row
  bool in_degrees_ = false;
};

}  // namespace

Trajectories read_csv(ByteStream& stream, const TrajectoryOptions& options) {
  return CsvReader(stream, options).read();
}

}  // namespace wavetracer
