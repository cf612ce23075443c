// SPDX-License-Identifier: Apache-2.0
// Paths around corners of houses in plan, over three and more edges, against all ways past the corners of the plan; and
// around a tower and over a wall behind it, against bisection.
#include <limits>
#include <numbers>

#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Plan = std::vector<glm::dvec2>;

double turn_of(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

// A yard that is open at one side, its walls 1 m thick: corners 4 and 5 are those of the yard, all others stand out.
Plan yard(double width, double depth, double turn) {
  const double half = 0.5 * width;
  Plan plan{{-half, 0},    {half, 0},     {half, depth},     {half - 1, depth},
            {half - 1, 1}, {1 - half, 1}, {1 - half, depth}, {-half, depth}};
  for (glm::dvec2& p : plan)
    p = {p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn)};
  return plan;
}

// Its walls and its roof, that of the back from side to side.
std::vector<Quad> walls_and_roof(const Plan& plan, double height) {
  const glm::dvec3 across(glm::normalize(plan[1] - plan[0]), 0), up{0, 0, height};
  const glm::dvec3 back(glm::normalize(plan[7] - plan[0]), 0), along(plan[7] - plan[0], 0);
  const glm::dvec3 left = glm::dvec3(plan[0], 0) + up;
  return house(plan, height, {}) + std::vector<Quad>{{left, glm::dvec3(plan[1] - plan[0], 0), back},
                                                     {left + back, across, along - back},
                                                     {glm::dvec3(plan[4], 0) + up, across, along - back}};
}

// Does the leg run through the inside of the plan? Legs along walls do not.
bool crosses(const Plan& plan, const glm::dvec2& p, const glm::dvec2& q) {
  for (int i = 1; i < 200; ++i) {
    const glm::dvec2 at = p + i / 200.0 * (q - p);
    bool inside = false;
    double nearest = 1;
    for (size_t k = 0; k < plan.size(); ++k) {
      const glm::dvec2 a = plan[k], b = plan[(k + 1) % plan.size()], way = b - a;
      if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / way.y * way.x) inside = !inside;
      const double u = std::clamp(glm::dot(at - a, way) / glm::dot(way, way), 0.0, 1.0);
      nearest = std::min(nearest, glm::distance(at, a + u * way));
    }
    if (inside && nearest > 1e-6) return true;
  }
  return false;
}

// The shortest way past corners at which it turns to this side only, by trying all of up to four corners; as corners.
void shortest_way(const Plan& plan, const glm::dvec2& b, double side, const Plan& way, double length, Plan& best,
                  double& least) {
  const bool turns = way.size() < 2 || side * turn_of(way.back() - way.end()[-2], b - way.back()) < 0;
  const double all = length + glm::distance(way.back(), b);
  if (all >= least) return;
  if (turns && !crosses(plan, way.back(), b)) {
    least = all;
    best = Plan(way.begin() + 1, way.end());
  }
  if (way.size() == 5) return;
  for (const size_t corner : {0, 1, 2, 3, 6, 7}) {
    const glm::dvec2 next = plan[corner];
    if (next == way.back() || crosses(plan, way.back(), next)) continue;
    if (way.size() > 1 && side * turn_of(way.back() - way.end()[-2], next - way.back()) >= 0) continue;
    Plan longer = way;
    longer.push_back(next);
    shortest_way(plan, b, side, longer, length + glm::distance(way.back(), next), best, least);
  }
}

Config between(const SceneFile& file, const glm::dvec3& a, const glm::dvec3& b, uint32_t edges) {
  Config config;
  config.scene.file = file.path().string();
  config.radio.frequency_hz = carrier_hz;
  config.transmitters = {{"tx", {a.x, a.y, a.z}}};
  config.receivers = {{"rx", {b.x, b.y, b.z}}};
  config.trace = diffracting(20000, 2);
  config.trace.max_diffractions = edges;
  return config;
}

// Returns the largest distance of the points of a path from the given ones, or infinity where it has more or fewer.
double off(const Paths& paths, size_t path, const Points& points) {
  if (paths.depth[path] != points.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (size_t k = 0; k < points.size(); ++k)
    most = std::max(most, glm::distance(paths.vertex_position_m[paths.vertex_offset[path] + k], points[k]));
  return most;
}

double nearest(const Paths& paths, const Points& points) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < paths.size(); ++i) least = std::min(least, off(paths, i, points));
  return least;
}

