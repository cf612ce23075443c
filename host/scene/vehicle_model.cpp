// A body is a side view drawn over the width of the vehicle: one list of corners a kind, from which all faces follow.
// Corners of the roof may stand inwards of the others; the window line below them is level, so that sides stay planar.
#include "scene/vehicle_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/build_scene.hpp"
#include "scene/materials.hpp"
#include "scene/polygon.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// In shares of the body: x of its length from the centre, z of its height from the underside, y of half its width.
struct Corner {
  double x, z, y = 1;
};

struct Body {
  std::vector<Corner> outline;               // from the tail's lower edge over the roof to the front's lower edge
  std::vector<std::vector<uint32_t>> sides;  // planar parts of one side, in the sense of the outline
};

const Body car{{{-0.5, 0},        // tail
                {-0.5, 0.5},      // boot
                {-0.4, 0.55},     // rear window
                {-0.24, 1, 0.8},  // roof
                {0.08, 1, 0.8},   // windscreen
                {0.26, 0.55},     // bonnet
                {0.5, 0.4},       // front
                {0.5, 0}},
               {{0, 1, 2, 5, 6, 7}, {2, 3, 4, 5}}};

const Body van{{{-0.5, 0}, {-0.5, 1}, {0.28, 1}, {0.42, 0.5}, {0.5, 0.4}, {0.5, 0}}, {{0, 1, 2, 3, 4, 5}}};

const Body truck{{{-0.5, 0},    // tail
                  {-0.5, 1},    // cargo box
                  {0.2, 1},     // its front
                  {0.2, 0.2},   // gap
                  {0.25, 0.2},  // back of the cab
                  {0.25, 0.85},
                  {0.45, 0.85},  // windscreen
                  {0.5, 0.45},   // front
                  {0.5, 0}},
                 {{0, 1, 2, 3, 4, 5, 6, 7, 8}}};

const Body& body_of(NamedBody kind) {
  if (kind == "car") return car;
  if (kind == "van") return van;
  if (kind == "truck") return truck;
  throw ConfigError(fmt::format("there is no vehicle model '{}'; known: car, van, truck", kind.word()));
}

// Left corners first, then right ones. The right side mirrors the triangles of the left one.
RawMesh mesh_of(const Body& body, double length_m, double width_m, double height_m) {
  const double clearance_m = std::min(height_m / 6, 0.35);
  const uint32_t n = static_cast<uint32_t>(body.outline.size());
  RawMesh mesh;
  for (const double side : {0.5, -0.5}) {
    for (const Corner& c : body.outline) {
      const double z_m = c.z == 1 ? height_m : clearance_m + c.z * (height_m - clearance_m);
      mesh.vertices.emplace_back(c.x * length_m, side * c.y * width_m, z_m);
    }
  }
  for (const std::vector<uint32_t>& side : body.sides) triangulate_polygon(mesh.vertices, side, mesh.triangles);
  for (size_t i = 0, left = mesh.triangles.size(); i < left; ++i) {
    const Triangle t = mesh.triangles[i];
    mesh.triangles.push_back({t[2] + n, t[1] + n, t[0] + n});
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t next = (i + 1) % n;
    const uint32_t quad[] = {next, i, i + n, next + n};
    triangulate_polygon(mesh.vertices, quad, mesh.triangles);
  }
  return mesh;
}

}  // namespace

Scene vehicle_model(NamedBody kind, double length_m, double width_m, double height_m, const SceneConfig& scene,
                    const std::vector<MaterialConfig>& materials, double frequency_hz) {
  const Body& body = body_of(kind);
  for (const double size_m : {length_m, width_m, height_m}) {
    if (size_m > 0 && size_m < std::numeric_limits<double>::infinity()) continue;
    throw ConfigError(
        fmt::format("vehicle model '{}': {} m is not a valid size; length, width and height must be positive",
                    kind.word(), size_m));
  }
  RawScene raw;
  raw.file = fmt::format("vehicle model '{}'", kind.word());
  raw.materials.push_back({"metal", raw.file, {}, {}, {}, {}});
  RawMesh mesh = mesh_of(body, length_m, width_m, height_m);
  mesh.name = kind.text();
  mesh.where = raw.file;
  mesh.material = 0;
  raw.meshes.push_back(std::move(mesh));
  return build_scene(raw, resolve_materials(raw, scene, materials, frequency_hz));
}

}  // namespace wavetracer
