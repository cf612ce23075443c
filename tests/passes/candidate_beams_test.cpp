// SPDX-License-Identifier: Apache-2.0
// candidates: beams of sequences reject no area and no group of receivers with one that passes the last test, which is
// made here again in double, without boxes of receivers. Receivers stand in clusters of a group or an area, where a
// reflection is on the border of a surface, or a hair beyond it.
#include <doctest/doctest.h>

#include <algorithm>

#include "passes/image_method.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Streets between rectangles whose corners float32 holds exactly; the first one is the ground, hundreds of metres wide.
std::vector<Quad> street(const glm::dvec3& origin) {
  std::vector<Quad> quads{{{-512, -512, 0}, {1024, 0, 0}, {0, 1024, 0}},
                          {{-40, 12, 0}, {72, 0, 0}, {0, 0, 24}},
                          {{-56, -10, 0}, {0, 0, 18}, {104, 0, 0}},
                          {{36, -4, 0}, {0, 14, 0}, {0, 0, 20}},
                          {{-60, 2, 0}, {12, 12, 0}, {0, 0, 16}}};
  for (Quad& quad : quads) quad.corner += origin;
  return quads;
}

double sum_of_sizes(const glm::dvec3& p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z); }

// Is every reflection on the way to the receiver in the box of its rectangle, by nine tenths of the margins that the
// program allows?
bool in_all_boxes(const std::vector<Quad>& quads, const std::vector<glm::dvec3>& images,
                  const std::vector<uint32_t>& chain, glm::dvec3 to) {
  for (size_t k = chain.size(); k-- > 0;) {
    const Quad& quad = quads[chain[k]];
    const glm::dvec3 n = normal_of(quad), far = quad.corner + quad.u + quad.v;
    const double a = glm::dot(n, images[k + 1] - quad.corner), b = glm::dot(n, to - quad.corner);
    const bool on_both = k + 1 < chain.size() && std::abs(b) <= 0.9e-9 * (1 + sum_of_sizes(to));
    if (!on_both) {
      if (a * b >= 0) return false;
      to = images[k + 1] + (to - images[k + 1]) * (a / (a - b));
    }
    const double margin = 0.9 * (1e-3 + 1e-6 * sum_of_sizes(to));
    for (int axis = 0; axis < 3; ++axis)
      if (to[axis] < std::min(quad.corner[axis], far[axis]) - margin ||
          to[axis] > std::max(quad.corner[axis], far[axis]) + margin)
        return false;
  }
  return true;
}

// A point on the border of a rectangle, or up to 0.8 mm beyond it; every third one is beside the antenna.
glm::dvec3 border_point(const Quad& quad, const glm::dvec3& antenna, Random& random) {
  const bool across = random.below(2) == 0;
  const glm::dvec3 along = across ? quad.v : quad.u, out = across ? quad.u : quad.v;
  const double beside = glm::dot(antenna - quad.corner, along) / glm::dot(along, along) + random.between(-1e-4, 1e-4);
  const double place = random.below(3) == 0 ? std::clamp(beside, 0.0, 1.0) : random();
  const double beyond = random.below(3) == 0 ? 0 : 8e-4 * random() / glm::length(out);
  return quad.corner + along * place + out * (random.below(2) == 0 ? 1 + beyond : -beyond);
}

// Returns a receiver that a chain reaches over a border point of one of its mirrors, nearly or exactly; or nothing.
std::optional<glm::dvec3> border_receiver(const std::vector<Quad>& quads, const std::vector<glm::dvec3>& images,
                                          const std::vector<uint32_t>& chain, Random& random) {
  size_t k = random.below(static_cast<uint32_t>(chain.size()));
  glm::dvec3 point = border_point(quads[chain[k]], images[0], random);
  for (++k; k < chain.size(); ++k) {
    const glm::dvec3 n = normal_of(quads[chain[k]]), way = point - images[k];
    const double height = glm::dot(n, point - quads[chain[k]].corner), along = glm::dot(n, way);
    if (std::abs(height) > 1e-9 && !(height * along < 0)) return {};
    if (std::abs(height) > 1e-9) point -= way * (height / along);
  }
  point += random.in_cube(std::pow(10.0, random.between(-9, -4)));
  const glm::dvec3 way = point - images.back();
  const glm::dvec3 at = point + way * (std::pow(10.0, random.between(-2, 2.5)) / glm::length(way));
  if (!in_all_boxes(quads, images, chain, at)) return {};
  return at;
}

