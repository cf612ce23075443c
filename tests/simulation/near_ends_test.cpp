// SPDX-License-Identifier: Apache-2.0
// Tests antennas that touch a surface or each other: there is a result at any gap, the same in both directions, and a
// warning where a path is left out. Gaps range from zero, past the rounding of double and of float32, to lengths that
// both resolve.
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <ranges>

#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const std::vector<double> gaps_m{0, 1e-15, 1e-13, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 9e-5, 1.1e-4, 1e-3};
constexpr double limit_m = 1e-4;  // the limit of radio/fields.hpp

// A ground of `size` with a wall whose foot runs along y = 20, and a slanted roof; all turned and moved as one.
struct Place {
  double size_m = 120;
  glm::dquat turn{1, 0, 0, 0};
  glm::dvec3 offset_m{0};

  glm::dvec3 at(const glm::dvec3& p) const { return turn * p + offset_m; }
  SceneFile scene() const {
    std::vector<Quad> quads{{{-60, -60, 0}, {size_m, 0, 0}, {0, size_m, 0}},
                            {{-30, 20, 0}, {60, 0, 0}, {0, 0, 17}},
                            {{-30, 30, 8}, {60, 0, 0}, {0, -60, 12}}};
    for (Quad& q : quads) q = {at(q.corner), turn * q.u, turn * q.v};
    return SceneFile(quads);
  }
};

// Askew, and at coordinates where float32 rounds by 0.02 mm.
const std::vector<Place> places{{},
                                {.offset_m = {-33.3, 41.7, -7.7}},
                                {.turn = glm::normalize(glm::dquat(0.9, 0.2, -0.3, 0.1)), .offset_m = {1.1, 2.2, 3.3}},
                                {.size_m = 900, .offset_m = {10.1, 20.3, 0.7}}};

struct Ways {
  FrameResult there, back;
};

// Finds paths from each near end to the far one, and back.
Ways both_ways(const Place& place, const std::function<glm::dvec3(double gap_m)>& near, const glm::dvec3& far) {
  const SceneFile file = place.scene();
  Points ends;
  for (const double gap_m : gaps_m) ends.push_back(place.at(near(gap_m)));
  return {run(config_of(file.path(), ends, {place.at(far)}, 20000, 3)),
          run(config_of(file.path(), {place.at(far)}, ends, 20000, 3))};
}

// Checks that both directions have the same paths: of the same length, by the same surfaces in reversed order, with the
// coefficients of the other direction. On an edge, where points coincide, two orders of its surfaces are one path.
void check_reciprocal(const Ways& ways) {
  for (uint32_t near = 0; near < gaps_m.size(); ++near) {
    CAPTURE(gaps_m[near]);
    std::vector<Row> there = rows_of(ways.there.paths, near, 0), back = rows_of(ways.back.paths, 0, near);
    REQUIRE(there.size() == back.size());
    for (const Row& row : back) {
      const auto same = std::ranges::find_if(there, [&](const Row& r) {
        const bool on_edge = r.points.size() == 2 && glm::distance(r.points[0], r.points[1]) < 1e-6;
        return std::abs(r.delay_s - row.delay_s) <= 1e-12 * row.delay_s &&
               (std::ranges::equal(r.surfaces, row.surfaces | std::views::reverse) ||
                (on_edge && r.surfaces == row.surfaces));
      });
      REQUIRE(same != there.end());
      double size = 0, error = 0;
      for (size_t r = 0; r < 2; ++r)
        for (size_t t = 0; t < 2; ++t) {
          size += std::norm(row.a[2 * r + t]);
          error += std::norm(row.a[2 * r + t] - same->a[2 * t + r]);
        }
      CHECK(error <= 1e-12 * size);
    }
  }
}

bool reflects_first(const Row& row, uint32_t surface) { return !row.surfaces.empty() && row.surfaces[0] == surface; }

// Counts paths that first leave the surface that the near ends stand on: they exist if the gap is beyond the limit, and
// not below it.
void check_rule(const Ways& ways, size_t expected_others) {
  for (uint32_t near = 0; near < gaps_m.size(); ++near) {
    CAPTURE(gaps_m[near]);
    const std::vector<Row> rows = rows_of(ways.there.paths, near, 0);
    const auto others = [&](uint32_t surface) {
      return static_cast<size_t>(
          std::ranges::count_if(rows, [&](const Row& r) { return !reflects_first(r, surface); }));
    };
    // The surface underneath is the one whose reflected path is as long as the line of sight, to about two gaps.
    uint32_t underneath = 99;
    for (const Row& row : rows)
      if (row.surfaces.size() == 1 && (row.delay_s - rows[0].delay_s) * speed_of_light <= 2.1 * gaps_m[near])
        underneath = row.surfaces[0];
    CHECK((underneath != 99) == (gaps_m[near] > limit_m));
    CHECK(others(underneath) == expected_others);
  }
}

