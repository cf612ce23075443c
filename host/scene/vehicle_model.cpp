// SPDX-License-Identifier: Apache-2.0
// A body consists of parts. A part is a side view extended over the width of the vehicle, or a view from above extended
// over some of its height: one list of corners defines all faces. Corners of a roof may be farther inside than the
// others; the window line below them is level, so that sides stay planar.
#include "scene/vehicle_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <limits>

#include "scene/build_scene.hpp"
#include "scene/materials.hpp"
#include "scene/polygon.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// A corner in shares of the body: x of its length from the centre, z of its height from the underside, y of half its
// width.
struct Corner {
  double x, z, y = 1;
};

struct Part {
  std::vector<Corner> outline;               // from the tail's lower edge over the roof to the front's lower edge
  std::vector<std::vector<uint32_t>> sides;  // planar pieces of one side, in the sense of the outline
  const char* material = "metal";
};

// A prism: a convex outline from above, counter-clockwise, in shares of half the length and width. Its corners 1, 2,
// ... are the mirror images of its corners 0, n - 1, ...
struct Column {
  std::vector<glm::dvec2> outline;
  double lower, upper;  // shares of the body's height
  const char* material = "human_skin";
};

struct Body {
  std::vector<Part> parts;
  std::vector<Column> columns = {};
  double most_clearance_m = 0.35;  // height of the underside; at most a sixth of the vehicle's height
};

const Body car{{{{{-0.5, 0},        // tail
                  {-0.5, 0.5},      // boot
                  {-0.4, 0.55},     // rear window
                  {-0.24, 1, 0.8},  // roof
                  {0.08, 1, 0.8},   // windscreen
                  {0.26, 0.55},     // bonnet
                  {0.5, 0.4},       // front
                  {0.5, 0}},
                 {{0, 1, 2, 5, 6, 7}, {2, 3, 4, 5}}}}};

const Body van{{{{{-0.5, 0}, {-0.5, 1}, {0.28, 1}, {0.42, 0.5}, {0.5, 0.4}, {0.5, 0}}, {{0, 1, 2, 3, 4, 5}}}}};

const Body truck{{{{{-0.5, 0},    // tail
                    {-0.5, 1},    // cargo box
                    {0.2, 1},     // its front
                    {0.2, 0.2},   // gap
                    {0.25, 0.2},  // back of the cab
                    {0.25, 0.85},
                    {0.45, 0.85},  // windscreen
                    {0.5, 0.45},   // front
                    {0.5, 0}},
                   {{0, 1, 2, 3, 4, 5, 6, 7, 8}}}}};

const Body bus{{{{{-0.5, 0}, {-0.5, 1}, {0.475, 1}, {0.5, 0.35}, {0.5, 0}}, {{0, 1, 2, 3, 4}}}}};

const Body tram{{{{{-0.5, 0}, {-0.5, 0.3}, {-0.45, 1}, {0.45, 1}, {0.5, 0.3}, {0.5, 0}}, {{0, 1, 2, 3, 4, 5}}}}};

// The narrow machine and the rider; a gap keeps them two closed bodies.
const Body motorcycle{
    {{{{-0.4, 0, 0.4}, {-0.5, 0.15, 0.4}, {-0.45, 0.42, 0.4}, {0.3, 0.5, 0.4}, {0.5, 0.15, 0.4}, {0.4, 0, 0.4}},
      {{0, 1, 2, 3, 4, 5}}},
     {{{-0.3, 0.52}, {-0.25, 0.8}, {-0.12, 1}, {0.05, 1}, {0.1, 0.8}, {0.15, 0.52}},
      {{0, 1, 2, 3, 4, 5}},
      "human_skin"}},
    {},
    0.03};

const std::vector<glm::dvec2> octagon{{1, -0.5}, {1, 0.5},   {0.5, 1},   {-0.5, 1},
                                      {-1, 0.5}, {-1, -0.5}, {-0.5, -1}, {0.5, -1}};
const std::vector<glm::dvec2> head_octagon{{0.7, -0.2}, {0.7, 0.2},   {0.35, 0.4},   {-0.35, 0.4},
                                           {-0.7, 0.2}, {-0.7, -0.2}, {-0.35, -0.4}, {0.35, -0.4}};
const Body pedestrian{{}, {{octagon, 0, 0.85}, {head_octagon, 0.86, 1}}, 0.03};

