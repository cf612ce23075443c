// SPDX-License-Identifier: Apache-2.0
// The header names the columns; each row is a measured link. Columns of other names are listed and not read.
#include "calibration/measured.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <string_view>
#include "motion/input_text.hpp"
#include "motion/text_rows.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

enum Quantity : size_t { x, y, z, latitude, longitude, height, tx, group, delay_spread, level, quantity_count };

struct Name {
  std::string_view name;
  Quantity quantity;
};
constexpr std::array column_names{Name{"x_m", x},
                                  Name{"x", x},
                                  Name{"y_m", y},
                                  Name{"y", y},
                                  Name{"z_m", z},
                                  Name{"z", z},
                                  Name{"latitude", latitude},
                                  Name{"lat", latitude},
                                  Name{"longitude", longitude},
                                  Name{"lon", longitude},
                                  Name{"height_m", height},
                                  Name{"tx", tx},
                                  Name{"group", group},
                                  Name{"delay_spread_ns", delay_spread}};

struct LevelName {
  std::string_view name;
  Level level;
};
constexpr std::array level_names{LevelName{"path_gain_db", Level::path_gain_db},
                                 LevelName{"path_loss_db", Level::path_loss_db},
                                 LevelName{"pathloss", Level::path_loss_db}, LevelName{"power_dbm", Level::power_dbm}};

constexpr const char* advice =
    "the header must name the columns x_m and y_m, or latitude and longitude, and one of path_gain_db, path_loss_db and "
    "power_dbm";

class MeasuredReader {
 public:
  MeasuredReader(ByteStream& stream, std::string asked) : rows_(stream), asked_(lower_case(asked)) {}

  MeasuredFile read() {
    out_.file = rows_.file();
    if (!rows_.next()) throw InputError(fmt::format("{}: the file is empty; {}", rows_.file(), advice));
    read_header();
    while (rows_.next()) add_row();
    if (out_.points.empty())
      throw InputError(fmt::format("{}: no row below the header has a position and a level", rows_.file()));
    return std::move(out_);
  }

 private:
  void take(Quantity quantity, size_t column) {
    if (column_[quantity])
      rows_.fail(fmt::format("the columns '{}' and '{}' mean the same; remove one of them", header_[*column_[quantity]],
                             header_[column]));
    column_[quantity] = column;
  }

  // Takes the column as that of the level, if it is one that was asked for.
  bool take_level(const std::string& name, size_t column) {
    const auto known = std::ranges::find(level_names, name, &LevelName::name);
    if (asked_.empty() ? known == level_names.end() : name != asked_) return false;
    take(level, column);
    out_.level = known == level_names.end() ? Level::power_dbm : known->level;
    return true;
  }

  void read_header() {
    header_ = rows_.cells();
    for (size_t i = 0; i < header_.size(); ++i) {
      const std::string name = lower_case(header_[i]);
      if (take_level(name, i)) continue;
      const auto known = std::ranges::find(column_names, name, &Name::name);
      if (known == column_names.end())
        out_.unused.push_back(header_[i]);
      else
        take(known->quantity, i);
    }
    if (!column_[level])
      rows_.fail(asked_.empty() ? fmt::format("no column has a level; {}, or say which it is by --level", advice)
                                : fmt::format("there is no column '{}', which --level asks for", asked_));
    const bool metres = column_[x] && column_[y];
    out_.degrees = !metres && column_[latitude] && column_[longitude];
    if (!metres && !out_.degrees) rows_.fail(fmt::format("no columns have positions; {}", advice));
    out_.has_z = column_[out_.degrees ? height : z].has_value();
    for (const Quantity other : {latitude, longitude, height})
      if (metres && column_[other]) out_.unused.push_back(header_[*column_[other]]);
  }

  std::string_view cell(Quantity quantity) const {
    const std::optional<size_t> at = column_[quantity];
    return at && *at < rows_.cells().size() ? std::string_view(rows_.cells()[*at]) : std::string_view();
  }
  // Returns the number in the cell; nothing if it is empty or NaN.
  std::optional<double> number(Quantity quantity, std::string_view text) const {
    if (text.empty() || lower_case(std::string(text)) == "nan") return {};
    const std::optional<double> value = finite_number(text);
    if (!value) rows_.fail(fmt::format("{} = '{}' is not a finite number", header_[*column_[quantity]], text));
    return value;
  }
  std::optional<double> number(Quantity quantity) const { return number(quantity, cell(quantity)); }

  void read_level(std::string_view text, MeasuredPoint& point, bool& known) {
    const bool loss = out_.level == Level::path_loss_db;
    if (text.starts_with('<') || text.starts_with('>')) {
      if (text.starts_with('<') == loss)
        rows_.fail(fmt::format("'{}': a level below the noise is written as {}", text, loss ? "'>110'" : "'<-110'"));
      point.below = true;
      text.remove_prefix(1);
      text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    }
    const std::optional<double> value = number(level, text);
    known = value.has_value();
    point.level_db = loss ? -value.value_or(0) : value.value_or(0);
  }

  void add_row() {
    if (rows_.cells().size() > header_.size())
      rows_.fail(
          fmt::format("the row has {} cells, but the header names {} columns", rows_.cells().size(), header_.size()));
    MeasuredPoint point{.line = rows_.number(), .tx = std::string(cell(tx)), .group = std::string(cell(group))};
    const std::array<Quantity, 3> place = out_.degrees ? std::array{latitude, longitude, height} : std::array{x, y, z};
    bool known = true;
    read_level(cell(level), point, known);
    for (size_t axis = 0; axis < 3; ++axis) {
      const std::optional<double> value = number(place[axis]);
      known = known && (value || (axis == 2 && !out_.has_z));
      point.position[axis] = value.value_or(0);
    }
    if (out_.degrees && known && (std::abs(point.position[0]) > 90 || std::abs(point.position[1]) > 360))
      rows_.fail(
          fmt::format("latitude {:g}, longitude {:g} is no place on the earth", point.position[0], point.position[1]));
    point.delay_spread_ns = number(delay_spread);
    if (point.delay_spread_ns && *point.delay_spread_ns < 0)
      rows_.fail(fmt::format("delay_spread_ns = {:g} is less than 0", *point.delay_spread_ns));
    if (point.delay_spread_ns == 0) point.delay_spread_ns.reset();  // it has no logarithm
    if (known)
      out_.points.push_back(std::move(point));
    else
      ++out_.left_out;
  }

  CsvRows rows_;
  const std::string asked_;  // name of the column with the level; empty: any that is known
  std::vector<std::string> header_;
  std::array<std::optional<size_t>, quantity_count> column_;
  MeasuredFile out_;
};

}  // namespace

MeasuredFile read_measured(const std::filesystem::path& file, const std::string& level) {
  ByteStream stream(file, "file of measured values");
  return MeasuredReader(stream, level).read();
}

}  // namespace wavetracer::calibration
