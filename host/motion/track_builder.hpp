// Collects the samples of a file as they come, and makes Trajectories of them at its end.
// Assumes file coordinates while it collects; the samples of one vehicle must come in order of time.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "motion/read.hpp"

namespace wavetracer {

// What SUMO writes for a value that it does not know (its INVALID_DOUBLE_VALUE): as x or y, of a vehicle that is not on
// the network.
constexpr double sumo_invalid = -1073741824;

// What the position of a sample is in the file.
enum class ReferencePoint { centre, front_bumper };

class TrackBuilder {
 public:
  // The options must outlive the builder.
  TrackBuilder(std::string file, const TrajectoryOptions& options);

  const std::string& file() const { return file_; }
  // what: the sample as messages name it, "vehicle 'a'"; size_m: length, width and height, where the file tells them
  // (those of TrajectoryOptions::types go before). Throws where the vehicle has a sample at this time or a later.
  void add(std::string_view id, std::string_view type, const Sample& sample, uint64_t line, std::string_view what,
           const std::optional<glm::dvec3>& size_m = {});
  // Whether the vehicle is off the network, by its file coordinates. Such a sample is not to be added, but counted
  // here: the vehicle is absent then.
  bool off_network(double x, double y) {
    const bool off = x == sumo_invalid || y == sumo_invalid;
    off_network_ += off;
    return off;
  }
  // Positions are (longitude, latitude) in degrees and the height, which is above the ground unless the file has
  // heights of its own. Throws where the options have nothing to place them with.
  void in_degrees(bool above_ground = true);
  void warn(std::string message) { out_.warnings.push_back(std::move(message)); }
  // The samples so far, by first appearance in the file, in file coordinates.
  const std::vector<Track>& tracks() const { return out_.tracks; }

  // Scene coordinates, segments, headings, velocities, and the final order.
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
  std::vector<uint64_t> last_line_;  // of each track
  ByName<uint32_t> track_of_, type_of_;
  std::vector<std::string> unknown_types_;
  uint64_t changed_types_ = 0, off_network_ = 0, off_ground_ = 0;
  bool degrees_ = false, above_ground_ = false;
};

}  // namespace wavetracer
