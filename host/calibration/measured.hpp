// SPDX-License-Identifier: Apache-2.0
// Reads measured values of links from a CSV file whose header names its columns.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace wavetracer::calibration {

// The meaning of the column with the level. A power or a gain differs from the computed gain by an offset at most.
enum class Level { path_gain_db, path_loss_db, power_dbm };

struct MeasuredPoint {
  uint64_t line = 0;                 // line in the file, counted from 1
  std::string tx, group;             // empty: not given
  std::array<double, 3> position{};  // x, y, z in m; with degrees latitude, longitude, m above the ground
  double level_db = 0;               // a gain: losses have changed their sign
  bool below = false;                // the gain is at most this: a gain was written as "<-110", or a loss as ">110"
  std::optional<double> delay_spread_ns = {};  // rms delay spread, more than 0
};

struct MeasuredFile {
  std::string file;
  Level level = Level::path_gain_db;
  bool degrees = false;  // positions are geographic
  bool has_z = false;    // positions have a height
  std::vector<MeasuredPoint> points;
  uint64_t left_out = 0;            // rows without a level or a position
  std::vector<std::string> unused;  // columns that were not read
};

// Reads the file. Columns are found by their names, without regard to case: x_m, y_m, z_m (or x, y, z), or latitude,
// longitude (or lat, lon) and height_m above the ground; path_gain_db, path_loss_db (or pathloss) or power_dbm; and
// optionally tx, group and delay_spread_ns. level: the name of the column with the level; empty: the only one of these.
// Rows without a level or a position are counted and left out. Throws InputError that names file, line and column.
MeasuredFile read_measured(const std::filesystem::path& file, const std::string& level);

}  // namespace wavetracer::calibration
