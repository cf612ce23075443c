// The wave of one path, interaction by interaction.
// Spreading: 1 / L of a path of length L without edges; with edges, which are lines of sources, by stationary phase
// over the points on them: 1 / (product of the legs between ends and edges) / sqrt(det H), H the second
// derivatives of the length. It is that of K-P for one edge (sqrt(s' / (s (s + s'))) / s'), and symmetric for two.
#include "radio/interactions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "radio/constants.hpp"
#include "radio/material.hpp"
#include "radio/scattering.hpp"
#include "radio/slab.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

std::vector<std::complex<double>> permittivities(const Scene& scene, double frequency_hz) {
  std::vector<std::complex<double>> result(scene.materials.size());
  std::vector<bool> known(scene.materials.size());
  for (const Surface& surface : scene.surfaces) {
    if (known[surface.material]) continue;
    known[surface.material] = true;
    result[surface.material] = complex_permittivity(scene.materials[surface.material], frequency_hz);
  }
  return result;
}

// Directions closer than this to a boundary are worth a question about the other path there, see LitSides.
constexpr double near_boundary_rad = 2e-6;

// What runs along a face is this far inside of free space: both faces of a half plane lie in one direction.
constexpr double inside_rad = 1e-12;

bool is_half_plane(const WedgeFrame& frame) { return frame.exterior_rad > 2 * std::numbers::pi - 1e-9; }

// Of face 0 or 1, into free space.
glm::dvec3 normal_of(const WedgeFrame& frame, int face) {
  if (face == 0) return frame.normal;
  return std::sin(frame.exterior_rad) * frame.face - std::cos(frame.exterior_rad) * frame.normal;
}

}  // namespace

struct Interactions::Edge {
  uint64_t vertex;  // into the columns of the geometry
  WorldPlace place;
  WedgeFrame frame;
  glm::dvec3 k_in, k_out;
  double before_m, after_m;  // to the end or edge before and after it, reflections unfolded
  double sine2() const {     // of the angle between edge and path
    const double cosine = glm::dot(k_in, frame.along);
    return (1 - cosine) * (1 + cosine);
  }
};

Interactions::Interactions(const Scene& scene, const Config& config, std::span<const Scene> models,
                           std::span<const Instance> instances)
    : surfaces_(scene, models, instances),
      wedges_(scene, models, instances),
      seed_(config.trace.seed),
      wavelength_m_(speed_of_light_m_s / config.radio.frequency_hz),
      most_transmissions_(config.trace.transmission ? std::min(config.trace.max_transmissions, config.trace.max_depth)
                                                    : 0) {
  for (uint32_t part = 0; part < surfaces_.part_count(); ++part)
    permittivity_.push_back(permittivities(surfaces_.scene(part), config.radio.frequency_hz));
  if (config.trace.scattering) tiles_.emplace(scene, models, instances, config.trace.tile_m);
}

VertexPlace Interactions::place(const PathGeometry& geometry, uint64_t i) const {
  if (geometry.interaction[i] == diffraction) {
    const WorldPlace place = wedges_.at(geometry.surface[i]);
    return {place.index, place.instance};
  }
  const bool tile = geometry.interaction[i] == scattering;
  if (tile && !tiles_) throw RuntimeError("a path scatters from a tile, but there are none without trace.scattering");
  const uint32_t number = geometry.surface[i];
  const WorldPlace place = surfaces_.at(tile ? tiles_->surface(tiles_->at(number)) : number);
  return {place.index, place.instance};
}

WedgeFace Interactions::face_of(const WorldPlace& place, int face) const {
  const Scene& scene = surfaces_.scene(place.part);
  const uint32_t material = scene.surfaces[wedges_.wedge(place).surface[face]].material;
  return {permittivity_[place.part][material], scene.materials[material].thickness_m};
}

