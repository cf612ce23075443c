// SPDX-License-Identifier: Apache-2.0
#include "gradient/moved_vertices.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "wavetracer/device/edge_ends.h"
#include "wavetracer/device/path_ends.h"

namespace wavetracer {
namespace {

using tangent::Tangent;

glm::dvec3 to_dvec(const double* v) { return {v[0], v[1], v[2]}; }

// Is the vertex at a free end of its edge? Paths with one edge alone are put there, see path_ends.h.
bool over_end(const wt_wedge& wedge, const glm::dvec3& point) {
  const double at = glm::dot(point - to_dvec(wedge.start), to_dvec(wedge.along));
  for (int end = 0; end < 2; ++end)
    if (device::wt_ends_freely(&wedge, end) && std::abs(at - device::wt_place_of_end(&wedge, end)) <= WT_AT_END_M)
      return true;
  return false;
}

// The isometry that unfolds the reflections of the vertices before `end` from `begin` on: p becomes turn p + shift.
struct Unfolding {
  glm::dmat3 turn{1.0};
  glm::dvec3 shift{0};
};
Unfolding unfolding(const device::wt_field_world& world, const device::wt_path& path, uint32_t begin, uint32_t end) {
  Unfolding out;
  for (uint32_t k = begin; k < end; ++k) {
    if (device::wt_kind(&path, k) != WT_STEP_REFLECTION) continue;
    const wt_exact_surface& plane = world.surfaces[device::wt_number(&path, k)];
    const glm::dvec3 n = to_dvec(plane.normal);
    const glm::dmat3 mirror = glm::dmat3{1.0} - 2.0 * glm::outerProduct(n, n);
    out.turn = mirror * out.turn;
    out.shift = mirror * out.shift + 2 * plane.offset * n;
  }
  return out;
}

tangent::wt_double3 with_values(const glm::dvec3& value, const tangent::wt_double3& p) {
  return {with_value(value.x, p.x), with_value(value.y, p.y), with_value(value.z, p.z)};
}

}  // namespace

uint32_t diffractions_of(const device::wt_path& path) {
  uint32_t count = 0;
  for (uint32_t k = 0; k < path.depth; ++k) count += device::wt_kind(&path, k) == WT_STEP_DIFFRACTION;
  return count;
}

glm::dvec3 MovedVertices::Anchor::velocity(size_t i) const {
  if (motion == Motion::along_edge) return along;
  glm::dvec3 out{0};
  out[static_cast<glm::length_t>(i)] = 1;
  return out;
}

// Variables are the places along edges, in their order, then the coordinates of the transmitter and the receiver.
void MovedVertices::find_anchors(const device::wt_field_world& world, const device::wt_path& path) {
  anchors_.assign(1, {.motion = Motion::end, .point = path.from});
  const uint32_t diffractions = diffractions_of(path);
  solved = diffractions <= WT_MOST_EDGES;  // fields know no more
  edges_ = 0;
  for (uint32_t k = 0; k < path.depth; ++k) {
    const uint32_t kind = device::wt_kind(&path, k);
    if (kind != WT_STEP_DIFFRACTION && kind != WT_STEP_SCATTERING) continue;
    Anchor anchor{.vertex = k, .point = device::wt_vertex(&path, k)};
    const wt_wedge* wedge = kind == WT_STEP_DIFFRACTION ? world.wedges + device::wt_number(&path, k) : nullptr;
    if (wedge && edges_ < WT_MOST_EDGES && !(diffractions == 1 && over_end(*wedge, anchor.point))) {
      anchor.motion = Motion::along_edge;
      anchor.along = to_dvec(wedge->along);
      anchor.variable = edges_++;
    }
    anchors_.push_back(anchor);
  }
  anchors_.push_back({.vertex = path.depth, .motion = Motion::end, .point = path.to});
  anchors_.front().variable = edges_;
  anchors_.back().variable = edges_ + 3;
}

// A stretch between two anchors changes with their variables alone.
MovedVertices::LengthForm MovedVertices::length_form(const device::wt_field_world& world,
                                                     const device::wt_path& path) const {
  LengthForm out;
  for (size_t i = 0; i + 1 < anchors_.size(); ++i) {
    const Anchor &a = anchors_[i], &b = anchors_[i + 1];
    const Unfolding image = unfolding(world, path, begin_after(i), b.vertex);
    const glm::dvec3 along = b.point - (image.turn * a.point + image.shift);
    const double length = glm::length(along);
    const glm::dvec3 unit = along / length;
    std::array<size_t, 6> variable;
    std::array<glm::dvec3, 6> apart;  // the part of a rate that is across the stretch
    size_t count = 0;
    const auto add = [&](size_t own, const glm::dvec3& rate) {
      const double along_it = glm::dot(unit, rate);
      if (own < edges_) out.slope[own] += along_it;
      variable[count] = own;
      apart[count++] = rate - unit * along_it;
    };
    for (size_t k = 0; k < a.variables(); ++k) add(a.variable + k, -(image.turn * a.velocity(k)));
    for (size_t k = 0; k < b.variables(); ++k) add(b.variable + k, b.velocity(k));
    for (size_t v = 0; v < count; ++v)
      for (size_t w = 0; w < count && variable[v] < edges_; ++w)
        out.rows[variable[v]][variable[w]] += glm::dot(apart[v], apart[w]) / length;
  }
  return out;
}

// By Gauss' elimination; the form of a shortest way is positive, so no pivot is 0.
MovedVertices::EdgeRates MovedVertices::edge_rates(LengthForm form, double* error_m) const {
  const auto eliminate = [&](size_t row, size_t pivot) {
    const double share = form.rows[row][pivot] / form.rows[pivot][pivot];
    for (size_t column = pivot; column < edges_ + 6; ++column)
      form.rows[row][column] -= share * form.rows[pivot][column];
    form.slope[row] -= share * form.slope[pivot];
  };
  for (size_t pivot = 0; pivot < edges_; ++pivot)
    for (size_t row = 0; row < edges_; ++row)
      if (row != pivot) eliminate(row, pivot);
  EdgeRates rates{};
  *error_m = 0;
  for (size_t edge = 0; edge < edges_; ++edge) {
    for (size_t lane = 0; lane < 6; ++lane) rates[edge][lane] = -form.rows[edge][edges_ + lane] / form.rows[edge][edge];
    const double error = std::abs(form.slope[edge] / form.rows[edge][edge]);
    if (!(error <= *error_m)) *error_m = error;
  }
  return rates;
}

tangent::wt_double3 MovedVertices::moved_point(const Anchor& anchor, const EdgeRates& rates) const {
  tangent::wt_double3 out{anchor.point.x, anchor.point.y, anchor.point.z};
  Tangent* const axes[3] = {&out.x, &out.y, &out.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (anchor.motion == Motion::end) axes[axis]->d.set(static_cast<int>(anchor.variable - edges_) + axis, 1);
    if (anchor.motion == Motion::along_edge)
      for (int lane = 0; lane < 6; ++lane)
        axes[axis]->d.set(lane, anchor.along[axis] * rates[anchor.variable][static_cast<size_t>(lane)]);
  }
  return out;
}

double MovedVertices::place_between(const device::wt_field_world& world, const device::wt_path& path, uint32_t begin,
                                    uint32_t end, const tangent::wt_double3& first, const tangent::wt_double3& last) {
  const auto plane = [&](uint32_t k) -> const wt_exact_surface& { return world.surfaces[device::wt_number(&path, k)]; };
  const auto height = [&](uint32_t k, const tangent::wt_double3& p) {
    const double* const n = plane(k).normal;
    return n[0] * p.x + n[1] * p.y + n[2] * p.z - plane(k).offset;
  };
  images_.assign(1, first);
  for (uint32_t k = begin; k < end; ++k) {
    const tangent::wt_double3 p = images_.back();
    if (device::wt_kind(&path, k) != WT_STEP_REFLECTION) {
      images_.push_back(p);
      continue;
    }
    const double* const n = plane(k).normal;
    const Tangent twice = height(k, p) * 2.0;
    images_.push_back({p.x - n[0] * twice, p.y - n[1] * twice, p.z - n[2] * twice});
  }
  double error_m = 0;
  tangent::wt_double3 target = last;
  for (uint32_t k = end; k-- > begin;) {
    const tangent::wt_double3 image = images_[k - begin + 1];
    const Tangent here = height(k, image), there = height(k, target);
    target = image + (target - image) * (here / (here - there));
    const glm::dvec3 found{target.x.value, target.y.value, target.z.value}, given = device::wt_vertex(&path, k);
    const double error = glm::length(found - given);
    if (!(error <= error_m)) error_m = error;
    vertices[k] = with_values(given, target);
  }
  return error_m;
}

void MovedVertices::set(const device::wt_field_world& world, const device::wt_path& path) {
  find_anchors(world, path);
  EdgeRates rates{};
  double error_m = 0;
  if (edges_ > 0) rates = edge_rates(length_form(world, path), &error_m);
  vertices.resize(path.depth);
  solved = solved && error_m <= most_vertex_error_m;
  from = moved_point(anchors_.front(), rates);
  tangent::wt_double3 before = from;
  for (size_t i = 0; i + 1 < anchors_.size(); ++i) {
    const Anchor& next = anchors_[i + 1];
    const tangent::wt_double3 point = moved_point(next, rates);
    if (i + 2 == anchors_.size())
      to = point;
    else
      vertices[next.vertex] = point;
    const double error = place_between(world, path, begin_after(i), next.vertex, before, point);
    solved = solved && error <= most_vertex_error_m;
    before = point;
  }
}

}  // namespace wavetracer
