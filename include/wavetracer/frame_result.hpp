// SPDX-License-Identifier: Apache-2.0
// The result of a frame: its paths and waypoints, the world that they belong to, counts, seconds and warnings.
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/cache_entries.hpp"
#include "wavetracer/certificate.hpp"
#include "wavetracer/kernel_time.hpp"
#include "wavetracer/late.hpp"
#include "wavetracer/link_figures.hpp"
#include "wavetracer/missed.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/radar.hpp"
#include "wavetracer/ray_waypoints.hpp"
#include "wavetracer/stages.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Counts of one frame. Every approximation and every loss is visible here.
struct FrameCounts {
  uint64_t rays = 0;      // launched
  uint64_t segments = 0;  // rays traced or answered by the cache, all depths
  uint64_t hits = 0;
  uint64_t sequences = 0;   // distinct prefixes, the empty one excluded
  uint64_t candidates = 0;  // sequence and receiver pairs that pass the conservative rejection
  uint64_t solved = 0;      // candidates whose points lie in their surfaces
  uint64_t paths = 0;       // visible, distinct
  uint64_t receptions = 0;  // segments that passed a receiver, with trace.reception = "sphere"
  uint64_t weak = 0;        // paths left out, because they are surely below a floor of scattering or targets
};

// The counts with their names in files, in the order of files. An optional one may be missing there.
struct FrameCountName {
  const char* name;
  uint64_t FrameCounts::*count;
  bool optional = false;
};
inline constexpr std::array frame_count_names{FrameCountName{"rays", &FrameCounts::rays},
                                              FrameCountName{"segments", &FrameCounts::segments},
                                              FrameCountName{"hits", &FrameCounts::hits},
                                              FrameCountName{"sequences", &FrameCounts::sequences},
                                              FrameCountName{"candidates", &FrameCounts::candidates},
                                              FrameCountName{"solved", &FrameCounts::solved},
                                              FrameCountName{"paths", &FrameCounts::paths},
                                              FrameCountName{"receptions", &FrameCounts::receptions},
                                              FrameCountName{"weak", &FrameCounts::weak, true}};
static_assert(sizeof(FrameCounts) == frame_count_names.size() * sizeof(uint64_t), "every count needs a name");

inline void add(FrameCounts& sum, const FrameCounts& more) {
  for (const FrameCountName& each : frame_count_names) sum.*each.count += more.*each.count;
}

// Statistics of the ray cache in a frame. Counts are of this frame alone.
struct CacheSummary {
  bool on = false;       // false: the frame had no cache, and everything below is 0 or empty
  uint64_t lookups = 0;  // look-ups by rays, at all depths
  uint64_t hits = 0;     // look-ups that were answered by the table
  uint64_t traced = 0;   // segments that were traced because the table did not answer them
  uint64_t groups = 0;   // with cache.innerframe: groups of equal keys in the frame, of which one ray each was traced
  uint64_t shared = 0;   // with cache.innerframe: segments that took the hit of the ray that was traced for their group
  uint64_t conflicts = 0;   // misses because another look-up or a write used the entry at that moment
  uint64_t stale = 0;       // misses although the key was found, because its entry has expired
  uint64_t stored = 0;      // entries written
  uint64_t replaced = 0;    // entries that were written over another one
  uint64_t duplicates = 0;  // writes of a key that the table contained already
  uint64_t dropped = 0;     // writes that collided with another or found no place; their segments are traced again
  uint64_t exhausted = 0;   // writes dropped because no entry was free
  uint64_t evicted = 0;     // entries removed: unused for long, or of a transmitter that has moved away
  uint64_t linked = 0;      // with cache.statistics: hits on the entry that the ray's previous entry links to
  // The table at the end of the frame: its size in entries, the entries that contain a segment, its device memory.
  uint64_t entries = 0, used = 0, bytes = 0;
  std::vector<uint64_t> lookups_per_depth, hits_per_depth, shared_per_depth;  // [0]: segments from transmitters
  // With cache.statistics: the numbers of used entries that have answered 0, 1, 2, 3-4, 5-8, 9-16, ... times. Else
  // empty.
  std::vector<uint64_t> entries_by_hits;
};

// Links without a path: the reasons for the first few, in words, and their number. Receivers of grids are counted
// separately, because receivers inside of houses have no path.
struct MissingLinks {
  static constexpr size_t shown = 5;
  uint64_t links = 0, in_grids = 0;
  std::vector<std::string> why, why_in_grids;
  bool empty() const { return links + in_grids == 0; }
};

// The paths of a frame at another carrier: the columns that differ from FrameResult::paths.
struct CarrierFields {
  double frequency_hz = 0;
  std::vector<std::array<std::complex<double>, 4>> a;
  std::vector<double> gain_db, doppler_hz;
};

// The channel of every link of a frame, in their order, at response_times_s() and response_frequencies_hz().
struct Responses {
  uint32_t times = 0, frequencies = 0;  // 0 if there are none
  // Link i has rows row_offset[i] to row_offset[i + 1] - 1, [time][rx antenna][tx antenna], see wavetracer/arrays.hpp.
  std::vector<uint64_t> row_offset{0};
  std::vector<std::complex<float>> h;  // [row][frequency]
};

// Gains of links through the beams of codebooks: rows for links of which at least one end has a codebook, sorted by
// link, then by beam; a side without a codebook has one beam, number 0, which is its first element.
struct BeamRows {
  std::vector<uint32_t> tx, rx, tx_beam, rx_beam;
  std::vector<double> gain_db;
  size_t size() const { return gain_db.size(); }
};

struct FrameResult {
  uint32_t frame = 0;
  WorldState world;
  Paths paths;
  std::optional<SummedPaths> summed;    // in place of paths, after Simulation::sum_links(true)
  std::vector<CarrierFields> carriers;  // fields at radio.frequencies_hz, without the first
  Responses responses;                  // with response.bandwidth_hz
  BeamRows beams;                       // with array.codebook
  std::vector<RadarRows> radars;        // a list for each [[radar]]; none in live worlds, see Simulation::radars
  FrameCounts counts;
  MissedCounts missed;      // unknown = 1 with a ray cache or trace.reception = "sphere", and where a warning says so
  Certificate certificate;  // with trace.discovery = "beams", else of no frames
  // With trace.diffraction_range_db: the most power that the paths over edges that were left out of a link have
  // together, over that of its strongest path without edges.
  double left_out_at_edges = 0;
  LateCounts late;       // set in a frame that launches rays after frames that did not, with trace.discover_every_s
  StageSeconds seconds;  // device stages only in frames that were profiled (Simulation::profile_every)
  KernelTimes kernels;   // for the device stages, in the same frames
  std::vector<uint64_t> segments_per_depth;
  CacheSummary cache;
  WaypointRows waypoints;        // waypoints of output.waypoints samples per transmitter
  CacheEntryRows cache_entries;  // with output.cache_entries
  std::vector<std::string> warnings;
  MissingLinks missing;  // set by Simulation::explain_missing, else empty
};

}  // namespace wavetracer
