// SPDX-License-Identifier: Apache-2.0
// Reads the waypoints.h5 of a run, one frame at a time: points of sampled rays (output.waypoints). The file is not
// trusted: everything is checked before it is used.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include "results/saved_run.hpp"
#include "wavetracer/ray_waypoints.hpp"

namespace wavetracer {

class SavedWaypoints {
 public:
  // Throws InputError if the file was not written by wavetracer, or parts of it are missing or contradict each other.
  explicit SavedWaypoints(const std::filesystem::path& file);
  ~SavedWaypoints();
  SavedWaypoints(SavedWaypoints&&) noexcept;

  const std::filesystem::path& file() const;
  uint64_t count() const;                 // over all frames
  uint64_t count(uint32_t number) const;  // number in this frame
  // Returns the rows of a frame by its number; none if it has none. Sources are unknown in files before format 2.
  // Throws InputError.
  WaypointRows frame(uint32_t number) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Opens the waypoints.h5 beside the run's paths.h5; returns nothing if there is none.
std::optional<SavedWaypoints> saved_waypoints(const SavedRun& run);

}  // namespace wavetracer
