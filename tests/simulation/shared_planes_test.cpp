// SPDX-License-Identifier: Apache-2.0
// Tests that the plane between two edges counts as one plane, whatever surfaces it consists of: the same house in
// pieces has the same field.
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double same_db = 1e-9;

// Holds for each receiver how many paths reach it, and the power of those over two edges and of all, in dB, summed over
// all ports of both ends.
struct Reached {
  std::vector<size_t> paths;
  std::vector<double> twice_diffracted_db, power_db;
};

Reached reach(const std::vector<Part>& parts, const Points& transmitters, const Points& receivers,
              uint32_t max_depth = 2) {
  const SceneFile file(parts);
  Config config = config_of(file.path(), transmitters, receivers, 100000, max_depth);
  config.trace = diffracting(100000, max_depth);
  config.trace.max_diffractions = 2;
  const Paths paths = run(config).paths;
  Reached out{std::vector<size_t>(receivers.size()), std::vector<double>(receivers.size()),
              std::vector<double>(receivers.size())};
  for (size_t i = 0; i < paths.size(); ++i) {
    const auto first = paths.vertex_interaction.begin() + static_cast<ptrdiff_t>(paths.vertex_offset[i]);
    const bool twice = std::count(first, first + paths.depth[i], diffraction) == 2;
    ++out.paths[paths.rx[i]];
    for (const std::complex<double>& a : paths.a[i]) {
      out.power_db[paths.rx[i]] += std::norm(a);
      if (twice) out.twice_diffracted_db[paths.rx[i]] += std::norm(a);
    }
  }
  for (auto* powers : {&out.twice_diffracted_db, &out.power_db})
    for (double& power : *powers) power = 10 * std::log10(power);
  return out;
}

void check_same(const Reached& reached, const Reached& expected) {
  CHECK(reached.paths == expected.paths);
  for (size_t i = 0; i < expected.power_db.size(); ++i) {
    CAPTURE(i);
    CHECK(expected.twice_diffracted_db[i] > -300);
    CHECK(std::abs(reached.twice_diffracted_db[i] - expected.twice_diffracted_db[i]) < same_db);
    CHECK(std::abs(reached.power_db[i] - expected.power_db[i]) < same_db);
  }
}

// Makes a house of 20 x 10 x 8 m, closed, whose roof is the rectangles x0, y0, x1, y1.
std::vector<Quad> house_under(const std::vector<std::array<double, 4>>& roof) {
  std::vector<Quad> quads = reference::box_walls({-10, -5, 0}, {10, 5, 8});
  quads.pop_back();
  for (const auto& [x, y, end_x, end_y] : roof) quads.push_back({{x, y, 8}, {end_x - x, 0, 0}, {0, end_y - y, 0}});
  return quads;
}

const std::vector<Quad> solid = house_under({{-10, -5, 10, 5}});

// Makes the southern wall of three pieces that meet in a T; two of them meet the roof in another.
std::vector<Quad> pieces_of_wall() {
  std::vector<Quad> quads = solid;
  quads.erase(quads.begin() + 2);
  quads.insert(quads.end(), {{{-10, -5, 0}, {20, 0, 0}, {0, 0, 3}},
                             {{-10, -5, 3}, {13, 0, 0}, {0, 0, 5}},
                             {{3, -5, 3}, {7, 0, 0}, {0, 0, 5}}});
  return quads;
}

// Makes the same house in different ways; all materials are concrete.
std::vector<std::pair<std::string, std::vector<Part>>> ways_to_build() {
  const auto walls = [](const std::vector<Quad>& quads) { return std::vector(quads.begin(), quads.begin() + 5); };
  const auto part = [](std::vector<Quad> quads) { return Part{std::move(quads), "concrete"}; };
  const Quad south{{-10, -5, 8}, {20, 0, 0}, {0, 5, 0}}, north{{-10, 0, 8}, {20, 0, 0}, {0, 5, 0}};
  return {{"a T in the roof", {part(house_under({{-10, -5, 10, 0}, {-10, 0, 1, 5}, {1, 0, 10, 5}}))}},
          {"a T in a wall", {part(pieces_of_wall())}},
          {"two names of one material", {part(walls(solid) + std::vector{south}), part({north})}},
          {"two houses",
           {part(reference::box_walls({-10, -5, 0}, {10, 0, 8})), part(reference::box_walls({-10, 0, 0}, {10, 5, 8}))}},
          {"three houses of one material",
           {part(reference::box_walls({-10, -5, 0}, {10, 0, 8}) + reference::box_walls({-10, 0, 0}, {1, 5, 8}) +
                 reference::box_walls({1, 0, 0}, {10, 5, 8}))}},
          {"three houses of three names",
           {part(reference::box_walls({-10, -5, 0}, {10, -1, 8})), part(reference::box_walls({-10, -1, 0}, {10, 2, 8})),
            part(reference::box_walls({-10, 2, 0}, {10, 5, 8}))}}};
}

