// Reads what SUMO's floating car data says of vehicles, persons and containers, whether it is XML or CSV.
// Assumes that a file has one run, its timesteps in order.
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "motion/track_builder.hpp"

namespace wavetracer {

// A kind of what moves, by the name of its element.
struct FcdKind {
  std::string_view name, id_prefix, default_type;
  bool TrajectoryOptions::*wanted;  // null: always
};
inline constexpr FcdKind fcd_vehicle{"vehicle", "", "DEFAULT_VEHTYPE", nullptr};
inline constexpr FcdKind fcd_person{"person", "person:", "DEFAULT_PEDTYPE", &TrajectoryOptions::persons};
inline constexpr FcdKind fcd_container{"container", "container:", "DEFAULT_CONTAINERTYPE",
                                       &TrajectoryOptions::containers};

class FcdSamples {
 public:
  // The text of an attribute of the sample, "x" or "angle"; empty where it has none.
  using Find = std::function<std::optional<std::string_view>(std::string_view)>;

  // The options must outlive this.
  FcdSamples(const std::string& file, const TrajectoryOptions& options) : options_(options), tracks_(file, options) {}

  // A timestep begins. All that throws, throws InputError with file and line.
  void start(std::string_view time, uint64_t line);
  bool started() const { return started_; }
  // A sample of the timestep; what: as messages name it.
  void add(const FcdKind& kind, std::string_view id, std::string_view what, uint64_t line, const Find& find);
  void add_rider() { ++riders_; }
  void warn(std::string message) { tracks_.warn(std::move(message)); }
  // Coordinates are longitude and latitude, as the file itself says in this line.
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
  size_t decimals_ = 0;  // the most of any coordinate
  uint64_t skipped_ = 0, riders_ = 0;
};

}  // namespace wavetracer
