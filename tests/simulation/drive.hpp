// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of moving worlds: vehicles on straight ways, a street for them, the same vehicles baked into a
// scene file, and paths of two frames matched with each other.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "scene/vehicle_model.hpp"
#include "simulation/run.hpp"

namespace wavetracer::test {

constexpr uint32_t no_row = 0xFFFFFFFFu;
constexpr double carrier_hz = 5.9e9;

// Returns for each row of `paths` its row in `among`: with the same transmitter, receiver and depth, delays equal to
// 1e-12 of themselves, and points to a micrometre; no_row if there is none.
inline std::vector<uint32_t> counterparts(const Paths& paths, const Paths& among) {
  std::vector<uint32_t> out(paths.size(), no_row);
  const auto link = [](const Paths& p, size_t i) { return std::pair{p.tx[i], p.rx[i]}; };
  for (size_t i = 0; i < paths.size(); ++i) {
    // Rows are sorted by link, then delay.
    size_t low = 0, high = among.size();
    const double tolerance_s = 1e-12 * paths.delay_s[i];
    while (low < high) {
      const size_t middle = (low + high) / 2;
      if (std::pair{link(among, middle), among.delay_s[middle]} <
          std::pair{link(paths, i), paths.delay_s[i] - tolerance_s})
        low = middle + 1;
      else
        high = middle;
    }
    for (size_t j = low; j < among.size() && link(among, j) == link(paths, i); ++j) {
      if (among.delay_s[j] > paths.delay_s[i] + tolerance_s) break;
      if (among.depth[j] != paths.depth[i]) continue;
      double apart_m = 0;
      for (size_t k = 0; k < paths.depth[i]; ++k)
        apart_m = std::max(apart_m, glm::distance(paths.vertex_position_m[paths.vertex_offset[i] + k],
                                                  among.vertex_position_m[among.vertex_offset[j] + k]));
      if (apart_m < 1e-6) out[i] = static_cast<uint32_t>(j);
    }
  }
  return out;
}

// Paths that are not among others.
inline size_t missing(const Paths& paths, const Paths& among) {
  const std::vector<uint32_t> found = counterparts(paths, among);
  return static_cast<size_t>(std::count(found.begin(), found.end(), no_row));
}

// Is row i reflected by a vehicle?
inline bool by_vehicle(const Paths& paths, size_t i) {
  const uint32_t* first = paths.vertex_instance.data() + paths.vertex_offset[i];
  return std::any_of(first, first + paths.depth[i], [](uint32_t instance) { return instance != no_instance; });
}

inline size_t paths_by_vehicles(const Paths& paths) {
  size_t count = 0;
  for (size_t i = 0; i < paths.size(); ++i) count += by_vehicle(paths, i);
  return count;
}

// A vehicle that goes straight on at constant velocity from start_s to end_s; position_m is that of time 0.
struct Straight {
  std::string id, type;
  glm::dvec3 position_m, velocity_m_s;
  double start_s, end_s;

  glm::dvec3 at(double time_s) const { return position_m + time_s * velocity_m_s; }
  TrackConfig track() const {
    TrackConfig out{id, type, {}};
    for (const double t : {start_s, end_s}) out.waypoints.push_back({t, at(t).x, at(t).y, at(t).z});
    return out;
  }
};

// Sizes of the types "passenger" and "truck", in the tests.
struct Size {
  double length_m, width_m, height_m;
};
constexpr Size car_size{4.8, 1.8, 1.5}, truck_size{9, 2.5, 3.5};

inline std::vector<VehicleTypeConfig> vehicle_types() {
  return {{"passenger", "car", car_size.length_m, car_size.width_m, car_size.height_m},
          {"truck", "truck", truck_size.length_m, truck_size.width_m, truck_size.height_m}};
}

inline void add_vehicles(Config& config, const std::vector<Straight>& vehicles, double step_s) {
  config.vehicle_types = vehicle_types();
  for (const Straight& vehicle : vehicles) config.tracks.push_back(vehicle.track());
  config.time.step_s = step_s;
}

struct Mesh {
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::string material;
};

inline Mesh mesh_of(const Part& part) {
  Mesh mesh{{}, {}, part.material};
  for (const Quad& q : part.quads) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {q.corner, q.corner + q.u, q.corner + q.u + q.v, q.corner + q.v});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

// The vehicle's body where it is at a time: x ahead is turned into the direction of its velocity.
inline Mesh mesh_of(const Straight& vehicle, double time_s) {
  const bool truck = vehicle.type == "truck";
  const Size size = truck ? truck_size : car_size;
  const Scene model =
      vehicle_model(truck ? NamedBody("truck") : NamedBody("car"), size.length_m, size.width_m, size.height_m);
  const glm::dvec3 ahead = glm::normalize(vehicle.velocity_m_s), up{0, 0, 1};
  const glm::dmat3 axes(ahead, glm::cross(up, ahead), up);
  Mesh mesh{{}, model.triangles, "metal"};
  for (const glm::dvec3& vertex : model.vertices)
    mesh.vertices.push_back(vehicle.at(time_s) + axes * (model.origin_m + vertex));
  return mesh;
}

// A Mitsuba scene in a folder of its own, doubles to the last bit.
class MeshFile {
 public:
  explicit MeshFile(const std::vector<Mesh>& meshes) {
    std::string xml = "<scene version=\"2.1.0\">\n";
    for (size_t i = 0; i < meshes.size(); ++i) {
      folder_.write(fmt::format("mesh_{}.ply", i), ply(meshes[i]));
      xml += fmt::format(
          "<bsdf type=\"itu-radio-material\" id=\"material-{0}\"><string name=\"type\" value=\"{1}\"/></bsdf>\n"
          "<shape type=\"ply\" id=\"mesh-{0}\"><string name=\"filename\" value=\"mesh_{0}.ply\"/>"
          "<ref id=\"material-{0}\" name=\"bsdf\"/></shape>\n",
          i, meshes[i].material);
    }
    path_ = folder_.write("scene.xml", xml + "</scene>\n");
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path path_;

  static std::string ply(const Mesh& mesh) {
    std::string out = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.size(), mesh.triangles.size());
    for (const glm::dvec3& p : mesh.vertices) out += fmt::format("{:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
    for (const auto& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return out;
  }
};

// A street along x: ground, two fronts, one of them with a gap, and a wall across its end.
inline std::vector<Part> street() {
  return {{{{{-60, -30, 0}, {120, 0, 0}, {0, 60, 0}}}, "concrete"},
          {{{{-60, 14, 0}, {120, 0, 0}, {0, 0, 9}}}, "brick"},
          {{{{-60, -13, 0}, {50, 0, 0}, {0, 0, 8}}, {{5, -13, 0}, {55, 0, 0}, {0, 0, 8}}}, "glass"},
          {{{{58, -11, 0}, {0, 23, 0}, {0, 0, 7}}}, "concrete"}};
}

}  // namespace wavetracer::test