const Points before{{0.3, -25, 1.5}, {-17.2, -13.1, 6.9}}, behind{{-0.7, 22, 1.5}, {13.9, 15.3, 4.2}, {-3.1, 17, 11.7}};

glm::dvec3 placed(const glm::dmat4& place, const glm::dvec3& p) { return glm::dvec3(place * glm::dvec4(p, 1)); }

std::vector<Part> placed(const glm::dmat4& place, std::vector<Part> parts) {
  for (Part& part : parts)
    for (Quad& q : part.quads) q = {placed(place, q.corner), glm::dmat3(place) * q.u, glm::dmat3(place) * q.v};
  return parts;
}

// Rounds corners to float32: three of every quad, which say where the fourth is.
std::vector<Part> rounded(std::vector<Part> parts) {
  const auto round = [](const glm::dvec3& p) { return glm::dvec3(glm::vec3(p)); };
  for (Part& part : parts)
    for (Quad& q : part.quads) {
      const glm::dvec3 corner = round(q.corner);
      q = {corner, round(q.corner + q.u) - corner, round(q.corner + q.v) - corner};
    }
  return parts;
}

Points placed(const glm::dmat4& place, Points points) {
  for (glm::dvec3& p : points) p = placed(place, p);
  return points;
}

// Calls check(parts, place) for each way to build the house, turned and moved, upright and laid down.
void for_each_place(const glm::dvec3& moved,
                    const std::function<void(const std::vector<Part>&, const glm::dmat4&)>& check) {
  const glm::dmat4 move = glm::translate(glm::dmat4(1), moved);
  for (const glm::dvec3& axis : {glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(0.6, -0.3, 0.5))}) {
    const glm::dmat4 place = glm::rotate(move, 0.61, axis);
    for (const auto& [name, parts] : ways_to_build()) {
      CAPTURE(name);
      check(placed(place, parts), place);
    }
  }
}

}  // namespace

TEST_CASE("one house in pieces, of several names or made of several houses: the field of the one solid") {
  const Reached expected = reach({{solid, "concrete"}}, before, behind);
  for (const auto& [name, parts] : ways_to_build()) {
    CAPTURE(name);
    check_same(reach(parts, before, behind), expected);
  }
}

TEST_CASE("the same where the house is turned and moved, upright and laid down") {
  const Reached expected = reach({{solid, "concrete"}}, before, behind);
  for_each_place({1234.5, -777.1, 3.3}, [&](const std::vector<Part>& parts, const glm::dmat4& place) {
    check_same(reach(parts, placed(place, before), placed(place, behind)), expected);
  });
}

TEST_CASE("the same to 0.001 dB where all corners were rounded to float32, and planes are bent by 10^-7") {
  const Reached expected = reach({{solid, "concrete"}}, before, behind);
  for_each_place({123.4, -77.1, 3.3}, [&](const std::vector<Part>& parts, const glm::dmat4& place) {
    const Reached reached = reach(rounded(parts), placed(place, before), placed(place, behind));
    for (size_t i = 0; i < behind.size(); ++i) {
      CAPTURE(i);
      CHECK(std::abs(reached.twice_diffracted_db[i] - expected.twice_diffracted_db[i]) < 1e-3);
    }
  });
}

TEST_CASE("a sheet of two pieces: waves run along both of its sides, as along one") {
  const auto canopy = [](double seam) {
    return std::vector<Part>{{{{{-6, -4, 5}, {seam, 0, 0}, {0, 8, 0}}}, "concrete"},
                             {{{{seam - 6, -4, 5}, {12 - seam, 0, 0}, {0, 8, 0}}}, "concrete"},
                             {ground, "concrete"}};
  };
  const Part whole{{{{-6, -4, 5}, {12, 0, 0}, {0, 8, 0}}}, "concrete"};
  const Points above{{-15, 0.4, 9}}, below{{14, 0.9, 2}};
  check_same(reach(canopy(4), above, below), reach({whole, {ground, "concrete"}}, above, below));
}

TEST_CASE("an antenna 0.05 mm under a roof is on it, there and back, whatever the roof is made of") {
  const auto at = [](const std::vector<Part>& parts, double above_m) {
    return reach(parts, {{0.3, -1.7, 8 + above_m}}, behind);
  };
  const Reached expected = at({{solid, "concrete"}}, -5e-5);
  const Reached back = reach({{solid, "concrete"}}, behind, {{0.3, -1.7, 8 - 5e-5}});
  CHECK(std::ranges::none_of(expected.paths, [](size_t count) { return count == 0; }));
  CHECK(back.paths[0] == expected.paths[0] + expected.paths[1] + expected.paths[2]);
  // Rays of such an antenna stay in the house that they begin in, so houses that share the roof are not asked here.
  for (const auto& [name, parts] : ways_to_build()) {
    if (name.find("houses") != name.npos) continue;
    CAPTURE(name);
    check_same(at(parts, -5e-5), expected);
  }
}

