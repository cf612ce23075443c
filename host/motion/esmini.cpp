// SPDX-License-Identifier: Apache-2.0
// Columns are found by their names in the header; those of the log come in blocks, one for each vehicle that is
// present. Steps may vary, as those of a run without a fixed step do.
// Names of entities must be unique, as OpenSCENARIO demands.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "motion/input_text.hpp"
#include "motion/text_rows.hpp"
#include "motion/track_builder.hpp"
#include "motion/track_motion.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr const char* esmini_type = "passenger";  // neither file gives the types of its entities
constexpr double axle_m = 1.4;  // distance from the rear axle to the centre of the cars of esmini's catalogue

// Parses a cell as a finite number.
double cell_number(const CsvRows& rows, size_t column, std::string_view name) {
  const std::optional<double> value = finite_number(rows.cells()[column]);
  if (!value)
    rows.fail(fmt::format("column {} ({}): '{}' is not a finite number", column + 1, name, rows.cells()[column]));
  return *value;
}

// Removes number and unit: "#12 bb_x [m]" becomes "bb_x".
std::string_view quantity(std::string_view cell) {
  cell.remove_prefix(std::min(cell.find(' '), cell.size()));
  return trimmed(cell.substr(0, cell.find('[')));
}

class LogReader {
 public:
  LogReader(ByteStream& stream, const TrajectoryOptions& options) : rows_(stream), tracks_(stream.file(), options) {}

  Trajectories read() {
    do {
      if (!rows_.next())
        throw InputError(fmt::format("{}: the log of esmini has no line that begins with 'Index [-]'", rows_.file()));
    } while (!rows_.cells()[0].starts_with("Index"));
    read_header();
    while (rows_.next()) add_row();
    return tracks_.finish(ReferencePoint::centre);
  }

 private:
  enum Quantity : size_t { name, speed, box_x, box_y, box_z, length, width, height, x, y, z, yaw, pitch, quantities };
  static constexpr std::array<std::string_view, quantities> names = {"Entity_Name",
                                                                     "Current_Speed",
                                                                     "bb_x",
                                                                     "bb_y",
                                                                     "bb_z",
                                                                     "bb_length",
                                                                     "bb_width",
                                                                     "bb_height",
                                                                     "World_Position_X",
                                                                     "World_Position_Y",
                                                                     "World_Position_Z",
                                                                     "World_Heading_Angle",
                                                                     "World_Pitch_Angle"};
  static constexpr size_t first_block = 2;  // comes after index and time

  void read_header() {
    const std::vector<std::string>& cells = rows_.cells();
    size_t end = first_block;
    while (end < cells.size() && cells[end].starts_with("#1 ")) ++end;
    width_ = end - first_block;
    for (size_t i = 0; i < quantities; ++i) {
      for (size_t k = first_block; k < end; ++k) {
        const std::string_view found = quantity(cells[k]);
        // Until 2023 esmini misspelt it.
        if (found == names[i] || (i == name && found == "Entitity_Name")) place_[i] = k - first_block;
      }
      if (!place_[i]) rows_.fail(fmt::format("the header has no column '#1 {}'; is this a log of esmini?", names[i]));
    }
  }

  // Entities may be added and deleted, so blocks have no fixed places; each block names its entity.
  void add_row() {
    if (rows_.cells().size() < first_block)
      rows_.fail(fmt::format("the row has {} cells, and so no time", rows_.cells().size()));
    const double time_s = cell_number(rows_, 1, "TimeStamp");
    tracks_.add_frame(time_s);
    for (size_t first = first_block; first + width_ <= rows_.cells().size(); first += width_) {
      const std::string& id = rows_.cells()[first + *place_[name]];
      if (id.empty()) break;
      const auto number = [&](Quantity which) { return cell_number(rows_, first + *place_[which], names[which]); };
      const glm::dvec3 size_m(number(length), number(width), number(height));
      Sample sample;
      sample.time_s = time_s;
      sample.yaw_rad = number(yaw);
      sample.pitch_rad = -number(pitch);
      sample.speed_m_s = number(speed);
      const glm::dvec3 arm_m(number(box_x), number(box_y), number(box_z) - size_m.z / 2);
      sample.position_m =
          glm::dvec3(number(x), number(y), number(z)) + turned_arm(arm_m, sample.yaw_rad, sample.pitch_rad);
      tracks_.add(id, esmini_type, sample, rows_.number(), fmt::format("entity '{}'", id),
                  is_size(size_m) ? std::optional(size_m) : std::nullopt);
    }
  }

