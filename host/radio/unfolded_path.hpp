// SPDX-License-Identifier: Apache-2.0
// A path between points near those that it was solved for. Its mirrors are unfolded, so it is straight except at the
// edges and tiles that bend it. Its mirrors are planes, and its edges are lines that go on beyond their ends: whether a
// point is hidden is not tested.
#pragma once
#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace wavetracer {

// p -> turn p + shift: the effect of several mirrors, one after the other.
struct Isometry {
  glm::dmat3 turn{1.0};
  glm::dvec3 shift{0};
  glm::dvec3 operator()(const glm::dvec3& p) const { return turn * p + shift; }
};

// Returns the isometry after one more mirror. normal: of unit length; point: in the mirror.
Isometry mirrored(const Isometry& image, const glm::dvec3& normal, const glm::dvec3& point);

// A path has at most trace.max_diffractions = 8 edges, or a point that scatters and an edge on either side of it.
inline constexpr int most_bends = 8;

// A place where a path bends, other than a mirror.
struct Bend {
  glm::dvec3 point{0};
  glm::dvec3 along{0};  // for an edge, unit length; 0 for a point that scatters
  bool edge() const { return along != glm::dvec3(0); }
};

// The length of a path, and the spreading of its wave: the factor 1 / length for a path without bends, and its
// replacement where there are bends (path_edges.h, path_field.h).
struct PathSpread {
  double length_m, amplitude;
};

// Coordinates of points, each a column.
struct PointColumns {
  std::vector<double> x, y, z;
  void add(const glm::dvec3& p) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  size_t size() const { return x.size(); }
};

struct UnfoldedPath {
  Isometry sent, heard;  // images of the transmitter in mirrors before the first bend, of the receiver in the others
  std::array<Bend, most_bends> bends;  // bends after a mirror that follows the first one are images, too
  int count = 0;                       // the number of bends

  // The coordinates of a point's image from which lengths are computed: its place where nothing or several bends are on
  // the way; its distance from a point that scatters; its place along one edge and its distance from the edge's line.
  glm::dvec3 coordinates(const glm::dvec3& image) const;
  // Computes lengths between points first to first + points - 1 of `from` and one point, all in coordinates.
  void between(const PointColumns& from, size_t first, size_t points, const glm::dvec3& to, double* length_m,
               double* amplitude) const;
  // Computes them between the images of a transmitter's point and of a receiver's. One edge has a closed form. With
  // several bends Newton's method finds the shortest way over all lines, to 1e-12 of its length.
  PathSpread between(const glm::dvec3& sent_image, const glm::dvec3& heard_image) const;
};

}  // namespace wavetracer
