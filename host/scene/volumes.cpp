// SPDX-License-Identifier: Apache-2.0
// The sign of the volume of a closed part tells which side of its triangles is outside.
#include "scene/volumes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "scene/raw_scene.hpp"
#include "scene/weld.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

// Finds the outside of a closed mesh, even if the file has some triangles more than once.
struct ClosedFaces {
  std::vector<Triangle> triangles;     // empty if the mesh is not closed
  uint64_t repeated = 0;               // number of dropped triangles, which repeat the corners of an earlier one
  uint64_t edges = 0, open_edges = 0;  // open edges are not passed equally often in both directions
};

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

// Takes connected triangles over shared vertices. A mesh that has every triangle once is taken unchanged if every edge
// is passed equally often in both directions. If triangles are repeated, in either orientation, each counts once, and
// all are turned outwards; a wall between two closed parts (there twice as often as the others, or in both
// orientations) is dropped.
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

glm::dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

uint32_t root_of(std::vector<uint32_t>& parent, uint32_t vertex) {
  while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
  return vertex;
}

[[noreturn]] void fail_open(const RawMesh& mesh, const ClosedFaces& faces) {
  throw InputError(
      fmt::format("{}: mesh '{}' is vegetation, which must be a closed mesh, "
                  "but {} of its {} edges have no triangle on one side, or triangles that are turned differently: "
                  "close it, turn all of its triangles outwards, or give it another material",
                  mesh.where, mesh.name, faces.open_edges, faces.edges));
}

Volume volume_of(const std::vector<dvec3>& positions, const std::vector<Triangle>& triangles, uint32_t material) {
  Volume out{.shape = VolumeShape::mesh, .material = material};
  dvec3 lower = positions[triangles[0][0]], upper = lower;
  double six_volumes = 0;
  for (const Triangle& t : triangles) {
    const std::array<dvec3, 3> corners{positions[t[0]], positions[t[1]], positions[t[2]]};
    for (const dvec3& corner : corners) {
      lower = glm::min(lower, corner);
      upper = glm::max(upper, corner);
    }
    const dvec3& base = positions[triangles[0][0]];
    six_volumes += glm::dot(corners[0] - base, glm::cross(corners[1] - base, corners[2] - base));
    out.triangles.push_back(corners);
  }
  if (six_volumes < 0)
    for (auto& corners : out.triangles) std::swap(corners[1], corners[2]);
  out.centre = 0.5 * (lower + upper);
  out.half_size = 0.5 * (upper - lower);
  return out;
}

}  // namespace

void add_volumes(RawScene& raw, const std::vector<VegetationConfig>& vegetation) {
  for (const VegetationConfig& from : vegetation) {
    for (const double size_m : from.size_m)
      if (!(size_m > 0))
        throw ConfigError(fmt::format("[[vegetation]]: size_m = [{}, {}, {}], but all of it must be positive",
                                      from.size_m[0], from.size_m[1], from.size_m[2]));
    RawVolume out;
    out.volume.shape = static_cast<VolumeShape>(from.shape.index());
    out.volume.centre = vector_of(from.centre_m);
    out.volume.half_size = 0.5 * vector_of(from.size_m);
    out.volume.yaw_rad = from.yaw_deg * std::numbers::pi / 180;
    out.material = from.material;
    raw.volumes.push_back(std::move(out));
  }
}

std::vector<Volume> mesh_volumes(const RawMesh& mesh, uint32_t material, LoadReport* report) {
  const Weld weld = weld_vertices(mesh.vertices, weld_tolerance_m);
  std::vector<uint32_t> parent(weld.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    const Triangle welded{weld.vertex[t[0]], weld.vertex[t[1]], weld.vertex[t[2]]};
    if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) continue;
    triangles.push_back(welded);
    for (int i = 1; i < 3; ++i) parent[root_of(parent, welded[i])] = root_of(parent, welded[0]);
  }
  std::map<uint32_t, std::vector<Triangle>> parts;
  for (const Triangle& t : triangles) parts[root_of(parent, t[0])].push_back(t);
  std::vector<Volume> out;
  ClosedFaces not_closed;
  for (const auto& [root, part] : parts) {
    const ClosedFaces faces = closed_faces(weld.positions, part);
    not_closed.edges += faces.edges;
    not_closed.open_edges += faces.open_edges;
    if (report != nullptr) report->duplicate_triangles += faces.repeated;
    if (!faces.triangles.empty()) out.push_back(volume_of(weld.positions, faces.triangles, material));
    if (faces.triangles.empty()) not_closed.triangles = part;
  }
  if (!not_closed.triangles.empty()) fail_open(mesh, not_closed);
  return out;
}

}  // namespace wavetracer
