// SPDX-License-Identifier: Apache-2.0
// Collects the samples of a file, and makes Trajectories of them at its end.
// Samples are in file coordinates while it collects; those of one vehicle must come in order of time.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "motion/read.hpp"

namespace wavetracer {

// The number that SUMO writes for an unknown value (its INVALID_DOUBLE_VALUE): as x or y, it marks a vehicle that is
// not on the network.
constexpr double sumo_invalid = -1073741824;

// The point of the vehicle that a sample's position refers to.
enum class ReferencePoint { centre, front_bumper };

class TrackBuilder {
 public:
  // The options must outlive the builder.
  TrackBuilder(std::string file, const TrajectoryOptions& options);

  const std::string& file() const { return file_; }
  // what: the sample's name in messages, such as "vehicle 'a'"; size_m: length, width and height if the file gives them
  // (those of TrajectoryOptions::types take precedence, and for names that are no class of SUMO the default type).
  // Throws if the vehicle has a sample at this time or later.
  void add(std::string_view id, std::string_view type, const Sample& sample, uint64_t line, std::string_view what,
           const std::optional<glm::dvec3>& size_m = {});
  // Tells whether the vehicle is off the network, by its file coordinates, and counts it. Such a sample must not be
  // added: the vehicle is absent then.
  bool off_network(double x, double y) {
    const bool off = x == sumo_invalid || y == sumo_invalid;
    off_network_ += off;
    return off;
  }
  // Declares that positions are (longitude, latitude) in degrees and the height, which is above the ground unless the
  // file has heights of its own. Throws if the options cannot place degrees.
  void in_degrees(bool above_ground = true);
  // Declares that the file has a frame at this time; one that is not after those before is left out. If all frames are
  // declared, steps may vary: a vehicle is absent only in frames that lack it.
  void add_frame(double time_s) {
    if (frames_s_.empty() || time_s > frames_s_.back()) frames_s_.push_back(time_s);
  }
  void warn(std::string message) { out_.warnings.push_back(std::move(message)); }
  // Returns the tracks so far, by first appearance in the file, in file coordinates.
  const std::vector<Track>& tracks() const { return out_.tracks; }

  // Computes scene coordinates, segments, headings, velocities, and the final order.
  Trajectories finish(ReferencePoint reference);

 private:
  void check_sizes(const Sample& sample, uint64_t line, std::string_view what) const;
  void place(Track& track);
  uint32_t type_index(std::string_view name, uint64_t line, const std::optional<glm::dvec3>& size_m);

  struct Hash {
    using is_transparent = void;
    size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
  };
  template <class Value>
  using ByName = std::unordered_map<std::string, Value, Hash, std::equal_to<>>;

  std::string file_;
  const TrajectoryOptions& options_;
  Trajectories out_;
  std::vector<uint64_t> last_line_;  // for each track
  ByName<uint32_t> track_of_, type_of_;
  std::vector<double> frames_s_;
  std::vector<std::string> unknown_types_;
  uint64_t changed_types_ = 0, off_network_ = 0, off_ground_ = 0;
  bool degrees_ = false, above_ground_ = false;
};

}  // namespace wavetracer
