// SPDX-License-Identifier: Apache-2.0
// Made-up runs for the pages of the viewer: no device, but a city, vehicles and paths with their places in it. Gains,
// delays and angles are functions of the geometry, so that the numbers on the page can be computed again.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace wavetracer::test {

struct MadeRun {
  uint32_t vehicles = 2, frames = 11, paths_a_link = 6;
  std::string scene = "generate = \"--seed 1 --blocks 2x2\"";  // of the configuration
  std::string prefix = {};                                     // prefix of all names
  // The frames have: rays that estimate what they missed, rays that do not show it, or a certificate of beams, to depth
  // 5 but for 2^-30 sr of the directions of three ends.
  enum class Found { rays, sparse_rays, beams } found = Found::rays;
};

// Writes paths.h5 and the rest into the folder. One road-side unit sends, every vehicle sends and receives.
void write_made_run(const MadeRun& made, const std::filesystem::path& folder);

struct MadeMap {
  uint32_t columns, rows;
  bool upright = false;  // rows go up from 1 m, and columns along (0.6, 0.8) from (-3, 4)
  uint32_t frames = 1;   // at 0 s, 0.5 s and so on; the first transmitter goes 6 m to the west between two of them
  std::optional<uint32_t> max_paths_per_link = {};  // as in [output]
  bool beams = false;  // links of cells with a path have the gains of 15 beams, and the best one is column modulo 15
};

// Frames of two transmitters, a receiver "car" and a grid "map" of cells of 1 m around the origin, 1.5 m high. Cells of
// columns 0, 3, 6 ... have a direct and a reflected path, those of 1, 4, 7 ... a reflected one, the others none.
void write_made_coverage(const MadeMap& made, const std::filesystem::path& folder);

// Two frames, f = 0 and 1, without paths, of two sampled rays that start at (0, 0, 10). The first meets (10 + f, 0, 0),
// passes the receiver, meets (10 + f, 10, 5), which the cache answered, and is lost; the second meets (20 + f, 0, 0),
// which the cache answered, and is lost.
void write_made_rays(const std::filesystem::path& folder);

}  // namespace wavetracer::test
