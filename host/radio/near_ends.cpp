// Paths are looked at on all cores; only where some are left out are the others copied.
#include "radio/near_ends.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "radio/path_rows.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {
namespace {

constexpr size_t most_named = 4;  // links of a warning

// Does the leg from an end to its neighbour on the path degenerate? entry: of the interaction there.
bool degenerates(const PathGeometry& paths, const SurfaceTable& surfaces, const WorldState& state,
                 const glm::dvec3& end_m, uint64_t entry) {
  if (glm::distance(end_m, paths.vertex[entry]) <= WT_ON_SURFACE_M) return true;
  return paths.interaction[entry] == Interaction::reflection &&
         std::abs(surfaces.above(surfaces.at(paths.surface[entry]), state, end_m)) <= WT_ON_SURFACE_M;
}

bool is_near(const PathGeometry& paths, const SurfaceTable& surfaces, const WorldState& state, size_t path) {
  const glm::dvec3& tx_m = state.transmitters[paths.tx[path]].position_m;
  const glm::dvec3& rx_m = state.receivers[paths.rx[path]].position_m;
  const uint64_t first = paths.first[path], end = paths.first[path + 1];
  if (first == end) return glm::distance(tx_m, rx_m) <= WT_ON_SURFACE_M;
  return degenerates(paths, surfaces, state, tx_m, first) || degenerates(paths, surfaces, state, rx_m, end - 1);
}

}  // namespace

PathGeometry without_near_ends(PathGeometry paths, const SurfaceTable& surfaces, const WorldState& state,
                               LeftOut& left_out) {
  left_out.clear();
  std::vector<char> near(paths.size());
  tbb::parallel_for(size_t{0}, paths.size(), [&](size_t path) { near[path] = is_near(paths, surfaces, state, path); });
  if (std::ranges::find(near, char{1}) == near.end()) return paths;
  std::vector<uint32_t> kept;
  for (uint32_t path = 0; path < paths.size(); ++path) {
    if (near[path])
      ++left_out[{paths.tx[path], paths.rx[path]}];
    else
      kept.push_back(path);
  }
  return rows_of(paths, kept);
}

std::string left_out_warning(const LeftOut& left_out, const EndName& tx_name, const EndName& rx_name) {
  uint64_t paths = 0;
  size_t links = 0;
  std::string named;
  for (const auto& [link, count] : left_out) {
    paths += count;
    if (++links <= most_named)
      named += fmt::format("{}\"{}\" -> \"{}\" ({})", links > 1 ? ", " : "", tx_name(link.tx), rx_name(link.rx), count);
  }
  if (links > most_named) named += fmt::format(" and {} more links", links - most_named);
  return fmt::format(
      "{} {} left out, because an antenna is at most {} m away from the surface that reflects there, or "
      "from the other antenna: {}; move the antenna",
      paths, paths == 1 ? "path is" : "paths are", WT_ON_SURFACE_M, named);
}

}  // namespace wavetracer
