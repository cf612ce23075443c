// SPDX-License-Identifier: Apache-2.0
// Triangles with the same three corners form a group. Three sets of faces are tried in turn to close the mesh: one of
// every group; those that are left when opposite ones cancel; and one of every group with an odd number of triangles.
#include "scene/volume_faces.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

namespace wavetracer {
namespace {

using EdgeKey = std::array<uint32_t, 2>;

EdgeKey key_of(uint32_t a, uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

struct FaceGroup {
  Triangle first;
  uint64_t forward = 0, backward = 0;  // number with the orientation of the first one, and with the opposite one
  uint64_t count() const { return forward + backward; }
};

bool same_sense(const Triangle& a, const Triangle& b) {
  const auto at = static_cast<size_t>(std::ranges::find(b, a[0]) - b.begin());
  return b[(at + 1) % 3] == a[1];
}

std::vector<FaceGroup> groups_of(const std::vector<Triangle>& triangles) {
  std::map<Triangle, size_t> place;
  std::vector<FaceGroup> out;
  for (const Triangle& t : triangles) {
    Triangle sorted = t;
    std::ranges::sort(sorted);
    const auto [at, added] = place.try_emplace(sorted, out.size());
    if (added) out.push_back({t});
    FaceGroup& group = out[at->second];
    ++(same_sense(group.first, t) ? group.forward : group.backward);
  }
  return out;
}

// Returns the number of edges that are not passed equally often in both directions, and the number of all edges.
std::array<uint64_t, 2> open_edges(const std::vector<Triangle>& triangles) {
  std::map<EdgeKey, int> passes;  // passes from the lower vertex minus passes to it
  for (const Triangle& t : triangles)
    for (size_t i = 0; i < 3; ++i) passes[key_of(t[i], t[(i + 1) % 3])] += t[i] < t[(i + 1) % 3] ? 1 : -1;
  const auto open = std::ranges::count_if(passes, [](const auto& edge) { return edge.second != 0; });
  return {static_cast<uint64_t>(open), passes.size()};
}

double six_volumes(std::span<const glm::dvec3> positions, const std::vector<Triangle>& triangles,
                   const std::vector<size_t>& of) {
  const glm::dvec3& base = positions[triangles[of.front()][0]];
  double out = 0;
  for (const size_t t : of) {
    const auto& [a, b, c] = triangles[t];
    out += glm::dot(positions[a] - base, glm::cross(positions[b] - base, positions[c] - base));
  }
  return out;
}

// Orients triangles, two of which meet at every edge, so that neighbours pass it in opposite directions and every
// closed part faces outwards. Returns nothing if an edge has another number of triangles, or a part has only one side.
std::optional<std::vector<Triangle>> turned_outwards(std::span<const glm::dvec3> positions,
                                                     std::vector<Triangle> triangles) {
  std::map<EdgeKey, std::vector<size_t>> at_edge;
  for (size_t t = 0; t < triangles.size(); ++t)
    for (size_t i = 0; i < 3; ++i) at_edge[key_of(triangles[t][i], triangles[t][(i + 1) % 3])].push_back(t);
  if (std::ranges::any_of(at_edge, [](const auto& edge) { return edge.second.size() != 2; })) return {};
  std::vector<bool> seen(triangles.size());
  for (size_t start = 0; start < triangles.size(); ++start) {
    if (seen[start]) continue;
    std::vector<size_t> part{start};
    seen[start] = true;
    for (size_t next = 0; next < part.size(); ++next)
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = triangles[part[next]][i], b = triangles[part[next]][(i + 1) % 3];
        const std::vector<size_t>& both = at_edge[key_of(a, b)];
        const size_t other = both[0] == part[next] ? both[1] : both[0];
        Triangle& t = triangles[other];
        const bool opposite = t[(static_cast<size_t>(std::ranges::find(t, b) - t.begin()) + 1) % 3] == a;
        if (!opposite && seen[other]) return {};
        if (!opposite) std::swap(t[1], t[2]);
        if (!seen[other]) part.push_back(other);
        seen[other] = true;
      }
    if (six_volumes(positions, triangles, part) < 0)
      for (const size_t t : part) std::swap(triangles[t][1], triangles[t][2]);
  }
  return triangles;
}

template <class Keep>
std::vector<Triangle> first_of(const std::vector<FaceGroup>& groups, const Keep& keep) {
  std::vector<Triangle> out;
  for (const FaceGroup& group : groups)
    if (keep(group)) out.push_back(group.first);
  return out;
}

// Returns the triangles that more often have one orientation than the other, in that orientation.
std::vector<Triangle> uncancelled(const std::vector<FaceGroup>& groups) {
  std::vector<Triangle> out;
  for (const FaceGroup& group : groups) {
    if (group.forward == group.backward) continue;
    out.push_back(group.first);
    if (group.backward > group.forward) std::swap(out.back()[1], out.back()[2]);
  }
  return out;
}

}  // namespace

ClosedFaces closed_faces(std::span<const glm::dvec3> positions, const std::vector<Triangle>& triangles) {
  const std::vector<FaceGroup> groups = groups_of(triangles);
  ClosedFaces out;
  const auto [open, edges] = open_edges(triangles);
  out.open_edges = open;
  out.edges = edges;
  const auto keep = [&](std::vector<Triangle> kept) {
    out.repeated = triangles.size() - kept.size();
    out.triangles = std::move(kept);
    out.open_edges = 0;
    return out;
  };
  const auto all = [](const FaceGroup&) { return true; };
  const bool once = groups.size() == triangles.size();
  if (once && open == 0) return keep(triangles);
  if (once) return out;
  if (auto turned = turned_outwards(positions, first_of(groups, all))) return keep(*std::move(turned));
  const auto there_once = [](const FaceGroup& group) { return group.forward <= 1 && group.backward <= 1; };
  if (std::vector<Triangle> left = uncancelled(groups); !left.empty() && open_edges(left)[0] == 0)
    return keep(std::ranges::all_of(groups, there_once) ? triangles : std::move(left));
  const uint64_t fewest = std::ranges::min_element(groups, {}, &FaceGroup::count)->count();
  const auto odd = [&](const FaceGroup& group) { return group.count() / fewest % 2 == 1; };
  if (auto turned = turned_outwards(positions, first_of(groups, odd)); turned && !turned->empty())
    return keep(*std::move(turned));
  return out;
}

}  // namespace wavetracer