const Body& body_of(NamedBody kind) {
  if (kind == "car") return car;
  if (kind == "van") return van;
  if (kind == "truck") return truck;
  if (kind == "bus") return bus;
  if (kind == "tram") return tram;
  if (kind == "motorcycle") return motorcycle;
  if (kind == "pedestrian") return pedestrian;
  throw ConfigError(fmt::format(
      "there is no vehicle model '{}'; known: car, van, truck, bus, tram, motorcycle, pedestrian", kind.word()));
}

struct Frame {
  double length_m, width_m, height_m, clearance_m;
  double z_m(double share) const { return share == 1 ? height_m : clearance_m + share * (height_m - clearance_m); }
};

// Left corners come first, then right ones. The right side mirrors the triangles of the left one.
RawMesh mesh_of(const Part& part, const Frame& frame) {
  const uint32_t n = static_cast<uint32_t>(part.outline.size());
  RawMesh mesh;
  for (const double side : {0.5, -0.5})
    for (const Corner& c : part.outline)
      mesh.vertices.emplace_back(c.x * frame.length_m, side * c.y * frame.width_m, frame.z_m(c.z));
  for (const std::vector<uint32_t>& side : part.sides) triangulate_polygon(mesh.vertices, side, mesh.triangles);
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

// Lower corners come first, then upper ones.
RawMesh mesh_of(const Column& column, const Frame& frame) {
  const uint32_t n = static_cast<uint32_t>(column.outline.size());
  RawMesh mesh;
  for (const double share : {column.lower, column.upper})
    for (const glm::dvec2& c : column.outline)
      mesh.vertices.emplace_back(c.x * frame.length_m / 2, c.y * frame.width_m / 2, frame.z_m(share));
  for (uint32_t k = 0; k + 2 <= n / 2; ++k) {  // the faces below and above, in strips
    const uint32_t a = (n - k) % n, b = k + 1, c = k + 2, d = n - 1 - k;
    const uint32_t lower[] = {d, c, b, a}, upper[] = {n + a, n + b, n + c, n + d};
    triangulate_polygon(mesh.vertices, lower, mesh.triangles);
    triangulate_polygon(mesh.vertices, upper, mesh.triangles);
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t next = (i + 1) % n;
    const uint32_t quad[] = {i, next, next + n, i + n};
    triangulate_polygon(mesh.vertices, quad, mesh.triangles);
  }
  return mesh;
}

class RawBody {
 public:
  RawBody(NamedBody kind, const Frame& frame) : frame_(frame) {
    raw.file = fmt::format("vehicle model '{}'", kind.word());
    const Body& body = body_of(kind);
    for (const Part& part : body.parts) add(mesh_of(part, frame), part.material, kind);
    for (const Column& column : body.columns) add(mesh_of(column, frame), column.material, kind);
    add_nodes();
  }

  RawScene raw;

 private:
  void add(RawMesh mesh, const std::string& material, NamedBody kind) {
    const auto same = std::ranges::find(raw.materials, material, &RawMaterial::name);
    mesh.material = static_cast<uint32_t>(same - raw.materials.begin());
    if (same == raw.materials.end()) raw.materials.push_back({material, raw.file, {}, {}, {}, {}});
    mesh.name = raw.meshes.empty() ? kind.text() : fmt::format("{} {}", kind.word(), raw.meshes.size());
    mesh.where = raw.file;
    raw.meshes.push_back(std::move(mesh));
  }

  // Adds the places of antennas: above the middle of the highest part, and in front of and behind the body.
  void add_nodes() {
    constexpr double away_m = 0.05, bumper = 0.35;
    double first_m = frame_.length_m, last_m = -frame_.length_m;
    for (const RawMesh& mesh : raw.meshes)
      for (const glm::dvec3& v : mesh.vertices)
        if (v.z == frame_.height_m) first_m = std::min(first_m, v.x), last_m = std::max(last_m, v.x);
    const double bumper_m = bumper * frame_.height_m, end_m = frame_.length_m / 2 + away_m;
    raw.nodes = {{"roof_antenna", {(first_m + last_m) / 2, 0, frame_.height_m + away_m}},
                 {"front_antenna", {end_m, 0, bumper_m}},
                 {"rear_antenna", {-end_m, 0, bumper_m}}};
  }

  const Frame& frame_;
};

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
  const Frame frame{length_m, width_m, height_m, std::min(height_m / 6, body.most_clearance_m)};
  const RawScene raw = RawBody(kind, frame).raw;
  return build_scene(raw, resolve_materials(raw, scene, materials, frequency_hz));
}

}  // namespace wavetracer
