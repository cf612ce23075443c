// A path between points near those that it was solved for: mirrors unfolded, so that what is left of it is straight but
// for the edges and tiles that bend it.
// Its mirrors are planes and its edges lines that go on beyond their ends: whether a point is hidden is not asked.
#pragma once
#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace wavetracer {

// p -> turn p + shift: several mirrors, one after the other.
struct Isometry {
  glm::dmat3 turn{1.0};
  glm::dvec3 shift{0};
  glm::dvec3 operator()(const glm::dvec3& p) const { return turn * p + shift; }
};

// What a mirror makes of an isometry. normal: of unit length; point: in the mirror.
Isometry mirrored(const Isometry& image, const glm::dvec3& normal, const glm::dvec3& point);

// Where a path bends, but for its mirrors.
struct Bend {
  glm::dvec3 point{0};
  glm::dvec3 along{0};  // of an edge, unit length; 0 of a point that scatters
  bool edge() const { return along != glm::dvec3(0); }
};

// How long a path is, and how its wave spreads: the factor 1 / length of a path without bends, and what takes its place
// where there are bends (path_edges.h, path_field.h).
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
  Isometry sent, heard;  // what mirrors before the first bend make of the transmitter, those after it of the receiver
  std::array<Bend, 2> bends;  // two only of edges
  int count = 0;              // of them

  // What lengths are made of, of a point's image: its place where nothing or two edges bend the path; its distance from
  // a point that scatters; how far along one edge it is, and how far away from its line.
  glm::dvec3 coordinates(const glm::dvec3& image) const;
  // Between points first to first + points - 1 of some and one, all in coordinates.
  void between(const PointColumns& from, size_t first, size_t points, const glm::dvec3& to, double* length_m,
               double* amplitude) const;
  // Between the images of a transmitter's point and of a receiver's. One edge: a closed form. Two edges: the shortest
  // way over both lines by Newton's method, to 1e-12 of its length.
  PathSpread between(const glm::dvec3& sent_image, const glm::dvec3& heard_image) const;
};

}  // namespace wavetracer
