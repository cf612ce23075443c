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

enum class Motion { end, along_edge, none };

// A point of the path between which the others follow by the image method: an end, an edge or a scattering point.
struct Anchor {
  uint32_t vertex = 0;  // the number of its vertex; for the transmitter one before the first, see stretches
  Motion motion = Motion::none;
  glm::dvec3 point{0}, along{0};  // along: the unit vector of an edge
  size_t variable = 0;            // the first of its variables: one of an edge, three of an end
};

glm::dvec3 to_dvec(const double* v) { return {v[0], v[1], v[2]}; }

// Is the vertex at a free end of its edge? Paths with one edge alone are put there, see path_ends.h.
bool over_end(const wt_wedge& wedge, const glm::dvec3& point) {
  const double at = glm::dot(point - to_dvec(wedge.start), to_dvec(wedge.along));
  for (int end = 0; end < 2; ++end)
    if (device::wt_ends_freely(&wedge, end) && std::abs(at - device::wt_place_of_end(&wedge, end)) <= WT_AT_END_M)
      return true;
  return false;
}

// Variables are the places along edges, in their order, then the coordinates of the transmitter and the receiver.
std::vector<Anchor> anchors_of(const device::wt_field_world& world, const device::wt_path& path, size_t& edges) {
  std::vector<Anchor> anchors{{.motion = Motion::end, .point = path.from}};
  uint32_t diffractions = 0;
  for (uint32_t k = 0; k < path.depth; ++k) diffractions += device::wt_kind(&path, k) == WT_STEP_DIFFRACTION;
  edges = 0;
  for (uint32_t k = 0; k < path.depth; ++k) {
    const uint32_t kind = device::wt_kind(&path, k);
    if (kind != WT_STEP_DIFFRACTION && kind != WT_STEP_SCATTERING) continue;
    Anchor anchor{.vertex = k, .point = device::wt_vertex(&path, k)};
    const wt_wedge* wedge = kind == WT_STEP_DIFFRACTION ? world.wedges + device::wt_number(&path, k) : nullptr;
    if (wedge && !(diffractions == 1 && over_end(*wedge, anchor.point))) {
      anchor.motion = Motion::along_edge;
      anchor.along = to_dvec(wedge->along);
      anchor.variable = edges++;
    }
    anchors.push_back(anchor);
  }
  anchors.push_back({.vertex = path.depth, .motion = Motion::end, .point = path.to});
  anchors.front().variable = edges;
  anchors.back().variable = edges + 3;
  return anchors;
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

uint32_t begin_after(const std::vector<Anchor>& anchors, size_t i) { return i == 0 ? 0 : anchors[i].vertex + 1; }

// The velocity of an anchor as one of its variables grows.
glm::dvec3 velocity(const Anchor& anchor, size_t variable) {
  if (anchor.motion == Motion::along_edge && variable == anchor.variable) return anchor.along;
  glm::dvec3 out{0};
  if (anchor.motion == Motion::end && variable >= anchor.variable && variable < anchor.variable + 3)
    out[static_cast<glm::length_t>(variable - anchor.variable)] = 1;
  return out;
}

// First and second derivatives of the path's length by the variables.
struct LengthForm {
  size_t count;
  std::vector<double> slope, form;
  explicit LengthForm(size_t variables) : count(variables), slope(variables), form(variables * variables) {}
  double& at(size_t i, size_t j) { return form[i * count + j]; }
};

LengthForm length_form(const device::wt_field_world& world, const device::wt_path& path,
                       const std::vector<Anchor>& anchors, size_t variables) {
  LengthForm out(variables);
  std::vector<glm::dvec3> apart(variables);
  for (size_t i = 0; i + 1 < anchors.size(); ++i) {
    const Anchor &a = anchors[i], &b = anchors[i + 1];
    const Unfolding image = unfolding(world, path, begin_after(anchors, i), b.vertex);
    const glm::dvec3 along = b.point - (image.turn * a.point + image.shift);
    const double length = glm::length(along);
    const glm::dvec3 unit = along / length;
    for (size_t v = 0; v < variables; ++v) {
      const glm::dvec3 rate = velocity(b, v) - image.turn * velocity(a, v);
      out.slope[v] += glm::dot(unit, rate);
      apart[v] = rate - unit * glm::dot(unit, rate);
    }
    for (size_t v = 0; v < variables; ++v)
      for (size_t w = 0; w < variables; ++w) out.at(v, w) += glm::dot(apart[v], apart[w]) / length;
  }
  return out;
}

// Returns how the place along each edge changes with the six coordinates of the ends, edge by edge. By Gauss'
// elimination; the form of a shortest way is positive, so no pivot is 0. *error_m: how far the places are from those of
// the shortest way.
std::vector<double> edge_rates(LengthForm form, size_t edges, double* error_m) {
  const auto eliminate = [&](size_t row, size_t pivot) {
    const double share = form.at(row, pivot) / form.at(pivot, pivot);
    for (size_t column = pivot; column < form.count; ++column) form.at(row, column) -= share * form.at(pivot, column);
    form.slope[row] -= share * form.slope[pivot];
  };
  for (size_t pivot = 0; pivot < edges; ++pivot)
    for (size_t row = 0; row < edges; ++row)
      if (row != pivot) eliminate(row, pivot);
  std::vector<double> rates;
  *error_m = 0;
  for (size_t edge = 0; edge < edges; ++edge) {
    for (size_t lane = 0; lane < 6; ++lane) rates.push_back(-form.at(edge, edges + lane) / form.at(edge, edge));
    const double error = std::abs(form.slope[edge] / form.at(edge, edge));
    if (!(error <= *error_m)) *error_m = error;
  }
  return rates;
}

tangent::wt_double3 with_values(const glm::dvec3& value, const tangent::wt_double3& p) {
  return {with_value(value.x, p.x), with_value(value.y, p.y), with_value(value.z, p.z)};
}

tangent::wt_double3 moved_point(const Anchor& anchor, size_t edges, const std::vector<double>& rates) {
  tangent::wt_double3 out{anchor.point.x, anchor.point.y, anchor.point.z};
  Tangent* const axes[3] = {&out.x, &out.y, &out.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (anchor.motion == Motion::end) axes[axis]->d[anchor.variable - edges + static_cast<size_t>(axis)] = 1;
    if (anchor.motion == Motion::along_edge)
      for (size_t lane = 0; lane < 6; ++lane)
        axes[axis]->d[lane] = anchor.along[axis] * rates[6 * anchor.variable + lane];
  }
  return out;
}

// Puts the vertices from `begin` to end - 1 between two points by the image method. Returns how far they are from those
// of the path.
double place_between(const device::wt_field_world& world, const device::wt_path& path, uint32_t begin, uint32_t end,
                     const tangent::wt_double3& from, const tangent::wt_double3& to,
                     std::vector<tangent::wt_double3>& vertices) {
  const auto plane = [&](uint32_t k) -> const wt_exact_surface& { return world.surfaces[device::wt_number(&path, k)]; };
  const auto height = [&](uint32_t k, const tangent::wt_double3& p) {
    return tangent::wt_dot3(tangent::wt_vector(plane(k).normal), p) - plane(k).offset;
  };
  std::vector<tangent::wt_double3> images{from};
  for (uint32_t k = begin; k < end; ++k) {
    const tangent::wt_double3 p = images.back();
    const bool mirrors = device::wt_kind(&path, k) == WT_STEP_REFLECTION;
    images.push_back(mirrors ? p - tangent::wt_vector(plane(k).normal) * (height(k, p) * 2.0) : p);
  }
  double error_m = 0;
  tangent::wt_double3 target = to;
  for (uint32_t k = end; k-- > begin;) {
    const tangent::wt_double3 image = images[k - begin + 1];
    const Tangent here = height(k, image), there = height(k, target);
    target = image + (target - image) * (here / (here - there));
    const glm::dvec3 solved{target.x.value, target.y.value, target.z.value}, given = device::wt_vertex(&path, k);
    const double error = glm::length(solved - given);
    if (!(error <= error_m)) error_m = error;
    vertices[k] = with_values(given, target);
  }
  return error_m;
}

}  // namespace

MovedVertices moved_vertices(const device::wt_field_world& world, const device::wt_path& path) {
  size_t edges = 0;
  const std::vector<Anchor> anchors = anchors_of(world, path, edges);
  double error_m = 0;
  const std::vector<double> rates = edge_rates(length_form(world, path, anchors, edges + 6), edges, &error_m);
  MovedVertices out;
  out.vertices.resize(path.depth);
  out.solved = error_m <= most_vertex_error_m;
  for (size_t i = 0; i + 1 < anchors.size(); ++i) {
    const tangent::wt_double3 from = moved_point(anchors[i], edges, rates);
    const tangent::wt_double3 to = moved_point(anchors[i + 1], edges, rates);
    if (i == 0) out.from = from;
    if (i + 2 == anchors.size())
      out.to = to;
    else
      out.vertices[anchors[i + 1].vertex] = to;
    const double error =
        place_between(world, path, begin_after(anchors, i), anchors[i + 1].vertex, from, to, out.vertices);
    out.solved = out.solved && error <= most_vertex_error_m;
  }
  return out;
}

}  // namespace wavetracer
