// The waypoints.h5 of a run, read back one frame at a time: where sampled rays went (output.waypoints).
// Everything in the file is checked before it is used; an HDF5 file is input like any other.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include "results/saved_run.hpp"
#include "wavetracer/ray_waypoints.hpp"

namespace wavetracer {

class SavedWaypoints {
 public:
  // Throws InputError where the file is none of wavetracer's, or parts of it are missing or contradict each other.
  explicit SavedWaypoints(const std::filesystem::path& file);
  ~SavedWaypoints();
  SavedWaypoints(SavedWaypoints&&) noexcept;

  const std::filesystem::path& file() const;
  uint64_t count() const;                 // of all frames
  uint64_t count(uint32_t number) const;  // of this frame
  // The rows of a frame by its number; none where it has none. Sources are unknown in files of before format 2. Throws
  // InputError.
  WaypointRows frame(uint32_t number) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Of the waypoints.h5 beside the run's paths.h5; nothing where there is none.
std::optional<SavedWaypoints> saved_waypoints(const SavedRun& run);

}  // namespace wavetracer
