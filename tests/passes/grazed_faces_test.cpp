// SPDX-License-Identifier: Apache-2.0
// grazed_faces: the sequences that it enters beside a loop over all known ones, the edges of their last surfaces, and
// the azimuths of images about these, in double on the host.
#include "passes/grazed_faces.hpp"

#include <doctest/doctest.h>

#include "passes/wedge_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Ends a little above the roof of the box, a little outside of the planes of its walls, and elsewhere.
const std::vector<glm::dvec3> places{{-7.1, 1.3, 4.5}, {1.9, 8.9, 2.1},   {6.3, 5.9, 1.1},   {-2.3, -9.4, 3.3},
                                     {9.2, -3.4, 2.9}, {1.8, -12.3, 4.2}, {-11.2, 2.9, 1.4}, {14.1, -3.1, 5.2},
                                     {7.3, 2.5, 4.4},  {-2.1, 13.3, 5.1}, {1.75, 6.6, 0.8},  {-9.7, -3.2, 4.3}};

struct Entered {
  SequenceSet sequences;
  uint32_t listed = 0;
  std::vector<wt_wedge> wedges;
  std::vector<wt_exact_surface> surfaces;
  std::vector<wt_surface> boxes;
};

Entered extended(const std::vector<Sequence>& known, uint64_t slots) {
  const Scene world = box_and_panels();
  DeviceScene scene = make_device_scene(context(), world, false, 100);
  Wedges wedges(context(), world, {}, {}, true);
  wedges(scene);
  std::vector<EndState> transmitters;
  for (const glm::dvec3& p : places) transmitters.push_back({p});
  const RadioEnds ends = make_radio_ends(context(), transmitters, {{{0, 0, 20}}}, {}, {});
  const auto count = static_cast<uint32_t>(places.size());
  Sequences set(context(), slots);
  enter(set, scene, known, 4);
  GrazedFaces pass(context(), false);
  Entered out{{}, 0, wedges.list().wedges.read(), scene.exact_surfaces.read(), scene.surfaces.read()};
  out.listed = set.extend(set.collect(count), 4,
                          [&](const Sequences::Found& found) { pass(scene, wedges.list(), ends, found); });
  const auto held = contents(set, count);
  REQUIRE(held.has_value());
  out.sequences = *held;
  // A frame whose lists were too short runs again: what the pass has entered leads to nothing further.
  set.extend(set.collect(count), 4, [&](const Sequences::Found& found) { pass(scene, wedges.list(), ends, found); });
  CHECK(contents(set, count) == held);
  return out;
}

// The angle between the plane of a face of a wedge and the plane through its edge and p, negative below the face.
double elevation(const Wedge& w, const glm::dvec3& p, int face) {
  const glm::dvec3 d = p - w.start;
  double azimuth = std::atan2(glm::dot(d, w.normal), glm::dot(d, w.face));
  if (azimuth < 0) azimuth += 2 * std::numbers::pi;
  return std::asin(std::sin(face == 0 ? azimuth : w.exterior_rad - azimuth));
}

// The sequences that must be there, with room for rounding, or may be there: those, too, whose last mirror does not
// show the edge.
SequenceSet expected(const std::vector<Sequence>& known, const Entered& world, bool may) {
  const double grazing = std::asin(0.1), slack = may ? 1e-7 : -1e-7;
  SequenceSet out = with_prefixes(known);
  for (const Sequence& s : with_prefixes(known)) {
    Sequence prefix = s;
    prefix.surfaces.pop_back();
    glm::dvec3 image = places[s.transmitter];
    for (const uint32_t number : prefix.surfaces)
      image = mirrored_by(
          {.normal = vector_of(world.surfaces[number].normal), .offset_m = world.surfaces[number].offset}, image);
    for (const wt_wedge& record : world.wedges) {
      const Wedge wedge = wedge_of(record);
      if (wedge.surface[0] == wedge.surface[1]) continue;  // a free edge has no other face
      for (const int face : {0, 1}) {
        if (wedge.surface[1 - face] != s.surfaces.back()) continue;
        const double above = elevation(wedge, image, face);
        if (above < -slack || above > grazing + slack || !in_sector(wedge, image, -slack)) continue;
        const uint32_t last = prefix.surfaces.empty() ? WT_NONE : prefix.surfaces.back();
        if (last == wedge.surface[face]) continue;
        if (!may && last != WT_NONE && !shows(world.surfaces[last], world.boxes[last], image, wedge, 1e-9)) continue;
        Sequence grazed = prefix;
        grazed.surfaces.push_back(wedge.surface[face]);
        out.insert(grazed);
      }
    }
  }
  return out;
}

}  // namespace

TEST_CASE("faces that ends see at grazing beside known faces are entered, and nothing else") {
  size_t direct = 0, mirrored = 0;  // that are new
  size_t entered = 0, any = 0;      // that are new, and that may be
  for (uint32_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    std::vector<Sequence> known = all_sequences(12, 9, 2);
    Random random(seed);
    std::erase_if(known, [&](const Sequence&) { return random() > 0.06; });
    const SequenceSet before = with_prefixes(known);
    const Entered found = extended(known, seed % 2 == 0 ? 1 << 15 : 64);  // the smaller table must grow
    const SequenceSet must = expected(known, found, false), may = expected(known, found, true);
    CHECK(std::ranges::includes(found.sequences, must));
    CHECK(std::ranges::includes(may, found.sequences));
    CHECK(found.listed == found.sequences.size() + places.size());
    entered += found.sequences.size() - before.size();
    any += may.size() - before.size();
    for (const Sequence& s : must)
      if (!before.contains(s)) ++(s.surfaces.size() > 1 ? mirrored : direct);
  }
  CHECK(direct > 100);
  CHECK(mirrored > 5);
  CHECK(any - entered > 30);  // many of those whose mirror shows no edge are passed over
}

TEST_CASE("a roof that no ray has met is entered for the wall below it") {
  const Entered found = extended({{0, {0}}, {1, {3}}, {2, {1}}}, 1 << 10);
  const SequenceSet must = expected({{0, {0}}, {1, {3}}, {2, {1}}}, found, false);
  CHECK(found.sequences == must);
  CHECK(must.size() == 5);
}
