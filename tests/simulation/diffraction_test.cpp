// SPDX-License-Identifier: Apache-2.0
// Compares diffracted paths of whole frames with brute force: sets, numbers and places of all sequences of reflections
// with one diffraction or two must be identical, with and without transmission.
#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Place {
  const char* name;
  std::vector<Mesh> meshes;
  Points transmitters, receivers;
};

std::vector<Mesh> meshes_of(const std::vector<Part>& parts) {
  std::vector<Mesh> out;
  for (const Part& p : parts) out.push_back(mesh_of(p));
  return out;
}

// Free edges, since the rim of a ground is none.
const Part banner{{{{-2.1, -6.3, 6.1}, {3.3, 0.5, 0.2}, {0.1, 0.2, 2.7}}}},
    sign{{{{-7.1, -1.9, 4.9}, {0.3, 4.3, 0.1}, {0.1, 0, 1.2}}}},
    board{{{{-13.1, 0.9, 3.1}, {0.4, 2.7, 0.1}, {0.1, 0, 2.9}}}};

std::vector<Mesh> street_with_car() {
  std::vector<Mesh> meshes = meshes_of(street());
  meshes.push_back(mesh_of(sign));
  meshes.push_back(mesh_of({"car", "passenger", {-3.1, 1.7, 0.03}, {9.7, 1.3, 0}, 0, 1}, 0.2));
  return meshes;
}

std::vector<Place> places() {
  return {
      {"screens", meshes_of({{screens()}}), {{-9.3, 0.7, 1.9}}, {{9.1, -1.2, 2.3}, {1.3, 2.1, 3.7}}},
      {"boxes", meshes_of({{two_boxes()}, banner, board}), {{-11.3, -5.7, 1.6}}, {{11.9, 3.3, 1.9}, {0.9, 3.1, 8.3}}},
      {"L", meshes_of({{l_shaped()}, board}), {{-10.7, -6.3, 1.9}}, {{3.9, 6.1, 2.2}, {-9.7, 9.9, 6.1}}},
      {"street", street_with_car(), {{-21.3, 2.17, 4.1}}, {{14.3, -1.9, 1.1}, {2.3, 4.7, 0.6}}}};
}

size_t check(const Place& place, const TraceConfig& trace) {
  CAPTURE(std::string(place.name));
  return check_complete(MeshFile(place.meshes).path(), place.transmitters, place.receivers, trace);
}

}  // namespace

TEST_CASE("one diffraction among reflections, order 3, with free edges and without") {
  for (const Place& place : places()) {
    TraceConfig trace = diffracting(1000000, 3);
    const size_t all = check(place, trace);
    trace.free_edges = false;
    const size_t closed = check(place, trace);
    CHECK(all > 15);
    CHECK(closed < all);
  }
}

TEST_CASE("two diffractions") {
  for (const Place& place : places()) {
    TraceConfig trace = diffracting(1000000, 3);
    trace.max_diffractions = 2;
    CHECK(check(place, trace) > 50);
  }
}

TEST_CASE("through walls as well: one transmission, and two with two diffractions") {
  for (Place place : places()) {
    // Nothing passes through metal, and brute force does not consider materials.
    for (Mesh& mesh : place.meshes) mesh.material = "concrete";
    for (const auto& [most, diffractions] : {std::pair{1u, 1u}, {2u, 2u}}) {
      CAPTURE(most);
      TraceConfig trace = diffracting(1000000, 3);
      trace.transmission = true;
      trace.max_transmissions = most;
      trace.max_diffractions = diffractions;
      CHECK(check(place, trace) > 15 * diffractions);
    }
  }
}

TEST_CASE("without reflection, and at depth 1, edges alone") {
  for (const Place& place : places()) {
    TraceConfig trace = diffracting(200000, 2);
    trace.reflection = false;
    trace.max_diffractions = 2;
    CHECK(check(place, trace) > 3);
    CHECK(check(place, diffracting(200000, 1)) > 0);
  }
}
