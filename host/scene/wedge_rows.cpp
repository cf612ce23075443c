// SPDX-License-Identifier: Apache-2.0
// Rows grow from their longest piece and keep its line, so that a chain of small bends cannot drift into a curve.
#include "scene/wedge_rows.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "scene/edge_pieces.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

dvec3 end_of(const Wedge& w) { return w.start + w.along * w.length_m; }

// Returns the direction of face 1, from the edge into it.
dvec3 other_face(const Wedge& w) { return w.face * std::cos(w.exterior_rad) + w.normal * std::sin(w.exterior_rad); }

// Returns the same wedge with the opposite direction along the edge.
Wedge turned(const Wedge& w) {
  const dvec3 face = other_face(w);
  return {
      end_of(w), -w.along, w.length_m, face, glm::cross(-w.along, face), w.exterior_rad, {w.surface[1], w.surface[0]}};
}

class Rows {
 public:
  explicit Rows(std::span<const WedgePiece> pieces) : pieces_(pieces), row_of_(pieces.size(), none) {
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      for (const uint32_t joint : pieces[i].joints) at_joint_.emplace_back(joint, i);
    }
    std::sort(at_joint_.begin(), at_joint_.end());
  }

  std::vector<Wedge> join() {
    std::vector<std::pair<double, uint32_t>> seeds;  // the longest first; of equal ones, the lowest
    for (uint32_t i = 0; i < pieces_.size(); ++i) seeds.emplace_back(-pieces_[i].wedge.length_m, i);
    std::sort(seeds.begin(), seeds.end());
    std::vector<Wedge> rows;
    for (const auto& [length, seed] : seeds) {
      if (row_of_[seed] == none) rows.push_back(grow(seed, static_cast<uint32_t>(rows.size())));
    }
    std::vector<Wedge> sorted;
    std::vector<bool> taken(rows.size(), false);
    for (const uint32_t row : row_of_) {
      if (!taken[row]) sorted.push_back(rows[row]);
      taken[row] = true;
    }
    return sorted;
  }

 private:
  static constexpr uint32_t none = 0xFFFFFFFFu;

  Wedge grow(uint32_t seed, uint32_t row) {
    Wedge wedge = pieces_[seed].wedge;
    row_of_[seed] = row;
    const double ahead_m = reach(wedge, pieces_[seed].joints[1], wedge.length_m, 1, row);
    const double behind_m = reach(wedge, pieces_[seed].joints[0], 0, -1, row);
    if (behind_m < 0) wedge.start += wedge.along * behind_m;
    wedge.length_m = ahead_m - behind_m;
    return wedge;
  }

  // Adds the pieces that continue from a joint at_m along the wedge, forwards or backwards; returns where they end.
  double reach(const Wedge& wedge, uint32_t joint, double at_m, double sense, uint32_t row) {
    for (bool grown = true; grown;) {
      grown = false;
      auto next = std::lower_bound(at_joint_.begin(), at_joint_.end(), std::pair(joint, 0u));
      for (; !grown && next != at_joint_.end() && next->first == joint; ++next) {
        const WedgePiece& piece = pieces_[next->second];
        if (row_of_[next->second] != none || !continues(wedge, piece.wedge)) continue;
        const bool at_start = piece.joints[0] == joint;
        const dvec3 far = (at_start ? end_of(piece.wedge) : piece.wedge.start) - wedge.start;
        const double far_m = glm::dot(far, wedge.along);
        if (sense * (far_m - at_m) <= 0 || glm::length(far - wedge.along * far_m) > touch_m) continue;
        row_of_[next->second] = row;
        at_m = far_m;
        joint = piece.joints[at_start ? 1 : 0];
        grown = true;
      }
    }
    return at_m;
  }

  static bool continues(const Wedge& row, const Wedge& piece) {
    const Wedge next = glm::dot(row.along, piece.along) < 0 ? turned(piece) : piece;
    return next.surface == row.surface && std::abs(next.exterior_rad - row.exterior_rad) <= same_angle_rad &&
           glm::dot(next.face, row.face) > 0;
  }

  std::span<const WedgePiece> pieces_;
  std::vector<uint32_t> row_of_;
  std::vector<std::pair<uint32_t, uint32_t>> at_joint_;  // joint, piece
};

}  // namespace

std::vector<Wedge> join_rows(std::span<const WedgePiece> pieces) { return Rows(pieces).join(); }

}  // namespace wavetracer