  CsvRows rows_;
  TrackBuilder tracks_;
  size_t width_ = 0;                                     // number of columns of an entity
  std::array<std::optional<size_t>, quantities> place_;  // index in its block
};

class RecordingReader {
 public:
  RecordingReader(ByteStream& stream, const TrajectoryOptions& options)
      : rows_(stream), tracks_(stream.file(), options) {}

  Trajectories read() {
    do {
      if (!rows_.next())
        throw InputError(
            fmt::format("{}: the recording of esmini has no line that begins with 'time, id, name'", rows_.file()));
    } while (rows_.cells()[0] != "time");
    read_header();
    while (rows_.next()) add_row();
    if (repeated_ > 0)
      tracks_.warn(
          fmt::format("{}: {} rows have the time of an earlier one of their entity, since the text has few digits: the "
                      "first of each counts; give dat2csv a --precision of 6, or esmini a --fixed_timestep",
                      rows_.file(), repeated_));
    tracks_.warn(
        fmt::format("{}: a recording of esmini tells no sizes and types: entities are cars of SUMO's size, "
                    "whose centre is {} m ahead of the rear axle; its log (--csv_logger) or an OSI trace (--osi_file) "
                    "tells them",
                    rows_.file(), axle_m));
    return tracks_.finish(ReferencePoint::centre);
  }

 private:
  enum Column : size_t { time, number_of, name, x, y, z, yaw, pitch, speed, columns };
  static constexpr std::array<std::string_view, columns> names = {"time", "id", "name", "x",    "y",
                                                                  "z",    "h",  "p",    "speed"};

  void read_header() {
    const std::vector<std::string>& cells = rows_.cells();
    for (size_t i = 0; i < columns; ++i) {
      const auto found = std::ranges::find(cells, names[i]);
      if (found == cells.end()) rows_.fail(fmt::format("the header has no column '{}'", names[i]));
      place_[i] = static_cast<size_t>(found - cells.begin());
    }
    width_ = cells.size();
  }

  void add_row() {
    if (rows_.cells().size() < width_)
      rows_.fail(fmt::format("the row has {} cells, the header {}", rows_.cells().size(), width_));
    const auto number = [&](Column which) { return cell_number(rows_, place_[which], names[which]); };
    const std::string& id = rows_.cells()[place_[name]];
    if (id.empty()) rows_.fail("the name of the entity is empty");
    if (!begin_row(number(time), id, number(number_of))) return;
    Sample sample;
    sample.time_s = *time_s_;
    sample.yaw_rad = number(yaw);
    sample.pitch_rad = -number(pitch);
    sample.speed_m_s = number(speed);
    sample.position_m =
        glm::dvec3(number(x), number(y), number(z)) + turned_arm({axle_m, 0, 0}, sample.yaw_rad, sample.pitch_rad);
    tracks_.add(id, esmini_type, sample, rows_.number(), fmt::format("entity '{}'", id));
  }

  // Returns false if the entity has a row at this time already. Another entity of that name is an error of its sample.
  bool begin_row(double time_s, const std::string& id, double entity) {
    if (time_s_ != time_s) {
      tracks_.add_frame(time_s);
      present_.clear();
    }
    time_s_ = time_s;
    const auto [found, first] = present_.emplace(id, entity);
    const bool repeated = !first && found->second == entity;
    repeated_ += repeated;
    return !repeated;
  }

  CsvRows rows_;
  TrackBuilder tracks_;
  std::array<size_t, columns> place_{};
  size_t width_ = 0;
  std::optional<double> time_s_;           // the time of the row before
  std::map<std::string, double> present_;  // names and numbers of the entities that have a row at this time
  uint64_t repeated_ = 0;
};

}  // namespace

bool is_esmini_log(std::string_view start) {
  return start.starts_with("esmini GIT ") || start.starts_with("Index [-]");
}

bool is_esmini_recording(std::string_view start) {
  const std::string_view line = start.substr(0, start.find('\n'));
  return (line.starts_with("Version: ") && line.find(", OpenDRIVE:") != line.npos) ||
         line.starts_with("time, id, name, x, y, z, h, p, r");
}

Trajectories read_esmini_log(ByteStream& stream, const TrajectoryOptions& options) {
  return LogReader(stream, options).read();
}

Trajectories read_esmini_recording(ByteStream& stream, const TrajectoryOptions& options) {
  return RecordingReader(stream, options).read();
}

}  // namespace wavetracer
