// SPDX-License-Identifier: Apache-2.0
// Mirrors that see a surface are listed once for all of its pieces; only the last mirror is asked by piece.
#include "radio/body_bounces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr size_t most_bounces_of_body = size_t{1} << 22;
constexpr double on_plane_m = 1e-4;  // a point that is nearer to a plane is on it

// A surface of the body: its corners, and the sides that are lit.
struct Reflector {
  std::vector<glm::dvec3> corners;
  bool lit_above = false, lit_below = false;
};

// Throws ConfigError if there are too many pairs or chains of facets of a body.
void check_number(size_t chains, const Scene& model, uint32_t bounces, const std::string& target_model) {
  if (chains > most_bounces_of_body)
    throw ConfigError(fmt::format(
        "[[target_model]] \"{}\" with bounces = {} makes more than {} chains of facets of the body of {}: lower "
        "bounces, raise piece_m, or use a body with fewer facets",
        target_model, bounces, most_bounces_of_body, model.file.empty() ? "a vehicle" : model.file));
}

class Mirrors {
 public:
  // check: throws where the number of pairs is too large.
  Mirrors(const Scene& model, const std::vector<TargetPiece>& pieces, const std::function<void(size_t)>& check)
      : model_(model), all_(model.surfaces.size()) {
    for (size_t i = 0; i < model.triangles.size(); ++i)
      for (const uint32_t corner : model.triangles[i])
        all_[model.triangle_surface[i]].corners.emplace_back(model.vertices[corner]);
    for (const TargetPiece& piece : pieces) {
      all_[piece.surface].lit_above = piece.lit_above;
      all_[piece.surface].lit_below = piece.lit_below;
    }
    before_.resize(all_.size());
    size_t pairs = 0;
    for (uint32_t to = 0; to < all_.size(); ++to) {
      for (uint32_t from = 0; from < all_.size(); ++from)
        if (from != to && sees_part(from, to) && sees_part(to, from)) before_[to].push_back(from);
      check(pairs += before_[to].size());
    }
  }

  // The mirrors from which a wave may come to the surface.
  const std::vector<uint32_t>& before(uint32_t surface) const { return before_[surface]; }

  // Is the point, in the coordinates of the model's file, on a lit side of the surface?
  bool lights(uint32_t surface, const glm::dvec3& point_m) const {
    return lit_side(surface, point_m - model_.origin_m);
  }

 private:
  bool lit_side(uint32_t surface, const glm::dvec3& p) const {
    const Surface& plane = model_.surfaces[surface];
    const double above_m = glm::dot(glm::dvec3(plane.normal), p) - plane.offset_m;
    return (all_[surface].lit_above && above_m > on_plane_m) || (all_[surface].lit_below && above_m < -on_plane_m);
  }
  // Is a part of the other surface on a lit side of this one?
  bool sees_part(uint32_t surface, uint32_t other) const {
    return std::ranges::any_of(all_[other].corners, [&](const glm::dvec3& p) { return lit_side(surface, p); });
  }

  const Scene& model_;
  std::vector<Reflector> all_;
  std::vector<std::vector<uint32_t>> before_;
};

}  // namespace

std::vector<BodyBounce> bounces_of_body(const Scene& model, const std::vector<TargetPiece>& pieces, uint32_t bounces,
                                        const std::string& target_model) {
  std::vector<BodyBounce> out;
  if (bounces < 2) return out;
  const auto check = [&](size_t chains) { check_number(chains, model, bounces, target_model); };
  const Mirrors mirrors(model, pieces, check);
  for (uint32_t i = 0; i < pieces.size(); ++i) {
    for (const uint32_t last : mirrors.before(pieces[i].surface)) {
      if (!mirrors.lights(last, pieces[i].centre_m)) continue;
      check(out.size() + 1 + (bounces < 3 ? 0 : mirrors.before(last).size()));
      out.push_back({i, 1, {last, last}});
      if (bounces < 3) continue;
      for (const uint32_t first : mirrors.before(last)) out.push_back({i, 2, {first, last}});
    }
  }
  return out;
}

}  // namespace wavetracer