TEST_CASE("a row of houses of unequal heights: the taller ones stand in the way along the lower ones' roofs") {
  // The solid has no walls between houses but for what stands out over the lower one: at its foot a leg along that
  // roof must not get into the house.
  const std::vector<double> heights{9, 12, 15, 12, 9, 15};
  std::vector<Quad> boxes, welded;
  for (size_t i = 0; i <= heights.size(); ++i) {
    const double x = 10.0 * static_cast<double>(i), height = i < heights.size() ? heights[i] : 0;
    const double other = i > 0 ? heights[i - 1] : 0;
    for (double z = 0; z < std::max(height, other); z = z == 0 ? 9 : z + 3) {
      const double up = z == 0 ? 9 : 3;
      if (z < height)
        for (const double y : {0.0, 12.0}) welded.push_back({{x, y, z}, {10, 0, 0}, {0, 0, up}});
      if ((z < height) != (z < other)) welded.push_back({{x, 0, z}, {0, 12, 0}, {0, 0, up}});
    }
    if (i == heights.size()) break;
    welded.push_back({{x, 0, height}, {10, 0, 0}, {0, 12, 0}});
    boxes = boxes + reference::box_walls({x, 0, 0}, {x + 10, 12, height});
  }
  const Points south{{-20, -15, 2}, {5, -15, 2}, {25, -15, 2}};
  Points north;
  for (int i = 0; i < 10; ++i) north.push_back({-15 + 10 * i, 26, 1.5});
  const Part street{{{{-150, -150, 0}, {300, 0, 0}, {0, 300, 0}}}, "concrete"};
  check_same(reach({{welded, "concrete"}, street}, south, north, 3),
             reach({{boxes, "concrete"}, street}, south, north, 3));
}

TEST_CASE("a leg across a courtyard or a street runs along no face") {
  // Two arms, 9 m apart, with or without what joins them in the north.
  const auto arms = [](bool joined) {
    const std::vector<glm::dvec2> plan = {{-10, -30}, {-4, -30}, {-4, 20}, {5, 20},
                                          {5, -30},   {11, -30}, {11, 26}, {-10, 26}};
    if (joined) {
      std::vector<Quad> quads = house(plan, 8, {});
      quads.insert(quads.end(), {{{-10, -30, 8}, {6, 0, 0}, {0, 50, 0}},
                                 {{5, -30, 8}, {6, 0, 0}, {0, 50, 0}},
                                 {{-10, 20, 8}, {6, 0, 0}, {0, 6, 0}},
                                 {{-4, 20, 8}, {9, 0, 0}, {0, 6, 0}},
                                 {{5, 20, 8}, {6, 0, 0}, {0, 6, 0}}});
      return std::vector<Part>{{quads, "concrete"}};
    }
    return std::vector<Part>{{reference::box_walls({-10, -30, 0}, {-4, 20, 8}), "concrete"},
                             {reference::box_walls({5, -30, 0}, {11, 20, 8}), "concrete"}};
  };
  // Only paths from deep in the court over both of its edges count.
  const auto across_db = [&](bool joined) {
    const SceneFile file(arms(joined));
    Config config = config_of(file.path(), {{-8, -14.2, 15}}, {{9, -13.1, 12}}, 100000, 2);
    config.trace = diffracting(100000, 2);
    config.trace.max_diffractions = 2;
    const Paths paths = run(config).paths;
    double power = 0;
    for (size_t i = 0; i < paths.size(); ++i) {
      if (paths.depth[i] != 2) continue;
      const glm::dvec3 &p = paths.vertex_position_m[paths.vertex_offset[i]],
                       &q = paths.vertex_position_m[paths.vertex_offset[i] + 1];
      if (std::abs(p.x + 4) > 1e-6 || std::abs(q.x - 5) > 1e-6 || std::abs(p.z - 8) > 1e-6) continue;
      for (const std::complex<double>& a : paths.a[i]) power += std::norm(a);
    }
    return 10 * std::log10(power);
  };
  CHECK(across_db(false) > -250);
  CHECK(std::abs(across_db(true) - across_db(false)) < same_db);
}

TEST_CASE("houses in pieces on a ground: the paths that brute force finds, over up to two edges") {
  TraceConfig trace = diffracting(200000, 2);
  trace.max_diffractions = 2;
  const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1), {3.1, -1.7, 0}), 0.37, {0, 0, 1});
  for (const auto& [name, parts] : ways_to_build()) {
    CAPTURE(name);
    std::vector<Part> on_ground = placed(place, parts);
    on_ground.push_back({ground, "concrete"});
    const SceneFile file(on_ground);
    CHECK(check_complete(file.path(), placed(place, before), placed(place, behind), trace) > 20);
  }
}
