// Gains of receivers that cross shadow boundaries in small steps: diffracted waves and those that end there are added
// as fields, so nothing jumps; the plain sum of powers does.
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
  // Of the source 40 deg before the face y = 0, the reflection ends at 220 deg and the line of sight at 140 deg.
  const double turn = std::acos(-1.0) * 40 / 180;
  const glm::dvec3 source{12 * std::cos(turn), -12 * std::sin(turn), 30.3};
  const FrameResult frame = run(at(file.path(), {source}, arc({0, 0, 30.1}, 15, 250, 110, 6001), 1));
  const Steps steps = largest_steps(frame);
  MESSAGE("largest step ", steps.grouped_db, " dB, of the sum of powers ", steps.powers_db, " dB");
  CHECK(steps.grouped_db < 0.05);
  CHECK(steps.powers_db > 3);
}
