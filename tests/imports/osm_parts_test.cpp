// SPDX-License-Identifier: Apache-2.0
// Outlines and their parts: parts that fill an outline replace it, parts that hardly fill it stand on it. Heights come
// from tags.
#include <doctest/doctest.h>

#include <cmath>

#include "imported.hpp"
#include "imports/rings.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

imports::Ring ring_of(const Points& points) {
  imports::Ring out;
  for (const auto& [x, y] : points)
    out.push_back({std::llround(x * imports::grid_per_m), std::llround(y * imports::grid_per_m)});
  return out;
}

imports::Polygon polygon_of(const Points& outer, const std::vector<Points>& holes = {}) {
  imports::Polygon out{ring_of(outer), {}};
  for (const Points& hole : holes) out.holes.push_back(ring_of(hole));
  imports::orient(out);
  return out;
}

double share_of(const imports::Polygon& polygon, const std::vector<imports::Polygon>& others) {
  std::vector<const imports::Polygon*> pointers;
  for (const imports::Polygon& other : others) pointers.push_back(&other);
  return imports::covered_share(polygon, pointers);
}

// A house of 30 x 30 x 20 m with parts of these outlines, each with these tags.
struct Part {
  Points outline;
  TagList tags;
};
std::string house_with(const std::vector<Part>& parts) {
  OsmText map;
  map.way(rectangle(0, 0, 30, 30), {{"building", "yes"}, {"height", "20"}});
  for (Part part : parts) {
    part.tags.emplace_back("building:part", "yes");
    map.way(part.outline, part.tags);
  }
  return map.text();
}

constexpr const char* good = "outline whose parts are built instead";
constexpr const char* gaps = "outline whose parts are built instead, though they leave gaps in it";
constexpr const char* stands =
    "outline of which parts fill less than half: built as well as what of its parts is above it";

}  // namespace

TEST_CASE("the share of a polygon that others cover, by areas that one can write down") {
  const imports::Polygon square = polygon_of(rectangle(0, 0, 10, 10));
  CHECK(share_of(square, {}) == 0);
  CHECK(share_of(square, {square}) == doctest::Approx(1));
  CHECK(share_of(square, {square, square}) == doctest::Approx(1));
  CHECK(share_of(square, {polygon_of(rectangle(-5, -5, 5, 20))}) == doctest::Approx(0.5));
  CHECK(share_of(square, {polygon_of(rectangle(0, 0, 6, 10)), polygon_of(rectangle(4, 0, 10, 5))}) ==
        doctest::Approx(0.8).epsilon(0.01));
  CHECK(share_of(square, {polygon_of({{0, 0}, {10, 0}, {0, 10}})}) == doctest::Approx(0.5).epsilon(0.01));
  CHECK(share_of(square, {polygon_of(rectangle(20, 20, 30, 30))}) == 0);
  const imports::Polygon yard = polygon_of(rectangle(0, 0, 10, 10), {rectangle(2, 2, 8, 8)});
  CHECK(share_of(square, {yard}) == doctest::Approx(0.64).epsilon(0.01));
  CHECK(share_of(yard, {polygon_of(rectangle(2, 2, 8, 8))}) == doctest::Approx(0).epsilon(0.01));
  CHECK(share_of(yard, {polygon_of(rectangle(0, 0, 10, 5))}) == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("a house of which a chimney alone is mapped stands below its chimney, and the import says so") {
  const TemporaryFolder folder;
  const auto [summary, scene] =
      import_text(house_with({{rectangle(10, 10, 12, 12), {{"height", "25"}, {"min_height", "20"}}}}), folder);
  CHECK(summary.buildings == 1);
  CHECK(summary.parts == 1);
  CHECK(summary.left_out.empty());
  CHECK(summary.guessed.at(stands) == 1);
  CHECK(std::abs(volume_m3(scene, "way_") - (900 * 21 + 4 * 5)) < 30);
  REQUIRE(summary.warnings.size() == 1);
  CHECK(summary.warnings[0].find("fill less than half of 1 outline, as little as 0.4% of way_5") != std::string::npos);
}

TEST_CASE("parts that cover little: what is above the house stands on it, what is within it is there already") {
  const TemporaryFolder folder;
  const auto [summary, scene] =
      import_text(house_with({{rectangle(0, 0, 10, 10), {{"height", "50"}}},
                              {rectangle(20, 20, 30, 30), {{"height", "15"}}},
                              {rectangle(12, 12, 14, 14), {{"height", "30"}, {"min_height", "25"}}}}),
                  folder);
  CHECK(summary.buildings == 1);
  CHECK(summary.parts == 2);
  CHECK(summary.left_out.at("part inside of its outline, which is built itself") == 1);
  CHECK(std::abs(volume_m3(scene, "way_") - (900 * 21 + 100 * 30 + 4 * 5)) < 50);
  CHECK(summary.warnings.at(0).find("22.") != std::string::npos);  // 200 of 900 m2
}

TEST_CASE("parts that fill most of an outline replace it, and gaps are told; a slab under the roof fills nothing") {
  const TemporaryFolder folder;
  const Imported full = import_text(house_with({{rectangle(0, 0, 15, 30), {{"height", "10"}}},
                                                {rectangle(15, 0, 30, 30), {{"height", "20"}, {"min_height", "3"}}}}),
                                    folder);
  CHECK(full.summary.buildings == 0);
  CHECK(full.summary.left_out.at(good) == 1);
  CHECK(full.summary.warnings.empty());
  const Imported most = import_text(house_with({{rectangle(0, 0, 30, 21), {{"height", "10"}}}}), folder);
  CHECK(most.summary.buildings == 0);
  CHECK(most.summary.left_out.at(gaps) == 1);
  CHECK(most.summary.warnings.at(0).find("only a part of 1 outline, as little as 69.9% of way_5") != std::string::npos);
  const Imported slab =
      import_text(house_with({{rectangle(1, 1, 29, 29), {{"height", "22"}, {"min_height", "19"}}}}), folder);
  CHECK(slab.summary.buildings == 1);
  CHECK(std::abs(volume_m3(slab.scene, "way_") - (900 * 21 + 784 * 2)) < 50);
}

TEST_CASE("heights of a town by tags: roofs on levels, several values, layers below the ground") {
  OsmText map;
  const auto house = [&](double x, TagList tags) {
    tags.emplace_back("building", "yes");
    return "way_" + std::to_string(map.way(rectangle(x, 0, x + 10, 10), tags));
  };
  const std::string gabled = house(0, {{"building:levels", "2"}, {"roof:height", "5"}, {"roof:shape", "gabled"}});
  const std::string several = house(20, {{"building:levels", "2;3"}});
  house(40, {{"building:levels", "2"}, {"layer", "-1"}});
  house(60, {{"building:levels", "0"}, {"building:levels:underground", "2"}});
  const std::string cellar =
      house(80, {{"building:levels", "4"}, {"building:levels:underground", "2"}, {"building:min_level", "-2"}});
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(map.text(), folder);
  CHECK(top_m(scene, gabled) == 11);
  CHECK(top_m(scene, several) == 9);
  CHECK(top_m(scene, cellar) == 12);
  CHECK(bottom_m(scene, cellar) == -1);
  CHECK(summary.buildings == 3);
  CHECK(summary.left_out == std::map<std::string, uint64_t>{{"underground: its layer is below 0", 1},
                                                            {"underground: all of its levels are", 1}});
  CHECK(summary.guessed.at("several values of levels: the largest is used") == 1);
}
