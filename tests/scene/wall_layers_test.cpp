// SPDX-License-Identifier: Apache-2.0
// Walls of several layers: what their layers are, what is refused, and which side of a surface is the outer one.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "one_mesh.hpp"
#include "scene/build_scene.hpp"
#include "scene/info.hpp"
#include "scene/materials.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;
using test::named;
using test::one_mesh;

namespace {

MaterialConfig wall(const std::string& name, const std::vector<LayerConfig>& layers) {
  MaterialConfig out;
  out.name = name;
  out.layers = layers;
  return out;
}

MaterialConfig plain(const std::string& name, double permittivity) {
  MaterialConfig out;
  out.name = name;
  out.permittivity = permittivity;
  return out;
}

ResolvedMaterials resolve(const std::vector<MaterialConfig>& tables, const RawMaterial& material) {
  return resolve_materials(one_mesh(material), {}, tables, 5.9e9);
}

// Adds a mesh of triangles with corners of its own.
void add_mesh(RawScene& raw, const std::vector<std::array<glm::dvec3, 3>>& triangles) {
  RawMesh mesh{"mesh", "mesh.ply", {}, {}, 0};
  for (const auto& triangle : triangles) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  raw.meshes.push_back(std::move(mesh));
}

std::vector<std::array<glm::dvec3, 3>> box(const glm::dvec3& size, bool inside_out) {
  std::vector<std::array<glm::dvec3, 3>> out;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      glm::dvec3 corner(0), u(0), v(0);
      corner[axis] = far ? size[axis] : 0;
      u[(axis + 1) % 3] = size[(axis + 1) % 3];
      v[(axis + 2) % 3] = size[(axis + 2) % 3];
      if (far == inside_out) std::swap(u, v);
      out.push_back({corner, corner + u, corner + u + v});
      out.push_back({corner, corner + u + v, corner + v});
    }
  return out;
}

Scene scene_of(const std::vector<std::array<glm::dvec3, 3>>& triangles, bool layered = true) {
  RawScene raw;
  raw.file = "scene.xml";
  raw.materials = {named("facade")};
  add_mesh(raw, triangles);
  const MaterialConfig facade =
      layered ? wall("facade", {{"brick", 0.12}, {"concrete", 0.2}}) : wall("facade", {{"brick", 0.12}});
  return build_scene(raw, resolve_materials(raw, {}, {facade}, 5.9e9));
}

// The unit vector from a surface to its outer side.
glm::dvec3 outwards(const Surface& surface) { return surface.outer_is_below ? -surface.normal : surface.normal; }

}  // namespace

TEST_CASE("layers have the laws of their names and thicknesses of their own") {
  const ResolvedMaterials resolved =
      resolve({wall("facade", {{"itu_brick", 0.12}, {"foam", 0.1}, {"concrete", 0.2}}), plain("foam", 1.1)},
              named("mat-facade"));
  CHECK(resolved.warnings.empty());
  const Material& facade = resolved.materials.at(0);
  CHECK(facade.name == "facade");
  REQUIRE(facade.layers.size() == 3);
  CHECK(facade.layers[0] == Material{"brick", 3.91, 0, 0.0238, 0.16, 1, 40, 0.12});
  CHECK(facade.layers[1].a == 1.1);
  CHECK(facade.layers[1].thickness_m == 0.1);
  CHECK(facade.layers[2].name == "concrete");
  CHECK(facade.thickness_m == doctest::Approx(0.42));
  CHECK(facade.a == 3.91);
}

TEST_CASE("a wall of one layer is a slab") {
  MaterialConfig slab = plain("own", 4);
  slab.name = "facade";
  slab.thickness_m = 0.3;
  const Material one = resolve({wall("facade", {{"own", 0.3}}), plain("own", 4)}, named("facade")).materials.at(0);
  CHECK(one == resolve({slab}, named("facade")).materials.at(0));
}

