// SPDX-License-Identifier: Apache-2.0
// Reads the data of vehicles, persons and containers in SUMO's floating car data, as XML or CSV. A file must have one
// run, with its timesteps in order.
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "motion/track_builder.hpp"

namespace wavetracer {

// A kind of moving object, by the name of its element.
struct FcdKind {
  std::string_view name, id_prefix, default_type;
  bool TrajectoryOptions::*wanted;  // null if it is always wanted
};
inline constexpr FcdKind fcd_vehicle{"vehicle", "", "DEFAULT_VEHTYPE", nullptr};
inline constexpr FcdKind fcd_person{"person", "person:", "DEFAULT_PEDTYPE", &TrajectoryOptions::persons};
inline constexpr FcdKind fcd_container{"container", "container:", "DEFAULT_CONTAINERTYPE",
                                       &TrajectoryOptions::containers};

class FcdSamples {
 public:
  // Returns the text of an attribute of the sample, such as "x" or "angle"; nothing if it is missing.
  using Find = std::function<std::optional<std::string_view>(std::string_view)>;

  // The options must outlive this object.
  FcdSamples(const std::string& file, const TrajectoryOptions& options) : options_(options), tracks_(file, options) {}

  // Begins a timestep. All functions throw InputError with file and line.
  void start(std::string_view time, uint64_t line);
  bool started() const { return started_; }
  // Adds a sample of the timestep; what: the object's name for messages.
  void add(const FcdKind& kind, std::string_view id, std::string_view what, uint64_t line, const Find& find);
  void add_rider() { ++riders_; }
  void warn(std::string message) { tracks_.warn(std::move(message)); }
  // Declares that coordinates are longitude and latitude, as the file itself says in this line.
  void in_degrees(uint64_t line);

  Trajectories finish();

 private:
  struct Motion {
    double driven_m = 0, moved = 0;
  };
  Motion motion() const;
  bool is_in_degrees() const;
  void place_degrees();

  const TrajectoryOptions& options_;
  TrackBuilder tracks_;
  bool started_ = false, degrees_ = false, has_z_ = false;
  double time_s_ = 0;
  uint64_t timestep_line_ = 0;
  size_t decimals_ = 0;  // largest number of decimals of any coordinate
  uint64_t skipped_ = 0, riders_ = 0;
};

}  // namespace wavetracer