std::vector<Interactions::Edge> Interactions::edges_of(const PathGeometry& geometry, size_t path,
                                                       const WorldState& state, const Legs& legs) const {
  std::vector<Edge> edges;
  double since_m = legs.lengths_m().front();
  for (size_t m = 0; m + 1 < legs.directions().size(); ++m) {
    const uint64_t vertex = geometry.first[path] + m;
    if (geometry.interaction[vertex] == diffraction) {
      const WorldPlace place = wedges_.at(geometry.surface[vertex]);
      if (!edges.empty()) edges.back().after_m = since_m;
      edges.push_back(
          {vertex, place, wedges_.frame(place, state), legs.directions()[m], legs.directions()[m + 1], since_m, 0});
      since_m = 0;
    }
    since_m += legs.lengths_m()[m + 1];
  }
  if (!edges.empty()) edges.back().after_m = since_m;
  return edges;
}

// Only where the direction after the edge is that of the direct or of a reflected ray: other paths are not asked for.
LitSides Interactions::lit_sides(const PathGeometry& geometry, size_t path, const Edge& edge,
                                 const SiblingQuestion& sibling) const {
  LitSides lit;
  const auto columns = [&](auto& column) {
    return std::vector(column.begin() + static_cast<std::ptrdiff_t>(geometry.first[path]),
                       column.begin() + static_cast<std::ptrdiff_t>(geometry.first[path + 1]));
  };
  const auto at = static_cast<std::ptrdiff_t>(edge.vertex - geometry.first[path]);
  if (glm::distance(edge.k_in, edge.k_out) < near_boundary_rad) {
    auto surfaces = columns(geometry.surface);
    auto interactions = columns(geometry.interaction);
    surfaces.erase(surfaces.begin() + at);
    interactions.erase(interactions.begin() + at);
    lit.direct = sibling(surfaces, interactions);
  }
  for (int face = 0; face < 2; ++face) {
    if (glm::distance(glm::reflect(edge.k_in, normal_of(edge.frame, face)), edge.k_out) >= near_boundary_rad) continue;
    auto surfaces = columns(geometry.surface);
    auto interactions = columns(geometry.interaction);
    surfaces[at] = wedges_.face_surface(edge.place, face);
    interactions[at] = reflection;
    lit.reflected[face] = sibling(surfaces, interactions);
  }
  return lit;
}

void Interactions::diffract_at(const Edge& edge, const LitSides& lit, Transfer& transfer) const {
  const double distance_m = edge.before_m * edge.after_m / (edge.before_m + edge.after_m) * edge.sine2();
  const Diffraction wave =
      diffract(edge.frame, {face_of(edge.place, 0), face_of(edge.place, 1)}, edge.k_in, edge.k_out, distance_m,
               wavelength_m_, most_transmissions_ >= (is_half_plane(edge.frame) ? 1u : 2u), lit);
  transfer.map(wave.from, wave.to, wave.coefficient);
}

double Interactions::spreading(const std::vector<Edge>& edges, double length_m) {
  if (edges.empty()) return 1 / length_m;
  const Edge &a = edges.front(), &b = edges.back();
  const double xx = a.sine2() * (1 / a.before_m + 1 / a.after_m);
  if (edges.size() == 1) return 1 / (a.before_m * a.after_m * std::sqrt(xx));
  const double yy = b.sine2() * (1 / b.before_m + 1 / b.after_m);
  const glm::dvec3 &v = a.frame.along, &w = b.frame.along, &k = a.k_out;
  const double xy = (glm::dot(v, k) * glm::dot(w, k) - glm::dot(v, w)) / a.after_m;
  return 1 / (a.before_m * a.after_m * b.after_m * std::sqrt(xx * yy - xy * xy));
}

// The leg between two edges of one face runs along it, whatever rounding says: with the reflected wave it is one wave,
// and is counted as such at both of its ends, which is once too often. Along a sheet of two free edges one wave runs on
// each side; their signs differ at either end, so both arrive as the same. Returns the factor that makes up for it.
double Interactions::snap_to_shared_face(std::vector<Edge>& edges) const {
  if (edges.size() < 2) return 1;
  for (int i = 0; i < 4; ++i) {
    const uint32_t surface = wedges_.face_surface(edges[0].place, i / 2);
    if (surface != wedges_.face_surface(edges[1].place, i % 2)) continue;
    if (glm::dot(normal_of(edges[0].frame, i / 2), normal_of(edges[1].frame, i % 2)) < 0) continue;
    for (int end = 0; end < 2; ++end) {
      Edge& edge = edges[end];
      glm::dvec3& k = end == 0 ? edge.k_out : edge.k_in;
      const glm::dvec3 normal = normal_of(edge.frame, end == 0 ? i / 2 : i % 2);
      k = glm::normalize(k - (glm::dot(k, normal) - (end == 0 ? inside_rad : -inside_rad)) * normal);
    }
    return is_half_plane(edges[0].frame) && is_half_plane(edges[1].frame) ? 4 : 2;
  }
  return 1;
}

