// SPDX-License-Identifier: Apache-2.0
// beam_gather: every facet that a ray through an aperture meets first is among its candidates, near ones first, and
// what a wall hides as a whole is not.
#include "passes/beam_gather.hpp"

#include "passes/beams.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Gathered {
  std::vector<std::vector<wt_beam_candidate>> of_aperture;
  std::vector<uint32_t> surface_of;  // for each facet
  std::set<uint32_t> surfaces(size_t aperture) const {
    std::set<uint32_t> out;
    for (const wt_beam_candidate& c : of_aperture[aperture]) out.insert(surface_of[c.facet]);
    return out;
  }
};

Gathered gather(const std::vector<Corners>& triangles, const std::vector<wt_aperture>& apertures) {
  const Scene scene = scene_of_triangles(triangles);
  const DeviceScene device = make_device_scene(context(), scene, false);
  const BeamTree tree = make_beam_tree(context(), WorldFacets(scene, {}).fixed());
  BeamLists lists(context());
  lists.apertures = context().buffer(apertures, "apertures");
  const auto count = static_cast<uint32_t>(apertures.size());
  const uint32_t chunks =
      BeamGather(context(), tree.depth)(tree, device, lists, 0, count, {}, std::numeric_limits<uint32_t>::max());
  Gathered out;
  for (const wt_facet& facet : tree.facets.read()) out.surface_of.push_back(facet.surface);
  out.of_aperture.resize(apertures.size());
  const std::vector<wt_chunk> heads = lists.chunks.read();
  const std::vector<wt_beam_candidate> all = lists.candidates.read();
  uint32_t reached = 0;
  for (uint32_t chunk = 0; chunk < chunks; ++chunk) {
    REQUIRE(heads[chunk].count <= WT_CHUNK);
    if (heads[chunk].first != chunk) continue;
    for (uint32_t at = chunk; at != WT_NONE; at = heads[at].next, ++reached) {
      REQUIRE(at < chunks);
      CHECK(heads[at].aperture == heads[chunk].aperture);
      for (uint32_t k = 0; k < heads[at].count; ++k)
        out.of_aperture[heads[chunk].aperture].push_back(all[size_t{at} * WT_CHUNK + k]);
    }
  }
  CHECK(reached == chunks);  // each chunk belongs to one chain
  return out;
}

}  // namespace

TEST_CASE("beam_gather: what rays meet first is among the candidates, and what a wall hides is not") {
  const uint32_t count = as_many(4000, 60);
  std::vector<Corners> triangles = loose_triangles(count, 1.5, 11);
  std::erase_if(triangles, [](const Corners& c) {
    return std::ranges::any_of(c, [](const glm::dvec3& p) { return glm::length(p) < 1.5; });
  });
  const std::vector<wt_aperture> apertures{window(-1, 1, -1, 1), window(-0.3, 0.3, -0.3, 0.3),
                                           window(-0.01, 0.01, -0.01, 0.01)};
  const Gathered open = gather(triangles, apertures);
  Random random(5);
  for (uint32_t i = 0; i < as_many(3000, 40); ++i) {
    const double y = random.between(-1, 1), z = random.between(-1, 1), reach = std::max(std::abs(y), std::abs(z));
    const Surfaces first = met(triangles, {0, 0, 0}, glm::normalize(glm::dvec3(1, y, z)), 1);
    if (first.empty()) continue;
    CHECK(open.surfaces(0).contains(first[0]));
    if (reach < 0.3) CHECK(open.surfaces(1).contains(first[0]));
    if (reach < 0.01) CHECK(open.surfaces(2).contains(first[0]));
  }
  CHECK(open.surfaces(1).size() < open.surfaces(0).size());
  CHECK(open.surfaces(2).size() <= open.surfaces(1).size());
  // A wall behind the window, larger than the middle one.
  triangles.push_back({glm::dvec3(1.2, -1, -1), {1.2, 3, -1}, {1.2, -1, 3}});
  const Gathered behind = gather(triangles, apertures);
  for (const size_t aperture : {1, 2}) {
    CAPTURE(open.surfaces(aperture).size());
    CHECK(behind.surfaces(aperture).contains(static_cast<uint32_t>(triangles.size() - 1)));
    CHECK(behind.surfaces(aperture).size() <= 1 + open.surfaces(aperture).size() / 4);
  }
}

TEST_CASE("beam_gather: many candidates grow the list, and an aperture that sees nothing has none") {
  const std::vector<Corners> triangles = loose_triangles(as_many(3000, 50), 0.4, 3);
  wt_aperture away = window(-0.5, 0.5, -0.5, 0.5);
  for (double& value : away.corners) value *= 100;
  for (int i = 0; i < 3; ++i) away.image[i] = i == 0 ? 50 : 0;  // it looks on from x = 50, where there is nothing
  for (int corner = 0; corner < 4; ++corner) away.corners[3 * corner] = 51;
  std::vector<wt_aperture> apertures(as_many(600, 3), window(-1, 1, -1, 1));
  apertures.push_back(away);
  const Gathered all = gather(triangles, apertures);
  CHECK(all.of_aperture.back().empty());
  for (size_t i = 1; i + 1 < apertures.size(); ++i) CHECK(all.of_aperture[i].size() == all.of_aperture[0].size());
  CHECK(all.of_aperture[0].size() > 2);
}
