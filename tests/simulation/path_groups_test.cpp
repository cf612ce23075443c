// SPDX-License-Identifier: Apache-2.0
// Tests gains of receivers that cross shadow boundaries in small steps: diffracted waves and waves that end at the
// boundary are added as fields, so the sum does not jump; the plain sum of powers does.
#include "radio/links.hpp"
#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double carrier_hz = 2e9;

struct Steps {
  double grouped_db = 0, powers_db = 0;  // the largest from one receiver to the next
};

std::vector<LinkFigures> figures(const FrameResult& frame) {
  return link_figures(frame.paths, frame.frame, frame.world.links, carrier_hz);
}

Steps largest_steps(const FrameResult& frame) {
  Steps out;
  const std::vector<LinkFigures> links = figures(frame);
  for (size_t i = 1; i < links.size(); ++i) {
    REQUIRE(links[i].paths > 0);
    out.grouped_db = std::max(out.grouped_db, std::abs(links[i].path_gain_db - links[i - 1].path_gain_db));
    out.powers_db = std::max(out.powers_db, std::abs(links[i].sum_of_powers_db - links[i - 1].sum_of_powers_db));
  }
  return out;
}

Config at(const std::filesystem::path& scene, const Points& transmitters, const Points& receivers, uint32_t depth) {
  Config config = config_of(scene, transmitters, receivers, 20000, depth);
  config.trace = diffracting(20000, depth);
  config.radio.frequency_hz = carrier_hz;
  for (auto* ends : {&config.transmitters, &config.receivers})
    for (RadioEnd& end : *ends) end.polarization = "V";
  return config;
}

// Points on an arc about a vertical line, degrees from +x towards +y.
Points arc(const glm::dvec3& centre, double radius_m, double from_deg, double to_deg, size_t count) {
  Points out;
  for (size_t i = 0; i < count; ++i) {
    const double turn = (from_deg + (to_deg - from_deg) * static_cast<double>(i) / static_cast<double>(count - 1)) *
                        std::acos(-1.0) / 180;
    out.push_back(centre + radius_m * glm::dvec3(std::cos(turn), std::sin(turn), 0));
  }
  return out;
}

// A metal tower whose corner stands at the origin; tx sees the faces y = 0 and, if it is there, x = 0.
std::vector<Quad> tower() { return house({{0, 0}, {20, 0}, {20, 20}, {0, 20}}, 60, {{0, 1, 2, 3}}); }

}  // namespace

TEST_CASE("around the corner of a tower: the gain is continuous where the reflection ends, and where the sight does") {
  const SceneFile file(tower());
  // The source is 40 deg before the face y = 0: its reflection ends at 220 deg and the line of sight at 140 deg.
  const double turn = std::acos(-1.0) * 40 / 180;
  const glm::dvec3 source{12 * std::cos(turn), -12 * std::sin(turn), 30.3};
  const FrameResult frame = run(at(file.path(), {source}, arc({0, 0, 30.1}, 15, 250, 110, 6001), 1));
  const Steps steps = largest_steps(frame);
  MESSAGE("largest step ", steps.grouped_db, " dB, of the sum of powers ", steps.powers_db, " dB");
  CHECK(steps.grouped_db < 0.05);
  CHECK(steps.powers_db > 3);
}

TEST_CASE("the other way round the gain is the same") {
  const SceneFile file(tower());
  const Points source{{9.2, -7.7, 30.3}}, around = arc({0, 0, 30.1}, 15, 250, 110, 301);
  const std::vector<LinkFigures> there = figures(run(at(file.path(), source, around, 2)));
  const std::vector<LinkFigures> back = figures(run(at(file.path(), around, source, 2)));
  REQUIRE(there.size() == back.size());
  size_t joined = 0;
  for (size_t i = 0; i < there.size(); ++i) {
    CHECK(there[i].path_gain_db == doctest::Approx(back[i].path_gain_db).epsilon(1e-9));
    joined += std::abs(there[i].path_gain_db - there[i].sum_of_powers_db) > 0.1;
  }
  CHECK(joined > 20);
}