TEST_CASE("layers replace what the file says, and walls keep their scattering") {
  MaterialConfig rough = wall("facade", {{"brick", 0.12}, {"concrete", 0.2}});
  rough.scattering = 0.4;
  rough.scattering_lobe = 4;
  RawMaterial in_file = named("facade");
  in_file.permittivity = 7;
  in_file.thickness_m = 1;
  const Material facade = resolve({rough}, in_file).materials.at(0);
  CHECK(facade.layers.size() == 2);
  CHECK(facade.scattering == 0.4);
  CHECK(facade.scattering_lobe == 4);
  CHECK(facade.layers[0].scattering == 0);
}

TEST_CASE("errors of layers name the wall, the layer and what to do") {
  const auto fails = [](const std::vector<MaterialConfig>& tables, const char* message) {
    CAPTURE(message);
    CHECK_THROWS_WITH_AS(resolve(tables, named("concrete")), Contains(message), ConfigError);
  };
  fails({wall("facade", {{"brik", 0.1}, {"brick", 0.1}})},
        "[[material]] 'facade': its layer 'brik' is not a known material; known: vacuum");
  fails({wall("facade", {{"inner", 0.1}}), wall("inner", {{"brick", 0.1}})},
        "its layer 'inner' has layers itself: list those layers here");
  fails({wall("facade", {{"facade", 0.1}})}, "has layers itself");
  fails({wall("facade", {{"vegetation", 0.1}})}, "is vegetation, which is no layer of a wall");
  fails({wall("facade", {{"brick", -0.1}})}, "positive thickness_m");
  fails({wall("facade", std::vector<LayerConfig>(9, {"brick", 0.1}))},
        "it has 9 layers, and a wall may have 8 at most");
  MaterialConfig both = wall("facade", {{"brick", 0.1}});
  both.thickness_m = 0.3;
  fails({both}, "layers say what the wall is made of");
  both = wall("facade", {{"brick", 0.1}});
  both.library = "wood";
  fails({both}, "layers say what the wall is made of");
  both = wall("facade", {{"brick", 0.1}});
  both.vegetation = "mixed";
  fails({both}, "vegetation is no surface");
}

TEST_CASE("the outer side of a closed body is its outside, however its triangles turn") {
  for (const bool inside_out : {false, true}) {
    const glm::dvec3 size(6, 4, 3);
    const Scene scene = scene_of(box(size, inside_out));
    REQUIRE(scene.surfaces.size() == 6);
    for (const Surface& surface : scene.surfaces) {
      const glm::dvec3 from_middle = (surface.lower + surface.upper) / 2.0 + scene.origin_m - size / 2.0;
      CHECK(glm::dot(outwards(surface), from_middle) > 0);
    }
  }
}

TEST_CASE("the outer side of an open sheet is the one from which its triangles are counter-clockwise") {
  for (const bool turned : {false, true}) {
    const glm::dvec3 a(0, 0, 0), b(6, 0, 0), c(6, 0, 3);
    const Scene scene = scene_of({turned ? std::array{a, c, b} : std::array{a, b, c}});
    REQUIRE(scene.surfaces.size() == 1);
    CHECK(outwards(scene.surfaces[0]).y == doctest::Approx(turned ? 1 : -1));
  }
}

TEST_CASE("the report of a scene lists the layers of each wall") {
  const std::string text = describe_scene(scene_of(box({6, 4, 3}, false)));
  CAPTURE(text);
  CHECK(text.find("facade               2 layers; 12 triangles, 6 surfaces, 108 m2") != std::string::npos);
  CHECK(text.find("    brick              0.12 m thick, permittivity 3.91") != std::string::npos);
  CHECK(text.find("    concrete           0.2 m thick, permittivity 5.24") != std::string::npos);
}

TEST_CASE("surfaces of other materials have no outer side") {
  for (const Surface& surface : scene_of(box({6, 4, 3}, false), false).surfaces) CHECK_FALSE(surface.outer_is_below);
}