void Interactions::meet_surface(const PathGeometry& geometry, uint64_t vertex, const WorldState& state,
                                const glm::dvec3& k_in, const glm::dvec3& k_out, Transfer& transfer) const {
  const WorldPlace place = surfaces_.at(geometry.surface[vertex]);
  const glm::dvec3 normal = surfaces_.normal(place, state);
  const uint32_t number = surfaces_.surface(place).material;
  const Material& material = surfaces_.scene(place.part).materials[number];
  const SlabCoefficients slab =
      slab_coefficients(permittivity_[place.part][number], std::min(std::abs(glm::dot(k_in, normal)), 1.0),
                        material.thickness_m, wavelength_m_);
  const double share = tiles_ ? specular_share(material) : 1;  // what scattering leaves of the mirrored wave
  if (geometry.interaction[vertex] == transmission)
    transfer.meet(k_in, k_out, normal, slab.transmission_te, slab.transmission_tm);
  else
    transfer.meet(k_in, k_out, normal, share * slab.reflection_te, share * slab.reflection_tm);
}

void Interactions::scatter_at(const PathGeometry& geometry, uint64_t vertex, const WorldState& state,
                              const glm::dvec3& k_in, const glm::dvec3& k_out, Transfer& transfer) const {
  const TilePlace tile = tiles_->at(geometry.surface[vertex]);
  const WorldPlace place = surfaces_.at(tiles_->surface(tile));
  const uint32_t number = surfaces_.surface(place).material;
  const ScatteredWave wave =
      scatter(surfaces_.scene(place.part).materials[number], permittivity_[place.part][number], wavelength_m_, k_in,
              k_out, surfaces_.normal(place, state), tiles_->tile(tile).area_m2, seed_, geometry.surface[vertex]);
  transfer.map(wave.from, wave.to, wave.matrix);
}

Matrix2 Interactions::carried(const PathGeometry& geometry, size_t path, const WorldState& state, const Legs& legs,
                              const SphericalBasis& departure, const SphericalBasis& arrival,
                              const SiblingQuestion& sibling) const {
  const uint64_t first = geometry.first[path];
  std::vector<Edge> edges = edges_of(geometry, path, state, legs);
  double spread = spreading(edges, legs.length_m()) * snap_to_shared_face(edges);
  Transfer transfer(departure);
  size_t next_edge = 0;
  double since_m = 0;
  for (uint64_t vertex = first; vertex < geometry.first[path + 1]; ++vertex) {
    const size_t m = vertex - first;
    const glm::dvec3 &k_in = legs.directions()[m], &k_out = legs.directions()[m + 1];
    since_m += legs.lengths_m()[m];
    switch (geometry.interaction[vertex]) {
      case reflection:
      case transmission:
        meet_surface(geometry, vertex, state, k_in, k_out, transfer);
        break;
      case diffraction: {
        const Edge& edge = edges[next_edge++];
        diffract_at(edge, edges.size() == 1 ? lit_sides(geometry, path, edge, sibling) : LitSides{}, transfer);
        break;
      }
      case scattering:
        scatter_at(geometry, vertex, state, k_in, k_out, transfer);
        spread = 1 / (since_m * (legs.length_m() - since_m));
        break;
      default:
        throw RuntimeError(fmt::format("path {} has an interaction of kind {}, which fields do not know", path,
                                       geometry.interaction[vertex]));
    }
  }
  Matrix2 matrix = transfer.seen_in(arrival);
  for (std::complex<double>& element : matrix) element *= spread;
  return matrix;
}

}  // namespace wavetracer
