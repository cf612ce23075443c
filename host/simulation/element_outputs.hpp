// SPDX-License-Identifier: Apache-2.0
// The outputs of a frame between the elements of arrays: responses ([response]), gains of beams (array.codebook), and
// what radars receive ([[radar]]).
#pragma once
#include <optional>
#include <vector>

#include "radio/beams.hpp"
#include "simulation/world.hpp"
#include "simulation/world_radars.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer {

// The cubes that rows of radars keep: none, those of radars with radar.cube, or all.
enum class CubesKept { none, configured, all };

class ElementOutputs {
 public:
  // config: has all ends of the world. All arguments must outlive this. Reads codebooks; throws ConfigError or
  // InputError.
  ElementOutputs(const Config& config, const Scene& scene, const World& world, const std::vector<WorldRadar>& radars);
  // Does a frame get any of these outputs?
  bool on() const { return beams_ || config_.response.bandwidth_hz || radars_at_once_; }
  // Adds them to a frame that is complete otherwise.
  void operator()(FrameResult& frame) const;
  // Returns the rows of each [[radar]] in a frame that has paths. Throws RuntimeError if they have too many cells.
  std::vector<RadarRows> radars(const FrameResult& frame, CubesKept cubes) const;
  // Returns the number of cells that these rows keep: those of cubes, or else of maps.
  uint64_t radar_cells(const FrameResult& frame, CubesKept cubes) const;

 private:
  bool keeps_cube(size_t radar, CubesKept cubes) const;

  const Config& config_;
  const std::vector<WorldRadar>& radars_;
  bool radars_at_once_;  // frames get them by themselves: not in live worlds
  std::optional<ElementModel> model_;
  std::optional<Beams> beams_;
};

}  // namespace wavetracer
