// SPDX-License-Identifier: Apache-2.0
// Reads measured values of links from a CSV file whose header names its columns: a row for each link, or rows with the
// components of links.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>
#include "calibration/delay_profile.hpp"

namespace wavetracer::calibration {

// The meaning of the column with the level. A power or a gain differs from the computed gain by an offset at most.
enum class Level { path_gain_db, path_loss_db, power_dbm };

struct MeasuredPoint {
  uint64_t line = 0;                 // line in the file, counted from 1; of components that of the first
  std::string tx, rx, group;         // empty: not given
  std::array<double, 3> position{};  // x, y, z in m; with degrees latitude, longitude, m above the ground
  double level_db = 0;               // a gain: losses have changed their sign
  bool below = false;                // the gain is at most this: a gain was written as "<-110", or a loss as ">110"
  std::optional<double> delay_spread_ns = {}, azimuth_spread_deg = {};  // rms, more than 0
  std::optional<double> yaw_deg = {}, pitch_deg = {},
                        roll_deg = {};      // orientation of the antenna; not given: as configured
  std::vector<DelayPower> components = {};  // those of the point, if the file has their delays
};

struct MeasuredFile {
  std::string file;
  Level level = Level::path_gain_db;
  bool degrees = false;  // positions are geographic
  bool has_z = false;    // positions have a height
  std::vector<MeasuredPoint> points;
  uint64_t left_out = 0;            // rows without a level or a position, or components without a delay or an azimuth
  uint64_t components = 0;          // rows that are components of the points; 0: each row is a point
  std::vector<std::string> unused;  // columns that were not read
  std::vector<std::string> notes;   // sentences about how the file was read
};

struct MeasuredOptions {
  std::string level = {};  // name of the column with the level; empty: the only one of those that are known
  // The coordinate system of x and y, east and north: a code such as "EPSG:25832", or a PROJ string. Empty: file
  // coordinates of the scene.
  std::string crs = {};
};

// Reads the file. Columns are found by their names, without regard to case: x_m, y_m, z_m (or x, y, z), or latitude,
// longitude (or lat, lon) and height_m above the ground; path_gain_db, path_loss_db (or pathloss), power_dbm or
// power_db; and optionally tx, rx, group, yaw_deg, pitch_deg, roll_deg, delay_spread_ns and azimuth_spread_deg.
// A file with a column delay_ns, azimuth_deg or bearing_deg (clockwise from north) has components: rows of one place
// (and position, tx, rx) are one point, whose level is the sum of their powers and whose spreads are theirs.
// With a coordinate system x and y become degrees. Rows without a level or a position are counted and left out. Throws
// InputError that names file, line and column.
MeasuredFile read_measured(const std::filesystem::path& file, const MeasuredOptions& options);

}  // namespace wavetracer::calibration