std::vector<glm::dvec3> clusters_on_borders(const std::vector<Quad>& quads, const glm::dvec3& transmitter,
                                            const std::vector<Sequence>& sequences, size_t clusters, size_t size,
                                            Random& random) {
  std::vector<glm::dvec3> out;
  while (out.size() < clusters * size) {
    std::vector<uint32_t> chain = sequences[random.below(static_cast<uint32_t>(sequences.size()))].surfaces;
    chain.resize(1 + random.below(static_cast<uint32_t>(chain.size())));
    const std::optional<glm::dvec3> at = border_receiver(quads, images_of(quads, transmitter, chain), chain, random);
    if (!at) continue;
    const double spread = std::pow(10.0, random.between(-9, -4));
    for (size_t i = 0; i < size; ++i) out.push_back(i == 0 ? *at : *at + random.in_cube(spread));
  }
  return out;
}

// The pairs of a sequence and a receiver that the pass lists, without lines of sight.
std::set<std::pair<Sequence, uint32_t>> listed(const std::vector<Quad>& quads, const glm::dvec3& transmitter,
                                               const std::vector<glm::dvec3>& receivers,
                                               const std::vector<Sequence>& sequences) {
  const DeviceScene scene =
      make_device_scene(context(), reference::scene_of_quads(quads), false, sum_of_sizes(transmitter));
  const RadioEnds ends = standing_ends({transmitter}, receivers);
  Sequences set(context(), 4096);
  enter(set, scene, sequences, 3);
  Candidates find(context(), 3);
  const uint32_t nodes = set.collect(1), count = find(scene, ends, set.table(), set.nodes(), nodes, set.counters());
  const std::vector<uint64_t> table = set.table().read();
  std::set<std::pair<Sequence, uint32_t>> out;
  for (const wt_candidate& c : find.list().read(0, count)) {
    Sequence s;
    for (uint32_t node = c.node; !(node & WT_ROOT); node = static_cast<uint32_t>(table[node] >> 32))
      s.surfaces.insert(s.surfaces.begin(), static_cast<uint32_t>(table[node]));
    if (!s.surfaces.empty()) CHECK(out.emplace(s, c.receiver).second);
  }
  return out;
}

// least: so many pairs of a sequence and a receiver pass the last test.
void compare_with_boxes(const std::vector<Quad>& quads, const glm::dvec3& transmitter,
                        const std::vector<glm::dvec3>& receivers, size_t least) {
  const std::vector<Sequence> sequences = all_sequences(1, static_cast<uint32_t>(quads.size()), 3);
  const auto found = listed(quads, transmitter, receivers, sequences);
  size_t accepted = 0, lost = 0;
  for (const Sequence& s : with_prefixes(sequences)) {
    const std::vector<glm::dvec3> images = images_of(quads, transmitter, s.surfaces);
    for (uint32_t r = 0; r < receivers.size(); ++r) {
      if (!in_all_boxes(quads, images, s.surfaces, receivers[r])) continue;
      ++accepted;
      lost += !found.contains({s, r});
    }
  }
  CHECK(accepted >= least);
  CHECK(lost == 0);
  CHECK(found.size() < 2 * accepted);
}

// Clusters of a group, and of an area.
void compare_clusters(const std::vector<Quad>& quads, const glm::dvec3& transmitter, Random& random) {
  const std::vector<Sequence> sequences = all_sequences(1, static_cast<uint32_t>(quads.size()), 3);
  for (const auto& [clusters, size] : {std::pair<size_t, size_t>{68, 16}, {5, 256}}) {
    CAPTURE(size);
    compare_with_boxes(quads, transmitter, clusters_on_borders(quads, transmitter, sequences, clusters, size, random),
                       clusters);
  }
}

}  // namespace

TEST_CASE("beams of all mirrors: none is lost whose reflection is on the border of a surface") {
  Random random(11);
  compare_clusters(street({}), {-7.25, 3.5, 1.5}, random);
}

TEST_CASE("beams of grazing mirrors: the antenna is a hair in front of walls, and far from the origin") {
  Random random(12);
  const glm::dvec3 far{8192, -16384, 0};
  compare_clusters(street({}), {35.999, 9.999, 0.001}, random);
  compare_clusters(street(far), far + glm::dvec3{-20, 11.9999, 0.0001}, random);
}

// The last test takes the wall's point for the ground's, too, where it is in the ground but for rounding. Seen from an
// antenna that is closer to the ground than that, the leg comes from below.
TEST_CASE("beams over a corner beside the antenna: the ground may reflect where the wall does") {
  Random random(13);
  const glm::dvec3 origin{8192, -16384, 0}, transmitter = origin + glm::dvec3{-20, 11.999, 1e-6};
  const std::vector<Quad> quads = street(origin);
  const glm::dvec3 image = images_of(quads, transmitter, {0, 1}).back();
  std::vector<glm::dvec3> receivers;
  for (size_t cluster = 0; cluster < 80; ++cluster) {
    const glm::dvec3 way = origin + glm::dvec3{random.between(-20.004, -19.996), 12, -1e-5 * random()} - image;
    for (size_t i = 0; i < 16; ++i) receivers.push_back(image + way * (random.between(100, 101) / glm::length(way)));
  }
  compare_with_boxes(quads, transmitter, receivers, receivers.size());
}
