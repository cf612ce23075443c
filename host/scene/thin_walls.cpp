// SPDX-License-Identifier: Apache-2.0
// Finds strips first, then pairs in the order of triangles; then the numbers of vertices close up.
#include "scene/thin_walls.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr double least_aspect = 50, least_cosine = 0.9;
constexpr uint32_t alone = 0xFFFFFFFFu;

// A strip: a and b are the ends of its short side, c is far away.
struct Strip {
  uint32_t a, b, c;
};

std::optional<Strip> strip_of(const Weld& weld, const std::array<uint32_t, 3>& t) {
  for (size_t k = 0; k < 3; ++k) {
    const Strip s{weld.vertex[t[k]], weld.vertex[t[(k + 1) % 3]], weld.vertex[t[(k + 2) % 3]]};
    const dvec3 &a = weld.positions[s.a], &b = weld.positions[s.b], &c = weld.positions[s.c];
    const double across_m = glm::distance(a, b), along_m = std::min(glm::distance(a, c), glm::distance(b, c));
    if (s.a != s.b && across_m <= thin_wall_m && along_m >= least_aspect * across_m) return s;
  }
  return std::nullopt;
}

// Says where the faces beside strips go. strips: of each triangle.
class Sides {
 public:
  Sides(std::span<const std::array<uint32_t, 3>> triangles, const Weld& weld,
        std::span<const std::optional<Strip>> strips)
      : weld_(weld), triangles_(triangles) {
    std::vector<bool> by_strip(weld.positions.size());
    for (const std::optional<Strip>& s : strips)
      if (s) by_strip[s->a] = by_strip[s->b] = true;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
      if (strips[i]) continue;
      for (const uint32_t v : triangles[i])
        if (by_strip[weld.vertex[v]]) wide_.push_back({weld.vertex[v], i});
    }
    std::ranges::sort(wide_);
  }

  // Do faces go the same way from both long sides of the strip, as those of a wall, and not to either side of a step?
  bool are_of_wall(const Strip& s) const {
    for (const auto& [v, t] : at(s.a))
      for (const auto& [w, u] : at(s.b))
        if (t != u && glm::dot(way(s, s.a, t), way(s, s.b, u)) > least_cosine) return true;
    return false;
  }

 private:
  using Entry = std::pair<uint32_t, uint32_t>;  // a vertex, and a triangle that is no strip

  std::span<const Entry> at(uint32_t vertex) const {
    const auto found = std::ranges::equal_range(wide_, vertex, {}, &Entry::first);
    return {found.begin(), found.end()};
  }

  // From a corner of the strip into a face, across the strip's length; 0 where the face goes nowhere else.
  dvec3 way(const Strip& s, uint32_t corner, uint32_t t) const {
    dvec3 middle(0);
    for (const uint32_t v : triangles_[t]) middle += weld_.positions[weld_.vertex[v]] / 3.0;
    const dvec3 along = glm::normalize(weld_.positions[s.c] - weld_.positions[s.a]),
                to = middle - weld_.positions[corner];
    const dvec3 across = to - along * glm::dot(along, to);
    const double length_m = glm::length(across);
    return length_m > thin_wall_m ? across / length_m : dvec3(0);
  }

  const Weld& weld_;
  std::span<const std::array<uint32_t, 3>> triangles_;
  std::vector<Entry> wide_;
};

}  // namespace

uint64_t join_thin_walls(std::span<const std::array<uint32_t, 3>> triangles, Weld& weld) {
  std::vector<std::optional<Strip>> strips;
  for (const auto& t : triangles) strips.push_back(strip_of(weld, t));
  if (std::ranges::none_of(strips, [](const auto& s) { return s.has_value(); })) return 0;
  std::vector<uint32_t> partner(weld.positions.size(), alone);
  const Sides sides(triangles, weld, strips);
  for (const std::optional<Strip>& s : strips) {
    if (!s || partner[s->a] != alone || partner[s->b] != alone || !sides.are_of_wall(*s)) continue;
    partner[s->a] = s->b;
    partner[s->b] = s->a;
  }
  std::vector<uint32_t> number(partner.size());
  std::vector<glm::dvec3> kept;
  for (uint32_t i = 0; i < partner.size(); ++i) {
    if (partner[i] < i) {
      number[i] = number[partner[i]];
      continue;
    }
    number[i] = static_cast<uint32_t>(kept.size());
    kept.push_back(partner[i] == alone ? weld.positions[i] : (weld.positions[i] + weld.positions[partner[i]]) / 2.0);
  }
  const uint64_t joined = partner.size() - kept.size();
  for (uint32_t& vertex : weld.vertex) vertex = number[vertex];
  weld.positions = std::move(kept);
  return joined;
}

}  // namespace wavetracer
