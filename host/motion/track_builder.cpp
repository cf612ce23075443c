// SPDX-License-Identifier: Apache-2.0
// Collects samples into tracks, and puts tracks into their final order.
// Samples with the same id belong to one vehicle.
#include "motion/track_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motion/input_text.hpp"
#include "motion/track_motion.hpp"
#include "motion/vehicle_types.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/names.hpp"

namespace wavetracer {
namespace {

// These are the limits of the configuration's keys (config/field_table.hpp).
constexpr double farthest_m = 1e9, fastest_m_s = 1e8, most_time_s = 1e12;

// Returns the first of the names, for messages.
std::string listed(const std::vector<std::string>& names) {
  constexpr size_t shown = 5;
  std::string out;
  for (size_t i = 0; i < std::min(names.size(), shown); ++i) out += fmt::format("{}'{}'", i > 0 ? ", " : "", names[i]);
  return names.size() > shown ? fmt::format("{} and {} more", out, names.size() - shown) : out;
}

}  // namespace

TrackBuilder::TrackBuilder(std::string file, const TrajectoryOptions& options)
    : file_(std::move(file)), options_(options) {
  if (!(options.scale > 0) || !std::isfinite(options.scale)) {
    throw ConfigError(fmt::format("the scale of trajectories is {}; it must be positive", options.scale));
  }
  for (const VehicleType& type : options.types) check_type(type);
  if (options.default_type) check_type(*options.default_type);
}

// Files contain numbers such as 1e308 that stand for a missing value.
void TrackBuilder::check_sizes(const Sample& sample, uint64_t line, std::string_view what) const {
  const auto check = [&](double value, double most, const char* name, const char* unit) {
    if (std::abs(value) > most)  // the comparison is false for missing values
      fail_at(file_, line, fmt::format("{}: its {} is {:g} {}, and {:g} is the most", what, name, value, unit, most));
  };
  check(sample.time_s, most_time_s, "time", "s");
  for (int axis = 0; axis < 3; ++axis) check(sample.position_m[axis] * options_.scale, farthest_m, "position", "m");
  check(sample.speed_m_s, fastest_m_s, "speed", "m/s");
}

void TrackBuilder::add(std::string_view id, std::string_view type, const Sample& sample, uint64_t line,
                       std::string_view what, const std::optional<glm::dvec3>& size_m) {
  check_sizes(sample, line, what);
  const auto found = track_of_.find(id);
  if (found == track_of_.end()) {
    if (has_control_character(id) || has_control_character(type))
      fail_at(file_, line,
              fmt::format("{}: its id or type contains a control character, such as a line break, which tables "
                          "and plots cannot show: remove it",
                          what));
    track_of_.emplace(id, static_cast<uint32_t>(out_.tracks.size()));
    out_.tracks.push_back({std::string(id), type_index(type, line, size_m), {sample}, {}});
    last_line_.push_back(line);
    return;
  }
  Track& track = out_.tracks[found->second];
  uint64_t& last_line = last_line_[found->second];
  const double last_s = track.samples.back().time_s;
  if (sample.time_s == last_s) {
    fail_at(file_, line,
            fmt::format("{} has a second sample at {} s, the first one is in line {}; ids must be unique", what, last_s,
                        last_line));
  }
  if (sample.time_s < last_s) {
    fail_at(file_, line,
            fmt::format("{}: time goes backwards, from {} s in line {} to {} s; sort by time", what, last_s, last_line,
                        sample.time_s));
  }
  if (out_.types[track.type].name != type) ++changed_types_;
  track.samples.push_back(sample);
  last_line = line;
}

uint32_t TrackBuilder::type_index(std::string_view name, uint64_t line, const std::optional<glm::dvec3>& size_m) {
  // Vehicles of one type may differ in size.
  const std::string key =
      size_m ? fmt::format("{}\n{} {} {}", name, size_m->x, size_m->y, size_m->z) : std::string(name);
  const auto known = type_of_.find(key);
  if (known != type_of_.end()) return known->second;
  // SUMO names the type of a vehicle that was changed at run time TYPE@VEHICLE.
  const std::string_view base = name.substr(0, name.find('@'));
  const auto given = std::find_if(options_.types.begin(), options_.types.end(),
                                  [&](const VehicleType& t) { return t.name == name || t.name == base; });
  std::optional<VehicleType> type = given != options_.types.end() ? *given : sumo_type(base);
  if (type && given == options_.types.end() && size_m) *type = {type->name, size_m->x, size_m->y, size_m->z};
  // The file has the size of a vehicle whose type is nobody's, as a run with types of its own writes it.
  if (!type && !options_.default_type && size_m) type = {std::string(name), size_m->x, size_m->y, size_m->z};
  if (!type) {
    if (!options_.default_type) {
      fail_at(file_, line,
              fmt::format("the vehicle type '{}' is unknown: add a [[vehicle_type]] with its length_m, width_m "
                          "and height_m, or give trajectories.default_type",
                          name));
    }
    type = options_.default_type;
    unknown_types_.emplace_back(name);
  }
  type->name = name;
  const uint32_t index = static_cast<uint32_t>(out_.types.size());
  out_.types.push_back(*type);
  type_of_.emplace(key, index);
  return index;
}

void TrackBuilder::in_degrees(bool above_ground) {
  degrees_ = true;
  above_ground_ = above_ground;
  if (!options_.from_degrees)
    throw InputError(
        fmt::format("{}: positions are latitude and longitude, which need a georeference.json beside "
                    "the scene file (docs/formats.md has its form; `wavetracer convert MAP -o FOLDER` writes one)",
                    file_));
  if (options_.scale != 1 || options_.offset_m != glm::dvec3(0))
    throw ConfigError(
        fmt::format("{}: positions are latitude and longitude, which the georeference of the scene places: "
                    "remove trajectories.offset_m and trajectories.scale",
                    file_));
}

// Converts file coordinates to those of the scene, and heights above the ground to z. A place without ground below gets
// the ground of the sample before.
void TrackBuilder::place(Track& track) {
  const bool on_ground = (above_ground_ || options_.above_ground) && options_.ground;
  double ground_m = 0;
  for (Sample& s : track.samples) {
    if (degrees_)
      s.position_m = glm::dvec3(options_.from_degrees(glm::dvec2(s.position_m)), s.position_m.z);
    else
      s.position_m = options_.scale * s.position_m + options_.offset_m;
    if (!on_ground) continue;
    const std::optional<double> below_m = options_.ground(glm::dvec2(s.position_m));
    off_ground_ += !below_m;
    ground_m = below_m.value_or(ground_m);
    s.position_m.z += ground_m;
    s.pitch_rad = not_given;  // pitch follows the ground
  }
}

Trajectories TrackBuilder::finish(ReferencePoint reference) {
  if (out_.tracks.empty())
    throw InputError(fmt::format("{}: the file contains no vehicle, so nothing would move", file_));
  set_order(out_);
  std::vector<std::string> cut, without_heading;
  double first_cut_s = 0;
  for (Track& track : out_.tracks) {
    place(track);
    if (const auto time_s = split_segments(track, out_.step_s, options_.max_speed_m_s, frames_s_)) {
      if (cut.empty()) first_cut_s = *time_s;
      cut.push_back(track.id);
    }
    if (complete_headings(track)) without_heading.push_back(track.id);
    if (reference == ReferencePoint::front_bumper) shift_to_centre(track, out_.types[track.type].length_m);
    complete_velocities(track);
  }
  if (!unknown_types_.empty()) {
    warn(fmt::format("{}: the sizes of the vehicle types {} are unknown: {} x {} x {} m is used", file_,
                     listed(unknown_types_), options_.default_type->length_m, options_.default_type->width_m,
                     options_.default_type->height_m));
  }
  if (off_network_ > 0) {
    warn(
        fmt::format("{}: {} samples have x or y = {:.0f}, which SUMO writes for a vehicle off the network: "
                    "the vehicle is absent at these times",
                    file_, off_network_, sumo_invalid));
  }
  if (off_ground_ > 0) {
    warn(fmt::format("{}: {} samples are outside of the ground: their vehicles keep the height that they had before",
                     file_, off_ground_));
  }
  if (changed_types_ > 0) {
    warn(fmt::format("{}: {} samples change the type of their vehicle, which keeps its first one", file_,
                     changed_types_));
  }
  if (!cut.empty()) {
    warn(fmt::format(
        "{}: gaps or teleports in {} tracks ({}), the first one after {} s: the vehicle is absent at these times",
        file_, cut.size(), listed(cut), first_cut_s));
  }
  if (!without_heading.empty()) {
    warn(fmt::format("{}: the heading of {} is not given, and they do not move: they point along +x", file_,
                     listed(without_heading)));
  }
  return std::move(out_);
}

}  // namespace wavetracer
