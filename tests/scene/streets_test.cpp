// SPDX-License-Identifier: Apache-2.0
// Compares the streets of a generated city with its buildings and its traffic, which are generated without these
// streets.
#include "scene/streets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scene/build_scene.hpp"
#include "scene/city_traffic.hpp"

using namespace wavetracer;

namespace {

bool on_street(const std::vector<Street>& streets, const glm::dvec3& p) {
  return std::ranges::any_of(streets, [&](const Street& street) {
    const glm::dvec3 a = street.centre_m[0], b = street.centre_m[1];
    const double across_m = a.x == b.x ? std::abs(p.x - a.x) : std::abs(p.y - a.y);
    const bool along = p.x >= std::min(a.x, b.x) - street.width_m / 2 &&
                       p.x <= std::max(a.x, b.x) + street.width_m / 2 &&
                       p.y >= std::min(a.y, b.y) - street.width_m / 2 && p.y <= std::max(a.y, b.y) + street.width_m / 2;
    return along && across_m <= street.width_m / 2;
  });
}

}  // namespace

TEST_CASE("vehicles of a generated city drive on its streets, and no house stands on them") {
  for (const char* text : {"--seed 1 --blocks 4x4", "--seed 3 --blocks 5x2 --block-m 60 --street-m 14"}) {
    CAPTURE(text);
    const CityOptions options = parse_city_options(text);
    const std::vector<Street> streets = city_streets(options);
    CHECK(streets.size() == options.blocks_x + options.blocks_y + 2);
    for (const Track& track : generate_traffic(text).tracks)
      for (const Sample& sample : track.samples) CHECK(on_street(streets, sample.position_m));
    size_t corners = 0;
    for (const RawMesh& mesh : generate_city(options).meshes)
      for (const glm::dvec3& p : mesh.vertices)
        if (p.z > 1) {  // the vertices of houses, which reach below the ground
          ++corners;
          CHECK_FALSE(on_street(streets, p));
        }
    CHECK(corners > 100);
  }
}
