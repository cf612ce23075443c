// SPDX-License-Identifier: Apache-2.0
// Tests vehicle models: they are closed, face outward (by their edges and volume), have the exact size, few planar
// surfaces and are symmetric. Volumes are compared with areas of the side views, computed by hand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "scene/vehicle_model.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Approx;
using doctest::Contains;

namespace {

struct Size {
  double length_m, width_m, height_m;
};
constexpr Size sizes[] = {{5, 1.8, 1.5}, {6.5, 2.16, 2.86}, {7.1, 2.4, 2.4}, {12, 2.5, 3.4}, {3.9, 1.7, 1.45}};
constexpr NamedBody kinds[] = {"car", "van", "truck", "bus", "tram", "motorcycle", "pedestrian"};

template <class Check>
void for_each_model(const Check& check) {
  for (const NamedBody kind : kinds) {
    for (const Size& size : sizes) {
      CAPTURE(kind);
      CAPTURE(size.length_m);
      check(vehicle_model(kind, size.length_m, size.width_m, size.height_m), size);
    }
  }
}

// A motorcycle and its rider, a trunk and a head.
size_t bodies(const Scene& scene) {
  const std::string& kind = scene.objects.at(0);
  return kind == "motorcycle" || kind == "pedestrian" ? 2 : 1;
}

double volume_m3(const Scene& scene) {
  double six_volumes = 0;
  for (const auto& t : scene.triangles) {
    six_volumes += glm::dot(scene.vertices[t[0]], glm::cross(scene.vertices[t[1]], scene.vertices[t[2]]));
  }
  return six_volumes / 6;
}

}  // namespace

