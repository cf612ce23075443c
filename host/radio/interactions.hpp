// What a path does to its wave: every interaction as a matrix between transverse fields, and the spreading of its legs.
// Assumes geometry of host/simulation: specular reflections, straight transmissions, one diffuse scattering or up to
// two diffractions that are not at one wedge.
#pragma once
#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "radio/legs.hpp"
#include "radio/spherical.hpp"
#include "radio/surface_table.hpp"
#include "radio/transfer.hpp"
#include "radio/wedge_table.hpp"
#include "scene/tiles.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Where an interaction happens: the number of its surface or wedge in its own scene or model; of a tile, that of its
// surface.
struct VertexPlace {
  uint32_t number, instance;  // no_instance: static
};

// Is there a path of the same link with these interactions (numbers and kinds)? Asked where a receiver stands on a
// shadow boundary.
using SiblingQuestion = std::function<bool(std::span<const uint32_t> surfaces, std::span<const uint8_t> interactions)>;

// Keeps references to the scene, the models and the instances.
class Interactions {
 public:
  // Throws ConfigError for a material that some surface uses and that is not known at radio.frequency_hz.
  Interactions(const Scene& scene, const Config& config, std::span<const Scene> models,
               std::span<const Instance> instances);

  const SurfaceTable& surfaces() const { return surfaces_; }
  // Of entry i of the columns of the geometry.
  VertexPlace place(const PathGeometry& geometry, uint64_t i) const;
  double wavelength_m() const { return wavelength_m_; }

  // The field that arrives, in components of the arrival basis, per field that leaves at 1 m, in those of the departure
  // basis, without the phase of the path's length (1 / m). Throws RuntimeError for an interaction of no known kind.
  Matrix2 carried(const PathGeometry& geometry, size_t path, const WorldState& state, const Legs& legs,
                  const SphericalBasis& departure, const SphericalBasis& arrival, const SiblingQuestion& sibling) const;

 private:
  struct Edge;  // a diffraction of the path
  std::vector<Edge> edges_of(const PathGeometry& geometry, size_t path, const WorldState& state,
                             const Legs& legs) const;
  static double spreading(const std::vector<Edge>& edges, double length_m);
  double snap_to_shared_face(std::vector<Edge>& edges) const;
  WedgeFace face_of(const WorldPlace& place, int face) const;
  LitSides lit_sides(const PathGeometry& geometry, size_t path, const Edge& edge, const SiblingQuestion& sibling) const;
  // What the interaction at this entry of the columns does.
  void meet_surface(const PathGeometry& geometry, uint64_t vertex, const WorldState& state, const glm::dvec3& k_in,
                    const glm::dvec3& k_out, Transfer& transfer) const;
  void scatter_at(const PathGeometry& geometry, uint64_t vertex, const WorldState& state, const glm::dvec3& k_in,
                  const glm::dvec3& k_out, Transfer& transfer) const;
  void diffract_at(const Edge& edge, const LitSides& lit, Transfer& transfer) const;

  SurfaceTable surfaces_;
  WedgeTable wedges_;
  std::optional<TileTable> tiles_;  // with trace.scattering
  uint64_t seed_;
  double wavelength_m_;
  uint32_t most_transmissions_;  // 0: waves do not pass surfaces
  // By part of the surface table, then by material; 0 where no surface uses it.
  std::vector<std::vector<std::complex<double>>> permittivity_;
};

}  // namespace wavetracer
