// SPDX-License-Identifier: Apache-2.0
// Numbers in comments are those of the header's list.
#include "lifetime/path_motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace wavetracer {

PathMotion::PathMotion(std::vector<Stop> stops, double slack_m)
    : stops_(std::move(stops)), along_m_{0}, edge_(0), slack_m_(slack_m) {
  for (size_t k = 1; k < stops_.size(); ++k) {
    along_m_.push_back(along_m_.back() + glm::distance(stops_[k - 1].p, stops_[k].p));
    if (stops_[k].interaction == diffraction) edge_ = k;
  }
}

double PathMotion::way_m(size_t a, size_t b) const { return std::abs(along_m_[a] - along_m_[b]); }

// 1.: the motion of a point that a body carries along, at this distance from the stop.
double PathMotion::carried_m(const Stop& by, double from_m, double r_m) const {
  return by.moves() ? r_m * (1 + 2 * from_m / by.width_m) : 0;
}

// 2.: the motion of the image of stop `from` that each stop on the way to `to` sees, before it mirrors the image.
PathMotion::Moved PathMotion::images_m(size_t from, size_t to, double moved_m, double r_m) const {
  Moved out(stops_.size(), moved_m);
  const int step = from < to ? 1 : -1;
  double image = moved_m;
  for (size_t k = from + step; k != to; k += step) {
    out[k] = image;
    if (stops_[k].interaction == reflection) image += 2 * carried_m(stops_[k], way_m(from, k), r_m);
  }
  out[to] = image;
  return out;
}

// 3. and 4.: the motion of the stop on its surface or edge. seen_m: q. from, to: the ends of the straight line.
std::optional<double> PathMotion::crossing_m(size_t stop, size_t from, size_t to, double seen_m) const {
  const Stop& at = stops_[stop];
  const glm::dvec3 way = glm::normalize(at.p - stops_[stop - 1].p);
  const double along = glm::dot(way, at.direction);
  const double sine = stop == edge_ ? std::sqrt(std::max(0.0, 1 - along * along)) : std::abs(along);
  const double length = way_m(from, to);
  if (!(seen_m < sine * std::min(way_m(from, stop), way_m(stop, to)))) return std::nullopt;
  const double moved = seen_m * (length + 2 * seen_m) / (sine * length - 2 * seen_m);
  if (!(moved < at.margin_m)) return std::nullopt;
  return moved;
}

bool PathMotion::move_section(size_t from, size_t to, double r_m, Moved& moved) const {
  const Moved ahead = images_m(from, to, moved[from], r_m), behind = images_m(to, from, moved[to], r_m);
  for (size_t k = from + 1; k < to; ++k) {
    const double seen = std::max(ahead[k] + carried_m(stops_[k], way_m(from, k), r_m),
                                 behind[k] + carried_m(stops_[k], way_m(k, to), r_m));
    const std::optional<double> crossing = crossing_m(k, from, to, seen);
    if (!crossing) return false;
    moved[k] = *crossing + carried_m(stops_[k], 0, r_m);
  }
  return true;
}

bool PathMotion::move_edge(double r_m, Moved& moved) const {
  const size_t last = stops_.size() - 1;
  const Stop& edge = stops_[edge_];
  const double seen = std::max(images_m(0, edge_, r_m, r_m)[edge_] + carried_m(edge, way_m(0, edge_), r_m),
                               images_m(last, edge_, r_m, r_m)[edge_] + carried_m(edge, way_m(edge_, last), r_m));
  const std::optional<double> crossing = crossing_m(edge_, 0, last, seen);
  if (!crossing) return false;
  moved[edge_] = *crossing + carried_m(edge, 0, r_m);
  return true;
}

// Every neighbour of a stop stays on its side of the planes there, seen from the body of the stop.
bool PathMotion::keep_sides(double r_m, const Moved& moved) const {
  const auto keeps = [&](const Stop& at, size_t other) {
    const double seen = moved[other] + carried_m(at, glm::distance(at.p, stops_[other].p), r_m);
    return std::ranges::all_of(at.planes, [&](const StopPlane& plane) {
      return seen + slack_m_ < std::abs(glm::dot(plane.normal, stops_[other].p) - plane.offset_m);
    });
  };
  for (size_t k = 1; k + 1 < stops_.size(); ++k)
    if (!keeps(stops_[k], k - 1) || !keeps(stops_[k], k + 1)) return false;
  return true;
}

std::optional<std::vector<double>> PathMotion::moved_m(double r_m) const {
  Moved moved(stops_.size(), r_m);
  const size_t last = stops_.size() - 1;
  const bool stays =
      edge_ == 0 ? move_section(0, last, r_m, moved)
                 : move_edge(r_m, moved) && move_section(0, edge_, r_m, moved) && move_section(edge_, last, r_m, moved);
  if (!stays || !keep_sides(r_m, moved)) return std::nullopt;
  return moved;
}

}  // namespace wavetracer
