// SPDX-License-Identifier: Apache-2.0
// Places have odd digits, so that no ray meets an edge and no two paths are equally long.
#include "simulation/check_world.hpp"

#include "scene/build_scene.hpp"
#include "scene/volumes.hpp"

namespace wavetracer {
namespace {

using Quad = std::array<glm::dvec3, 4>;  // counter-clockwise seen from outside

void add_mesh(RawScene& scene, const std::string& name, const std::vector<Quad>& quads, uint32_t material) {
  RawMesh& mesh = scene.meshes.emplace_back();
  mesh.name = name;
  mesh.material = material;
  for (const Quad& quad : quads) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), quad.begin(), quad.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
}

// The walls and the roof over a convex ground plan, counter-clockwise seen from above.
std::vector<Quad> house(const std::array<glm::dvec2, 4>& plan, double height_m) {
  std::vector<Quad> out;
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec2 a = plan[i], b = plan[(i + 1) % 4];
    out.push_back({glm::dvec3(a, 0), glm::dvec3(b, 0), glm::dvec3(b, height_m), glm::dvec3(a, height_m)});
  }
  out.push_back({glm::dvec3(plan[0], height_m), glm::dvec3(plan[1], height_m), glm::dvec3(plan[2], height_m),
                 glm::dvec3(plan[3], height_m)});
  return out;
}

RadioEnd check_end(const char* name, const std::array<double, 3>& position_m, Polarization polarization) {
  RadioEnd out;
  out.name = name;
  out.position_m = position_m;
  out.polarization = polarization;
  return out;
}

MaterialConfig check_material(const char* name, double permittivity, double conductivity_s_m, double thickness_m) {
  MaterialConfig out;
  out.name = name;
  out.permittivity = permittivity;
  out.conductivity_s_m = conductivity_s_m;
  out.thickness_m = thickness_m;
  return out;
}

void add_vehicles(Config& config) {
  for (const char* type : {"passenger", "truck"}) {
    const bool car = std::string_view(type) == "passenger";
    VehicleTypeConfig& row = config.vehicle_types.emplace_back();
    row.name = type;
    row.model = car ? "car" : "truck";
    row.length_m = car ? 4.5 : 7.25;
    row.width_m = car ? 1.75 : 2.5;
    row.height_m = car ? 1.5 : 3.25;
    row.material = "check metal";
    TrackConfig& track = config.tracks.emplace_back();
    track.id = type;
    track.type = type;
    const double x = car ? -4.125 : 9.375, y = car ? -12.625 : -17.25;
    track.waypoints = {{0, x, y, 0}, {1, x + 8, y, 0}};
  }
  config.time.step_s = 0.5;
}

// A point, and a lorry that stands: waves of tx0 bounce between the roof of its cab and its box. They are not turned,
// so no angle has a sine.
void add_targets(Config& config) {
  TargetModelConfig point, body;
  point.name = "check point";
  point.rcs_dbsm = {12};
  point.points_m = {{0, 0, 1.25}};
  body.name = "check body";
  body.kind = "body";
  body.piece_m = 1.5;
  body.bounces = 2;
  config.target_models = {point, body};
  VehicleTypeConfig& row = config.vehicle_types.emplace_back();
  row.name = "truck";
  row.model = "truck";
  row.length_m = 7.25;
  row.width_m = 2.5;
  row.height_m = 3.25;
  row.material = "check metal";
  config.targets = {
      {.name = "point", .model = "check point", .position_m = {9.625, -11.375, 0}, .velocity_m_s = {1.5, -2, 0}},
      {.name = "body", .model = "check body", .position_m = {-28.375, -4.125, 0}, .vehicle_type = "truck"}};
}

void add_vegetation(Config& config) {
  MaterialConfig& leaves = config.materials.emplace_back();
  leaves.name = "check leaves";
  leaves.vegetation = "mixed";
  leaves.attenuation_db_m = 0.5;
  leaves.max_attenuation_db = 30;
  leaves.scattering = 0.5;
  config.vegetation = {
      {.shape = "box", .centre_m = {9.5, -13.25, 4.125}, .size_m = {5.5, 6.25, 7.75}, .material = "check leaves"},
      {.shape = "spheroid", .centre_m = {-3.25, 2.5, 5.5}, .size_m = {6.25, 4.5, 5.25}, .material = "check leaves"}};
}

