// SPDX-License-Identifier: Apache-2.0
// Bounds of the motion of the points of a path while its ends and all bodies move by at most r: every end stays in a
// ball of radius r about its place, and every body goes to a place to which no point of it is farther than r. The
// static scene is a body that does not move.
//
// 1. A body's rotation. If the points p and q of a body move by at most r each, their difference turns by at most 2 r.
//    So |R - 1| <= 2 r / h for the rotation R of a body that has, across any axis, two points at least h apart. A point
//    y that is carried along, at a distance l from a point of the body, moves by at most g(l) = r (1 + 2 l / h).
// 2. Images. Seen from a body at rest, a body's mirror has an image that moves as far as what it mirrors. So the image
//    of a point that moves by e, at a distance l from where the path meets the mirror, moves by at most e + 2 g(l), and
//    by e in a static mirror. (The image is g s g^-1 of the point, for the motion g of the body and the mirror s.)
// 3. Mirrors. The path unfolds to a straight line from an image I of one end to an image J of the other, of length L,
//    which meets the mirror's plane at P, at an angle whose sine to the plane is c. Seen from the mirror, I and J move
//    by at most q. So the point of the line that was at P is moved by a vector u of at most q, and the line meets the
//    plane at P + u - (n.u / n.d) d for its new direction d and the normal n. This is a projection along d, so it is no
//    longer than q / |n.d|, and |n.d| is at least (c L - 2 q) / (L + 2 q). I and J stay on their sides of the plane
//    while q < c min(|IP|, |PJ|).
// 4. Edges. Unfolded about its edge, a path with one diffraction is the straight line between two points of a plane,
//    whose coordinates are the distance from the edge and the place along it; they move by no more than the points do.
//    So 3. holds with the sine c of the angle between path and edge. The mirrors on either side see the point on the
//    edge as an end that moves by what was found.
// 5. A leg's points move by no more than the farther of its ends does.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "wavetracer/paths.hpp"

namespace wavetracer {

inline constexpr double at_rest = std::numeric_limits<double>::infinity();

// A plane, dot(normal, p) = offset_m.
struct StopPlane {
  glm::dvec3 normal;
  double offset_m;
};

// An end of a path, or an interaction of it.
struct Stop {
  glm::dvec3 p;
  std::optional<Interaction> interaction = {};  // none: an end
  uint32_t body = no_instance;                  // the instance that it is on
  double width_m = at_rest;                     // h of that body, see above
  double margin_m = at_rest;                    // distance to the border of the surface, or to the ends of the edge
  glm::dvec3 direction{0};                      // normal of the surface, or direction of the edge
  std::vector<StopPlane> planes = {};           // the surface's, or those of the faces of the edge
  std::array<uint32_t, 2> surfaces{no_instance, no_instance};  // those in these planes, as the body numbers them

  bool moves() const { return width_m != at_rest; }
};

// The stops of a path from the transmitter on, ends included. The bound holds for paths with at most one diffraction
// and without scattering and targets, whose stops are apart.
class PathMotion {
 public:
  // slack_m: heights above planes are taken to be smaller by this.
  PathMotion(std::vector<Stop> stops, double slack_m);

  // Returns the largest distance by which each stop may have moved, or nothing if a stop may have left its surface, its
  // edge, or the side of a surface on which its neighbour is. It grows with r_m.
  std::optional<std::vector<double>> moved_m(double r_m) const;

  const std::vector<Stop>& stops() const { return stops_; }

 private:
  using Moved = std::vector<double>;
  double carried_m(const Stop& by, double from_m, double r_m) const;
  Moved images_m(size_t from, size_t to, double moved_m, double r_m) const;
  std::optional<double> crossing_m(size_t stop, size_t from, size_t to, double seen_m) const;
  bool move_section(size_t from, size_t to, double r_m, Moved& moved) const;
  bool move_edge(double r_m, Moved& moved) const;
  bool keep_sides(double r_m, const Moved& moved) const;
  double way_m(size_t a, size_t b) const;

  std::vector<Stop> stops_;
  std::vector<double> along_m_;  // length of the path up to each stop
  size_t edge_;                  // the stop at an edge; 0: none
  double slack_m_;
};

}  // namespace wavetracer
