// SPDX-License-Identifier: Apache-2.0
// The header names the columns; each row is a measured link, or a component of one. Columns of other names are listed
// and not read.
#include "calibration/measured.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <string_view>
#include "calibration/components.hpp"
#include "calibration/projected.hpp"
#include "motion/input_text.hpp"
#include "motion/text_rows.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

enum Quantity : size_t {
  x,
  y,
  z,
  latitude,
  longitude,
  height,
  tx,
  rx,
  group,
  yaw,
  pitch,
  roll,
  delay_spread,
  azimuth_spread,
  delay,
  azimuth,
  bearing,
  position,
  level,
  quantity_count
};

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
                                  Name{"rx", rx},
                                  Name{"group", group},
                                  Name{"yaw_deg", yaw},
                                  Name{"pitch_deg", pitch},
                                  Name{"roll_deg", roll},
                                  Name{"delay_spread_ns", delay_spread},
                                  Name{"azimuth_spread_deg", azimuth_spread},
                                  Name{"delay_ns", delay},
                                  Name{"azimuth_deg", azimuth},
                                  Name{"bearing_deg", bearing},
                                  Name{"position", position}};

struct LevelName {
  std::string_view name;
  Level level;
};
constexpr std::array level_names{LevelName{"path_gain_db", Level::path_gain_db},
                                 LevelName{"path_loss_db", Level::path_loss_db},
                                 LevelName{"pathloss", Level::path_loss_db}, LevelName{"power_dbm", Level::power_dbm},
                                 LevelName{"power_db", Level::power_dbm}};

constexpr const char* advice =
    "the header must name the columns x_m and y_m, or latitude and longitude, and one of path_gain_db, path_loss_db, "
    "power_dbm and power_db";
constexpr double most_component_db = 1000;  // beyond this, a power cannot be added to others

class MeasuredReader {
 public:
  MeasuredReader(ByteStream& stream, const MeasuredOptions& options)
      : rows_(stream), asked_(lower_case(options.level)), crs_(options.crs) {}

