// SPDX-License-Identifier: Apache-2.0
// Converts coordinates of city models to those of the scene.
// All coordinates of a model must be of one system.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "imports/model_import.hpp"
#include "imports/projecting.hpp"
#include "imports/source_system.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

template <class Visit>
void each_ring(CityModel& model, const Visit& visit) {
  for (ModelObject& object : model.objects)
    for (auto& [lod, faces] : object.faces)
      for (ModelFace& face : faces)
        for (SpaceRing& ring : face.rings) visit(face, ring);
}

template <class Visit>
void each_corner(CityModel& model, const Visit& visit) {
  each_ring(model, [&](const ModelFace&, SpaceRing& ring) {
    for (glm::dvec3& p : ring) visit(p);
  });
}

// Returns a positive number if most surfaces look the right way in the coordinates of the file: roofs up, or, if no
// surface is marked as a roof, surfaces of solids outward. Returns 0 if that cannot be told.
double look_up(CityModel& model) {
  double roofs = 0, all_roofs = 0, solids = 0, all_solids = 0;
  for (ModelObject& object : model.objects) {
    const glm::dvec3* from = nullptr;
    for (const auto& [lod, faces] : object.faces)
      for (const ModelFace& face : faces) {
        if (face.rings.empty() || face.rings[0].empty()) continue;
        const SpaceRing& ring = face.rings[0];
        if (!from) from = &ring[0];
        glm::dvec3 area(0);
        for (size_t i = 1; i + 1 < ring.size(); ++i) area += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
        const double cone = glm::dot(ring[0] - *from, area);
        solids += cone, all_solids += std::abs(cone);
        if (face.role == Role::roof) roofs += area.z, all_roofs += std::abs(area.z);
      }
  }
  constexpr double clear = 0.5;
  if (std::abs(roofs) > clear * all_roofs) return roofs;
  return all_roofs == 0 && std::abs(solids) > 0.05 * all_solids ? solids : 0;
}

// Coordinates without a system are kept, unless they look like degrees, which would make a city of a metre.
PlacedModel place_nowhere(CityModel& model, const Extent& extent, const std::string& name,
                          const ImportOptions& options) {
  constexpr double a_town_deg = 0.5, a_storey_m = 2;
  const glm::dvec2 size = extent.upper_m - extent.lower_m;
  double lowest = INFINITY, highest = -INFINITY;
  each_corner(model, [&](const glm::dvec3& p) {
    lowest = std::min(lowest, p.z);
    highest = std::max(highest, p.z);
  });
  if (size.x < a_town_deg && size.y < a_town_deg && highest - lowest > a_storey_m)
    throw InputError(
        fmt::format("{}: does not name its coordinate system, and its coordinates seem to be degrees: name it, "
                    "in CityJSON as metadata/referenceSystem, in CityGML as srsName of gml:Envelope",
                    name));
  if (!options.net.empty())
    throw InputError(
        fmt::format("{}: does not name its coordinate system, so it cannot be placed on the network of --net", name));
  if (options.projection.empty())
    model.warnings.push_back(
        fmt::format("{}: does not name its coordinate system: its coordinates are taken as metres, "
                    "and the scene has no georeference; --projection names one",
                    name));
  return {{options.projection, {0, 0}, {}, {}}, {}, false};
}

}  // namespace

PlacedModel place_model(CityModel& model, const std::string& name, const ImportOptions& options) {
  Extent extent;
  each_corner(model, [&](const glm::dvec3& p) { extent.add({p.x, p.y}); });
  if (extent.empty()) return {};
  if (model.system.empty()) return place_nowhere(model, extent, name, options);
  SourceSystem system(model.system, name);
  system.choose_order((extent.lower_m + extent.upper_m) / 2.0, look_up(model));
  if (system.swapped())
    model.warnings.push_back(
        fmt::format("{}: its first two coordinates are taken in the other order than that of '{}', "
                    "since otherwise the model would lie elsewhere or be mirrored",
                    name, printable(model.system)));
  Extent degrees;
  const double metres_per_height = system.metres_per_height();
  each_corner(model, [&](glm::dvec3& p) {
    const glm::dvec2 place = system.geographic({p.x, p.y});
    degrees.add(place);
    p = {place, p.z * metres_per_height};
  });
  PlacedModel out;
  out.above_ellipsoid = system.above_ellipsoid();
  out.georeference =
      scene_projection(degrees, name, options, "citygml-tools subset, or cjio CITY subset --bbox ...", out.network);
  const Projection projection(out.georeference);
  each_corner(model, [&](glm::dvec3& p) { p = {projection.scene({p.x, p.y}), p.z}; });
  return out;
}

}  // namespace wavetracer::imports
