// SPDX-License-Identifier: Apache-2.0
// The features in words, in the order of a path.
#include "simulation/checked_features.hpp"

namespace wavetracer {

CheckedFeatures CheckedFeatures::of(CheckedWays ways) {
  CheckedFeatures out{.ways = ways};
  switch (ways) {
    case CheckedWays::none:
      break;
    case CheckedWays::tile_edges:
      out.diffractions = 1;
      [[fallthrough]];
    case CheckedWays::tiles:
      out.instances = out.scattering = true;
      break;
    case CheckedWays::target_edges:
    case CheckedWays::heard_edges:
      out.diffractions = 1;
      break;
    case CheckedWays::targets:
      break;
    case CheckedWays::vegetation:
      out.scattering = true;
      break;
  }
  return out;
}

std::vector<CheckedFeatures> all_checked_features() {
  CacheConfig cache;
  cache.kind = "concurrent";
  CacheConfig grouped = cache;
  grouped.innerframe = true;
  std::vector<CheckedFeatures> out{
      {},
      {.instances = true, .reuse = true},
      {.diffractions = 3, .sums = true},
      {.instances = true, .transmission = true, .scattering = true, .diffractions = 1, .reuse = true},
      {.instances = true, .reuse = true, .beams = true},
      {.instances = true, .ordered = true},
      {.instances = true, .cache = cache},
      {.instances = true, .cache = grouped}};
  for (uint32_t ways = 1; ways <= checked_ways; ++ways)
    out.push_back(CheckedFeatures::of(static_cast<CheckedWays>(ways)));
  return out;
}

std::string CheckedFeatures::words() const {
  std::string out = "reflection";
  constexpr const char* edges[] = {"", ", diffraction", ", diffraction at two edges", ", diffraction at many edges"};
  out += edges[diffractions];
  if (transmission) out += ", transmission";
  if (scattering) out += ", scattering";
  if (instances) out += ", vehicles";
  if (reuse) out += ", frames that follow each other";
  if (beams) out += ", beams";
  if (ordered) out += ", sorted rays";
  if (sums) out += ", sums of links";
  constexpr const char* kinds[] = {"",
                                   ", reflections beside tiles",
                                   ", edges beside tiles",
                                   ", targets",
                                   ", edges beside targets",
                                   ", rays from edges",
                                   ", vegetation"};
  out += kinds[static_cast<uint32_t>(ways)];
  if (cache.on()) out += ", a ray cache (" + cache.kind.text() + (cache.innerframe ? ", within frames)" : ")");
  return out;
}

}  // namespace wavetracer