  MeasuredFile read() {
    out_.file = rows_.file();
    if (!rows_.next()) throw InputError(fmt::format("{}: the file is empty; {}", rows_.file(), advice));
    read_header();
    while (rows_.next()) add_row();
    if (components_) out_.points = components_->points(column_[delay].has_value(), has_azimuth());
    if (out_.points.empty())
      throw InputError(fmt::format("{}: no row below the header has a position and a level{}", rows_.file(),
                                   components_ ? ", and a delay and an azimuth where there are columns of them" : ""));
    if (!crs_.empty()) places_to_degrees(out_, crs_);
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

  bool has_azimuth() const { return column_[azimuth] || column_[bearing]; }

  void name_columns() {
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
  }

  void read_header() {
    name_columns();
    if (!column_[level])
      rows_.fail(asked_.empty() ? fmt::format("no column has a level; {}, or say which it is by --level", advice)
                                : fmt::format("there is no column '{}', which --level asks for", asked_));
    const bool metres = column_[x] && column_[y];
    if (!crs_.empty() && !metres)
      rows_.fail("--crs says in which coordinate system x and y are, but the header names no columns x and y");
    out_.degrees = !metres && column_[latitude] && column_[longitude];
    if (!metres && !out_.degrees) rows_.fail(fmt::format("no columns have positions; {}", advice));
    height_ = out_.degrees || !crs_.empty() ? height : z;  // that of z is one of the scene
    out_.has_z = column_[height_].has_value();
    for (const Quantity other : {latitude, longitude, height, z})
      if (metres && other != height_ && column_[other]) out_.unused.push_back(header_[*column_[other]]);
    read_header_of_components();
  }

  void read_header_of_components() {
    if (column_[azimuth] && column_[bearing])
      rows_.fail("azimuth_deg and bearing_deg both say where a component comes from; remove one of them");
    if (!column_[delay] && !has_azimuth()) {
      if (column_[position]) out_.unused.push_back(header_[*column_[position]]);
      return;
    }
    for (const Quantity spread : {delay_spread, azimuth_spread})
      if (column_[spread])
        rows_.fail(
            fmt::format("the rows are components, since there is a column {}, and their spreads are computed; "
                        "remove the column {}",
                        header_[*column_[column_[delay]     ? delay
                                         : column_[azimuth] ? azimuth
                                                            : bearing]],
                        header_[*column_[spread]]));
    components_.emplace();
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

  // Returns the spread; nothing if it is not given, or 0, which has no logarithm.
  std::optional<double> read_spread(Quantity quantity) const {
    const std::optional<double> value = number(quantity);
    if (value && *value < 0) rows_.fail(fmt::format("{} = {:g} is less than 0", header_[*column_[quantity]], *value));
    return value == 0 ? std::nullopt : value;
  }

  // Sets the position, and tells whether the row has one.
  bool read_position(MeasuredPoint& point) const {
    bool known = true;
    const std::array<Quantity, 3> place =
        out_.degrees ? std::array{latitude, longitude, height} : std::array{x, y, height_};
    for (size_t axis = 0; axis < 3; ++axis) {
      const std::optional<double> value = number(place[axis]);
      known = known && (value || (axis == 2 && !out_.has_z));
      point.position[axis] = value.value_or(0);
    }
    if (out_.degrees && known && (std::abs(point.position[0]) > 90 || std::abs(point.position[1]) > 360))
      rows_.fail(
          fmt::format("latitude {:g}, longitude {:g} is no place on the earth", point.position[0], point.position[1]));
    return known;
  }

  void add_row() {
    if (rows_.cells().size() > header_.size())
      rows_.fail(
          fmt::format("the row has {} cells, but the header names {} columns", rows_.cells().size(), header_.size()));
    MeasuredPoint point{.line = rows_.number(),
                        .tx = std::string(cell(tx)),
                        .rx = std::string(cell(rx)),
                        .group = std::string(cell(group))};
    bool known = true;
    read_level(cell(level), point, known);
    known = read_position(point) && known;
    point.yaw_deg = number(yaw);
    point.pitch_deg = number(pitch);
    point.roll_deg = number(roll);
    if (components_) return add_component(point, known);
    point.delay_spread_ns = read_spread(delay_spread);
    point.azimuth_spread_deg = read_spread(azimuth_spread);
    if (known)
      out_.points.push_back(std::move(point));
    else
      ++out_.left_out;
  }

  void add_component(const MeasuredPoint& point, bool known) {
    if (point.below) rows_.fail("a component needs a power of its own; leave out those that are below the noise");
    if (std::abs(point.level_db) > most_component_db)
      rows_.fail(fmt::format("{} = {} is no power of a component", header_[*column_[level]], cell(level)));
    const std::optional<double> of_delay = number(delay), of_azimuth = number(column_[bearing] ? bearing : azimuth);
    known = known && (of_delay || !column_[delay]) && (of_azimuth || !has_azimuth());
    if (!known) return void(++out_.left_out);
    const double angle_deg = of_azimuth.value_or(0);
    const Component component{of_delay.value_or(0), column_[bearing] ? 90 - angle_deg : angle_deg};
    if (const MeasuredPoint* other = components_->add(point, std::string(cell(position)), component))
      rows_.fail(fmt::format("the place or the group differs from that of line {}, but position = '{}' is the same",
                             other->line, cell(position)));
    ++out_.components;
  }

  CsvRows rows_;
  const std::string asked_;  // name of the column with the level; empty: any that is known
  const std::string crs_;
  Quantity height_ = z;
  std::optional<Components> components_;  // if rows are components
  std::vector<std::string> header_;
  std::array<std::optional<size_t>, quantity_count> column_;
  MeasuredFile out_;
};

}  // namespace

MeasuredFile read_measured(const std::filesystem::path& file, const MeasuredOptions& options) {
  ByteStream stream(file, "file of measured values");
  return MeasuredReader(stream, options).read();
}

}  // namespace wavetracer::calibration