size_t left_out(const FrameResult& frame) {
  return static_cast<size_t>(std::ranges::count_if(
      frame.warnings, [](const std::string& text) { return text.find("left out, because") != text.npos; }));
}

}  // namespace

TEST_CASE("an antenna on the ground: the same channel both ways at any gap, and the rule of near ends") {
  for (const Place& place : places) {
    CAPTURE(place.offset_m.x);
    const Ways ways = both_ways(place, [](double gap_m) { return glm::dvec3(-5.2, 4.1, gap_m); }, {7.1, 3.3, 2.5});
    check_reciprocal(ways);
    check_rule(ways, rows_of(ways.there.paths, 0, 0).size());
    CHECK(rows_of(ways.there.paths, 0, 0).size() >= 3);
    CHECK(left_out(ways.there) == 1);
    CHECK(left_out(ways.back) == 1);
  }
}

TEST_CASE("an antenna beside a wall, on either side of it") {
  for (const Place& place : places)
    for (const double side : {-1.0, 1.0}) {
      CAPTURE(place.offset_m.x);
      CAPTURE(side);
      const Ways ways = both_ways(place, [&](double gap_m) { return glm::dvec3(-5.2, 20 + side * gap_m, 1.7); },
                                  {7.1, 20 + side * 8.3, 2.5});
      check_reciprocal(ways);
      check_rule(ways, rows_of(ways.there.paths, 0, 0).size());
    }
}

TEST_CASE("an antenna in the plane of a wall hears what is behind it, both ways alike, and nothing beyond 0.1 mm") {
  for (const Place& place : places) {
    CAPTURE(place.offset_m.x);
    const Ways ways =
        both_ways(place, [](double gap_m) { return glm::dvec3(-5.2, 20 - gap_m, 1.7); }, {7.1, 28.3, 2.5});
    check_reciprocal(ways);
    for (uint32_t near = 0; near < gaps_m.size(); ++near) {
      CAPTURE(gaps_m[near]);
      CHECK(rows_of(ways.there.paths, near, 0).empty() == (gaps_m[near] > 1e-4));
    }
  }
}

// Rays from there start below the ground, unless they are launched from both sides of it.
TEST_CASE("an antenna sunk into the ground hears what is above it, both ways alike, and nothing beyond 0.1 mm") {
  for (const Place& place : places) {
    CAPTURE(place.offset_m.x);
    const Ways ways = both_ways(place, [](double gap_m) { return glm::dvec3(-5.2, 4.1, -gap_m); }, {7.1, 3.3, 2.5});
    check_reciprocal(ways);
    for (uint32_t near = 0; near < gaps_m.size(); ++near) {
      CAPTURE(gaps_m[near]);
      const size_t paths = rows_of(ways.there.paths, near, 0).size();
      CHECK(paths == (gaps_m[near] <= 1e-4 ? rows_of(ways.there.paths, 0, 0).size() : 0));
    }
  }
}

TEST_CASE("in the corner of a wall and the ground") {
  for (const Place& place : places) {
    CAPTURE(place.offset_m.x);
    const Ways ways =
        both_ways(place, [](double gap_m) { return glm::dvec3(-5.2, 20 - gap_m, gap_m); }, {7.1, 12.3, 2.5});
    check_reciprocal(ways);
    const size_t least = rows_of(ways.there.paths, 0, 0).size();
    const auto last = static_cast<uint32_t>(gaps_m.size() - 1);
    CHECK(least >= 1);
    CHECK(rows_of(ways.there.paths, last, 0).size() > 2 * least);
  }
}

TEST_CASE("two antennas in one point or beside each other: no line of sight below the limit, and a warning says so") {
  for (const Place& place : places) {
    CAPTURE(place.offset_m.x);
    const glm::dvec3 far(7.1, 3.3, 2.5);
    const Ways ways = both_ways(
        place, [&](double gap_m) { return far + glm::dvec3(gap_m, 0, 0); }, far);
    check_reciprocal(ways);
    for (uint32_t near = 0; near < gaps_m.size(); ++near) {
      CAPTURE(gaps_m[near]);
      const std::vector<Row> rows = rows_of(ways.there.paths, near, 0);
      REQUIRE(!rows.empty());
      CHECK(rows[0].surfaces.empty() == (gaps_m[near] > limit_m));
    }
    REQUIRE(left_out(ways.there) == 1);
    const std::string& text = ways.there.warnings[0];
    CHECK_MESSAGE(text.find("9 paths are left out") == 0, text);
    CHECK(text.find("\"tx0\" -> \"rx0\" (1)") != text.npos);
    CHECK(text.find("and 5 more links") != text.npos);
  }
}
