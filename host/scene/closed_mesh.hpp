// SPDX-License-Identifier: Apache-2.0
// Tells whether polygons bound a volume.
#pragma once
#include <map>
#include <utility>

namespace wavetracer {

// The edges of all polygons, each from one corner to the next, and how often each is there.
template <class Corner>
using DirectedEdges = std::map<std::pair<Corner, Corner>, int>;

// Has each edge one polygon on either side, and do these turn the same way?
template <class Corner>
bool edges_pair_up(const DirectedEdges<Corner>& edges) {
  for (const auto& [edge, count] : edges)
    if (count != 1 || !edges.contains({edge.second, edge.first})) return false;
  return true;
}

}  // namespace wavetracer