// Corners as points: a wave around upright edges rises as it goes on.
Points raised(const Plan& corners, const glm::dvec3& a, const glm::dvec3& b) {
  std::vector<double> before;
  double length = 0;
  glm::dvec2 from(a);
  for (const glm::dvec2& p : corners) before.push_back(length += glm::distance(from, p)), from = p;
  length += glm::distance(from, glm::dvec2(b));
  Points out;
  for (size_t i = 0; i < corners.size(); ++i) out.emplace_back(corners[i], a.z + (b.z - a.z) * before[i] / length);
  return out;
}

}  // namespace

TEST_CASE("into a yard around three corners, left and right, where the roofs are high") {
  size_t with_three = 0;
  for (const double turn : {0.3, 1.7, 3.9, 5.5}) {
    CAPTURE(turn);
    const Plan plan = yard(11 + turn, 9 + 0.3 * turn, turn);
    const SceneFile file(ground + walls_and_roof(plan, 33));
    const auto place = [&](double along, double into, double z) {
      return glm::dvec3(along * glm::normalize(plan[1] - plan[0]) + into * glm::normalize(plan[7] - plan[0]), z);
    };
    const glm::dvec3 a = place(0.7, -8.1, 2.3), b = place(-0.9, 2.4, 1.4);
    const Paths three = run(between(file, a, b, 3)).paths, two = run(between(file, a, b, 2)).paths;
    const Paths back = run(between(file, b, a, 3)).paths;
    for (const double side : {1.0, -1.0}) {
      Plan best;
      double least = std::numeric_limits<double>::infinity();
      shortest_way(plan, glm::dvec2(b), side, {glm::dvec2(a)}, 0, best, least);
      REQUIRE(best.size() == 3);
      const Points points = raised(best, a, b);
      CHECK(nearest(three, points) < 1e-6);
      CHECK(nearest(two, points) > 1);
      CHECK(nearest(back, Points(points.rbegin(), points.rend())) < 1e-6);
      ++with_three;
    }
  }
  CHECK(with_three == 8);
}

TEST_CASE("around two corners of a tower and over a wall behind it") {
  const SceneFile file(ground + turned_box({-3.1, -2.2}, 0.0, 5.3, 3.1, 40) +
                       std::vector<Quad>{{{-25, 9.3, 0}, {50, 0.7, 0}, {0, 0, 3.7}}});
  const glm::dvec3 a{-0.9, -9.4, 1.9}, b{0.3, 17.2, 1.3};
  const Paths paths = run(between(file, a, b, 3)).paths;
  for (const double x : {-3.1, 2.2}) {
    CAPTURE(x);
    Points points{{x, -2.2, 2}, {x, 0.9, 2}, {x, 9.6, 3.7}};
    const std::array<glm::dvec3, 3> along{glm::dvec3{0, 0, 1}, {0, 0, 1}, glm::normalize(glm::dvec3{50, 0.7, 0})};
    points[2].y = 9.3 + (x + 25) * 0.7 / 50;
    for (int sweep = 0; sweep < 4000; ++sweep)
      for (size_t i = 0; i < 3; ++i) {
        // Unfolded about the edge, the way is straight.
        const glm::dvec3 before = i == 0 ? a : points[i - 1], after = i == 2 ? b : points[i + 1];
        const double p = glm::dot(before - points[i], along[i]), q = glm::dot(after - points[i], along[i]);
        const double r = glm::length(before - points[i] - p * along[i]),
                     s = glm::length(after - points[i] - q * along[i]);
        points[i] += (p * s + q * r) / (r + s) * along[i];
      }
    CHECK(nearest(paths, points) < 1e-6);
  }
}

TEST_CASE("over both sides of a yard and a wall: five edges, or three of them where five are too many") {
  const SceneFile file(ground + walls_and_roof(yard(12, 10, 0), 8) +
                       std::vector<Quad>{{{16, -20, 0}, {0.3, 40, 0}, {0, 0, 5}}});
  const glm::dvec3 a{-20, 5.1, 1.5}, b{24, 4.7, 1.1};
  for (const uint32_t most : {3u, 4u, 5u, 8u}) {
    CAPTURE(most);
    const Paths paths = run(between(file, a, b, most)).paths;
    size_t over = 0;
    for (size_t i = 0; i < paths.size(); ++i) {
      const auto first = paths.vertex_position_m.begin() + static_cast<std::ptrdiff_t>(paths.vertex_offset[i]);
      const bool high = std::all_of(first, first + paths.depth[i], [](const glm::dvec3& p) { return p.z > 4.99; });
      if (high && paths.depth[i] == (most < 5 ? 3 : 5)) ++over;
      CHECK_FALSE((high && most > 4 && paths.depth[i] == 3));
    }
    CHECK(over == 1);
  }
}
