// SPDX-License-Identifier: Apache-2.0
#include "radio/target_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "scene/closed_mesh.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr size_t most_pieces_of_body = 1 << 20;

using Corners = std::array<glm::dvec3, 3>;

// True if each edge has one triangle on either side, and these turn the same way, and the volume is positive.
bool bounds_volume(const Scene& model) {
  DirectedEdges<uint32_t> edges;
  double volume = 0;
  for (const auto& [a, b, c] : model.triangles) {
    const glm::dvec3 p(model.vertices[a]), q(model.vertices[b]), r(model.vertices[c]);
    volume += glm::dot(p, glm::cross(q, r));
    for (const auto& edge : {std::pair{a, b}, {b, c}, {c, a}}) ++edges[edge];
  }
  return edges_pair_up(edges) && volume > 0;
}

// Halves triangles until no edge is longer than this.
std::vector<Corners> cut(const Corners& triangle, double piece_m) {
  std::vector<Corners> out, waiting{triangle};
  while (!waiting.empty() && out.size() + waiting.size() <= most_pieces_of_body) {
    const Corners t = waiting.back();
    waiting.pop_back();
    size_t longest = 0;
    const auto length = [&](size_t i) { return glm::distance(t[i], t[(i + 1) % 3]); };
    for (size_t i = 1; i < 3; ++i)
      if (length(i) > length(longest)) longest = i;
    if (length(longest) <= piece_m) {
      out.push_back(t);
      continue;
    }
    const glm::dvec3 &from = t[longest], &to = t[(longest + 1) % 3], &across = t[(longest + 2) % 3];
    const glm::dvec3 middle = 0.5 * (from + to);
    waiting.push_back({middle, to, across});
    waiting.push_back({from, middle, across});
  }
  out.insert(out.end(), waiting.begin(), waiting.end());
  return out;
}

TargetPiece piece_of(const Corners& t, uint32_t surface, bool closed, bool inwards) {
  TargetPiece out{.centre_m = (t[0] + t[1] + t[2]) / 3.0,
                  .surface = surface,
                  .lit_above = !closed || !inwards,
                  .lit_below = !closed || inwards,
                  .facet = {}};
  for (int corner = 0; corner < 3; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      out.facet.corners[3 * corner + axis] = t[static_cast<size_t>(corner)][axis] - out.centre_m[axis];
  out.facet.turned = inwards;
  return out;
}

}  // namespace

std::vector<TargetPiece> pieces_of_body(const Scene& model, double piece_m, const std::string& target_model) {
  const bool closed = bounds_volume(model);
  std::vector<TargetPiece> out;
  for (size_t i = 0; i < model.triangles.size(); ++i) {
    Corners corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = glm::dvec3(model.vertices[model.triangles[i][k]]) + model.origin_m;
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(glm::length(normal) > 0)) continue;
    const uint32_t surface = model.triangle_surface[i];
    const bool inwards = glm::dot(normal, model.surfaces[surface].normal) < 0;
    for (const Corners& piece : cut(corners, piece_m)) out.push_back(piece_of(piece, surface, closed, inwards));
    if (out.size() > most_pieces_of_body)
      throw ConfigError(fmt::format(
          "[[target_model]] \"{}\" cuts the body of {} into more than {} pieces: raise piece_m, which is {} "
          "m, or use a body with fewer facets",
          target_model, model.file.empty() ? "a vehicle" : model.file, most_pieces_of_body, piece_m));
  }
  return out;
}

}  // namespace wavetracer