TEST_CASE("vehicle models are closed, with every edge run through once each way") {
  for_each_model([](const Scene& scene, const Size&) {
    CHECK(scene.report.free_edges == 0);
    CHECK(scene.report.nonmanifold_edges == 0);
    CHECK(scene.report.degenerate_triangles == 0);
    CHECK(scene.report.duplicate_triangles == 0);
    CHECK(scene.report.warnings.empty());
    std::map<std::pair<uint32_t, uint32_t>, int> runs;
    for (const auto& t : scene.triangles) {
      for (size_t k = 0; k < 3; ++k) ++runs[{t[k], t[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : runs) {
      CHECK(count == 1);
      CHECK(runs.contains({edge.second, edge.first}));
    }
    // Euler's formula: bodies without holes.
    CHECK(scene.vertices.size() + scene.triangles.size() - scene.edges.size() == 2 * bodies(scene));
  });
}

TEST_CASE("vehicle models fill their size exactly and stand clear of the ground") {
  for_each_model([](const Scene& scene, const Size& size) {
    const glm::dvec3 lower = scene.lower + scene.origin_m, upper = scene.upper + scene.origin_m;
    CHECK(lower.x == Approx(-size.length_m / 2).epsilon(1e-15));
    CHECK(upper.x == Approx(size.length_m / 2).epsilon(1e-15));
    CHECK(lower.y == Approx(-size.width_m / 2).epsilon(1e-15));
    CHECK(upper.y == Approx(size.width_m / 2).epsilon(1e-15));
    CHECK(upper.z == Approx(size.height_m).epsilon(1e-15));
    if (bodies(scene) == 2) {
      CHECK(lower.z == Approx(0.03));
    } else {
      CHECK(lower.z >= 0.2);
      CHECK(lower.z <= 0.35 + 1e-12);
    }
  });
}

TEST_CASE("volumes are positive, so faces look outwards, and those of the side views") {
  // Side views in shares of length times body height, by trapezoids under the outline from tail to front.
  const double box_m3 = 5 * 1.8 * 1.25;
  const double van_share = 0.78 + 0.14 * (1 + 0.5) / 2 + 0.08 * (0.5 + 0.4) / 2;
  CHECK(volume_m3(vehicle_model("van", 5, 1.8, 1.5)) == Approx(van_share * box_m3));
  const double truck_share = 0.7 + 0.05 * 0.2 + 0.2 * 0.85 + 0.05 * (0.85 + 0.45) / 2;
  CHECK(volume_m3(vehicle_model("truck", 5, 1.8, 1.5)) == Approx(truck_share * box_m3));
  // Below the window line the car is as wide as its size. Above it is a frustum between the window line (0.66 long,
  // 1 wide) and the roof (0.32 by 0.8): by the prismoidal rule, with the section at mid-height 0.49 by 0.9.
  const double below = 0.1 * (0.5 + 0.55) / 2 + 0.66 * 0.55 + 0.24 * (0.55 + 0.4) / 2;
  const double above = 0.45 / 6 * (0.66 * 1 + 4 * 0.49 * 0.9 + 0.32 * 0.8);
  CHECK(volume_m3(vehicle_model("car", 5, 1.8, 1.5)) == Approx((below + above) * box_m3));
  CHECK(volume_m3(vehicle_model("bus", 5, 1.8, 1.5)) == Approx((0.975 + 0.025 * (1 + 0.35) / 2) * box_m3));
  CHECK(volume_m3(vehicle_model("tram", 5, 1.8, 1.5)) == Approx((0.9 + 0.1 * (1 + 0.3) / 2) * box_m3));
  // Octagons: rectangles whose corners are cut off.
  const double trunk = 1 - 0.125, head = 0.7 * 0.4 - 0.35 * 0.2 / 2;
  CHECK(volume_m3(vehicle_model("pedestrian", 0.3, 0.5, 1.7)) ==
        Approx((0.85 * trunk + 0.14 * head) * 0.3 * 0.5 * (1.7 - 0.03)));
}

TEST_CASE("few planar surfaces, of metal and skin, and every triangle in the plane of its surface") {
  const std::map<std::string, size_t> surfaces = {{"car", 12}, {"van", 8},         {"truck", 11},     {"bus", 7},
                                                  {"tram", 8}, {"motorcycle", 16}, {"pedestrian", 20}};
  const std::map<std::string, size_t> triangles = {{"car", 28},  {"van", 20},        {"truck", 32},     {"bus", 16},
                                                   {"tram", 20}, {"motorcycle", 40}, {"pedestrian", 56}};
  for_each_model([&](const Scene& scene, const Size&) {
    const std::string& kind = scene.objects.at(0);
    CHECK(scene.surfaces.size() == surfaces.at(kind));
    CHECK(scene.triangles.size() == triangles.at(kind));
    CHECK(scene.materials.size() == (kind == "motorcycle" ? 2 : 1));
    CHECK(scene.materials.at(0).name == (kind == "pedestrian" ? "human_skin" : "metal"));
    if (kind == "motorcycle") CHECK(scene.materials.at(1).name == "human_skin");
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
      const Surface& s = scene.surfaces[scene.triangle_surface[t]];
      for (uint32_t v : scene.triangles[t]) CHECK(std::abs(glm::dot(s.normal, scene.vertices[v]) - s.offset_m) < 1e-12);
    }
  });
}

TEST_CASE("the mirror image of a model is the model") {
  for_each_model([](const Scene& scene, const Size&) {
    using Point = std::array<double, 3>;
    std::set<std::set<Point>> faces, mirrored;
    for (const auto& t : scene.triangles) {
      std::set<Point> face, mirror;
      for (uint32_t v : t) {
        const glm::dvec3 p = scene.vertices[v] + scene.origin_m;
        face.insert({p.x, p.y, p.z});
        mirror.insert({p.x, -p.y, p.z});
      }
      const bool spans = std::any_of(face.begin(), face.end(), [](const Point& p) { return p[1] > 0; }) &&
                         std::any_of(face.begin(), face.end(), [](const Point& p) { return p[1] < 0; });
      if (spans) continue;  // a quad across the vehicle has one of its two diagonals
      faces.insert(face);
      mirrored.insert(mirror);
    }
    if (scene.objects[0] != "pedestrian") CHECK(faces == mirrored);  // whose quads each have one of two diagonals
    CHECK(faces.size() >= 6);
    for (const glm::dvec3& v : scene.vertices) {
      const glm::dvec3 p = v + scene.origin_m, image(p.x, -p.y, p.z);
      CHECK(std::any_of(scene.vertices.begin(), scene.vertices.end(),
                        [&](const glm::dvec3& q) { return q + scene.origin_m == image; }));
    }
  });
}

TEST_CASE("antennas have a place above the roof, before and behind") {
  for_each_model([](const Scene& scene, const Size& size) {
    REQUIRE(scene.nodes.size() == 3);
    const auto at = [&](size_t i) { return scene.nodes[i].position_m + scene.origin_m; };
    CHECK(scene.nodes[0].name == "roof_antenna");
    CHECK(at(0).z == Approx(size.height_m + 0.05));
    CHECK(at(0).y == 0);
    CHECK(std::abs(at(0).x) < size.length_m / 3);
    CHECK(scene.nodes[1].name == "front_antenna");
    CHECK(at(1).x == Approx(size.length_m / 2 + 0.05));
    CHECK(scene.nodes[2].name == "rear_antenna");
    CHECK(at(2).x == Approx(-size.length_m / 2 - 0.05));
  });
  // The roof of the car: from 24% behind its middle to 8% before it.
  const Scene car = vehicle_model("car", 5, 1.8, 1.5);
  CHECK(car.nodes[0].position_m.x + car.origin_m.x == Approx(-0.4));
}

TEST_CASE("an unknown kind and an impossible size are errors") {
  CHECK_THROWS_WITH_AS(vehicle_model("none", 2, 1, 1),
                       Contains("'none'; known: car, van, truck, bus, tram, motorcycle, pedestrian"), ConfigError);
  CHECK_THROWS_WITH_AS(vehicle_model("car", 5, 0, 1.5), Contains("0 m is not a valid size"), ConfigError);
  CHECK_THROWS_WITH_AS(vehicle_model("car", std::nan(""), 1.8, 1.5), Contains("nan m"), ConfigError);
}