// The keys of ways that have a frame of their own. Floors leave out some of their paths, so that they are checked, too.
void add_ways(Config& config, CheckedWays ways) {
  TraceConfig& trace = config.trace;
  trace.max_depth = 2;
  switch (ways) {
    case CheckedWays::none:
      break;
    case CheckedWays::tile_edges:
      trace.scattering_diffraction = true;
      [[fallthrough]];
    case CheckedWays::tiles:
      trace.scattering_reflections = 1;
      trace.scattering_floor_db = -130;
      break;
    case CheckedWays::target_edges:
      trace.target_diffraction = true;
      [[fallthrough]];
    case CheckedWays::targets:
      trace.target_reflections = 1;
      trace.target_floor_db = -130;
      add_targets(config);
      break;
    case CheckedWays::heard_edges:
      trace.edge_rays = 3000;
      break;
    case CheckedWays::vegetation:
      add_vegetation(config);
      break;
  }
}

}  // namespace

Config check_config(const CheckedFeatures& features) {
  Config config;
  config.materials = {check_material("check wall", 5.25, 0.125, 0.1875),
                      check_material("check glass", 6.25, 0.0625, 0.0078125),
                      check_material("check metal", 1, 1e7, 0.1)};
  config.materials[0].scattering = 0.375;
  config.transmitters = {check_end("tx0", {-20.3, -3.7, 5.1}, "VH"), check_end("tx1", {2.9, -21.6, 3.3}, "V")};
  config.receivers = {check_end("rx0", {18.4, -6.2, 1.5}, "VH"), check_end("rx1", {-1.1, 17.9, 2.2}, "H"),
                      check_end("rx2", {1.7, -4.3, 1.9}, "V")};
  config.receivers[2].velocity_m_s = {3, -14, 0.5};
  if (features.instances) add_vehicles(config);
  TraceConfig& trace = config.trace;
  // Half as many rays find the same paths, and five times as many find no others: the result must not depend on the
  // direction of a single ray. With longer paths over edges and through walls it would.
  trace.rays = 40000;
  trace.max_depth = features.diffractions > 0 || features.transmission ? 2 : 5;
  trace.diffraction = features.diffractions > 0;
  trace.max_diffractions = features.diffractions > 2 ? 8 : std::max(features.diffractions, 1u);
  trace.diffraction_rays = 20000;
  trace.transmission = features.transmission;
  trace.scattering = features.scattering;
  trace.tile_m = 8;
  trace.reuse = features.reuse;
  if (features.ways != CheckedWays::none) add_ways(config, features.ways);
  if (features.beams) trace.discovery = "beams";
  config.output.paths = !features.sums;  // so weak paths over edges are left out of sums
  if (features.ordered) {
    config.order.method = "hilbert3d-histogram";
    config.order.each_depth = true;
  }
  config.cache = features.cache;
  config.cache.key = "exact";
  config.cache.buffer_size = 1u << 19;  // in a small one rays may take all places from each other
  return config;
}

Scene check_scene(const Config& config) {
  RawScene raw;
  for (const MaterialConfig& material : config.materials) raw.materials.emplace_back().name = material.name;
  add_mesh(raw, "ground", {{{{-32, -32, 0}, {32, -32, 0}, {32, 32, 0}, {-32, 32, 0}}}}, 2);
  add_mesh(raw, "house", house({{{5, 6}, {17, 6}, {17, 20}, {5, 20}}}, 9.5), 0);
  // It is turned by an angle of a triangle of 3, 4 and 5.
  add_mesh(raw, "turned house", house({{{-16, 5}, {-8, 11}, {-14, 19}, {-22, 13}}}, 7.25), 1);
  add_mesh(raw, "screen", {{{{-9, -8.5, 0}, {-1, -8.5, 0}, {-1, -8.5, 3.5}, {-9, -8.5, 3.5}}}}, 1);
  // It faces the house, so that waves go back and forth between the two.
  add_mesh(raw, "wall", {{{{-4.5, 7, 0}, {-4.5, 19, 0}, {-4.5, 19, 6}, {-4.5, 7, 6}}}}, 2);
  add_volumes(raw, config.vegetation);
  ResolvedMaterials resolved = resolve_materials(raw, config.scene, config.materials, config.radio.frequency_hz);
  return build_scene(raw, std::move(resolved), config.trace.diffraction ? EdgeSearch::of_scene : EdgeSearch::none);
}

WorldState check_state(const World& world) {
  WorldState out = world.state(0);
  // The columns are the directions of the axes of a vehicle.
  constexpr glm::dmat3 left(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1), right(0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1);
  for (size_t i = 0; i < out.instances.size(); ++i) {
    out.instances[i].rotation = i == 0 ? left : right;
    out.instances[i].velocity_m_s = i == 0 ? glm::dvec3(6.5, 4.875, 0) : glm::dvec3(4.5, -6, 0);
    out.instances[i].angular_velocity_rad_s = {0, 0, 0.25};
  }
  return out;
}

}  // namespace wavetracer