TEST_CASE("through a pane of glass: the wave that passes it beside its edge is one with what the edge diffracts") {
  const SceneFile file({Part{{{{0, 0, 0}, {20, 0, 0}, {0, 0, 60}}}, "glass"}});
  Config config = at(file.path(), {{-3.1, -8.3, 30.3}}, arc({0, 0, 30.1}, 15, 110, 30, 8001), 1);
  config.trace.transmission = true;
  const Steps steps = largest_steps(run(config));
  MESSAGE("largest step ", steps.grouped_db, " dB, of the sum of powers ", steps.powers_db, " dB");
  CHECK(steps.grouped_db < 0.05);
  CHECK(steps.powers_db > 1);
}

TEST_CASE("past two edges: what the second one diffracts is one with the wave that the first one does") {
  // Two screens; the source is deep in the shadow of the first, whose wave the second one cuts off.
  const std::vector<Quad> screens{{{0, 0, 0}, {20, 0, 0}, {0, 0, 60}}, {{-2, 9, 0}, {-20, 0, 0}, {0, 0, 60}}};
  const SceneFile file(screens);
  Config config = at(file.path(), {{9.3, -6.1, 30.3}}, arc({-2, 9, 30.1}, 12, 88, 112, 3001), 2);
  config.trace.max_diffractions = 2;
  const Steps steps = largest_steps(run(config));
  MESSAGE("largest step ", steps.grouped_db, " dB, of the sum of powers ", steps.powers_db, " dB");
  CHECK(steps.grouped_db < 0.05);
  CHECK(steps.powers_db > 3);
}

TEST_CASE("two waves without edges are never one, whatever is diffracted beside them; squares of weights add up to 1") {
  const SceneFile file({Part{two_boxes()}});
  Config config = at(file.path(), {{-11.3, -5.7, 1.6}}, arc({0.9, 1, 2}, 12, 0, 350, 24), 3);
  config.trace.max_diffractions = 2;
  const Paths paths = run(config).paths;
  REQUIRE(paths.group.size() == paths.size());
  std::map<std::pair<uint32_t, uint32_t>, size_t> waves;
  size_t joined = 0;
  for (size_t i = 0; i < paths.size(); ++i) {
    double squares = 0;
    for (const double weight : paths.group_weight[i]) squares += weight * weight;
    CHECK(squares == doctest::Approx(1).epsilon(1e-12));
    bool bends = false;
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
      bends |= paths.vertex_interaction[k] == diffraction;
    joined += paths.group[i][1] != no_group;
    if (bends) continue;
    CHECK(paths.group[i][1] == no_group);
    CHECK(++waves[{paths.rx[i], paths.group[i][0]}] == 1);
  }
  CHECK(joined > 10);
}

TEST_CASE("a tower that drives: edges and faces of an instance, turned, in a frame of its own") {
  const SceneFile still(tower()), far(std::vector<Quad>{{{500, 500, 0}, {20, 0, 0}, {0, 20, 0}}});
  const glm::dvec3 source{9.2, -7.7, 30.3};
  const Points around = arc({0, 0, 30.1}, 15, 250, 110, 301);
  const std::vector<LinkFigures> expected = figures(run(at(still.path(), {source}, around, 1)));
  const double turn = std::acos(-1.0) / 5;
  const glm::dmat3 rotation(std::cos(turn), std::sin(turn), 0, -std::sin(turn), std::cos(turn), 0, 0, 0, 1);
  const auto moved = [&](const glm::dvec3& p) { return rotation * p + glm::dvec3(3, -4, 0); };
  Points there;
  for (const glm::dvec3& p : around) there.push_back(moved(p));
  Config config = at(far.path(), {moved(source)}, there, 1);
  config.vehicle_types = {{"tower", still.path().string()}};
  config.parked = {{.name = "it", .file = "", .places = {{3, -4, 0, 36}}, .type = "tower"}};
  const std::vector<LinkFigures> links = figures(run(config));
  REQUIRE(links.size() == expected.size());
  for (size_t i = 0; i < links.size(); ++i) {
    CAPTURE(i);
    CHECK(links[i].paths == expected[i].paths);
    CHECK(links[i].path_gain_db == doctest::Approx(expected[i].path_gain_db).epsilon(1e-5));
  }
}
