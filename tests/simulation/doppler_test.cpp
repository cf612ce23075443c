// SPDX-License-Identifier: Apache-2.0
// Compares Doppler shifts with central differences of exact lengths, and with closed forms: moving ends through whole
// runs, moving reflectors through FieldModel. Two runs with displaced ends see the same surfaces, so paths are matched
// by them.
#include <map>
#include <optional>
#include <random>

#include "radio/fields.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double frequency_hz = 5.9e9, wavelength_m = speed_of_light / frequency_hz;

void move(RadioEnd& end, double seconds) {
  for (size_t axis = 0; axis < 3; ++axis) end.position_m[axis] += seconds * end.velocity_m_s[axis];
}

// Length by the surfaces of each path, in order from the transmitter.
std::map<std::vector<uint32_t>, double> lengths_after(Config config, double seconds) {
  move(config.transmitters[0], seconds);
  move(config.receivers[0], seconds);
  std::map<std::vector<uint32_t>, double> lengths;
  for (const Row& row : rows_of(run(config).paths, 0, 0)) lengths[row.surfaces] = row.delay_s * speed_of_light;
  return lengths;
}

// A plane that turns about a point and moves with it; in the axes of its instance it stays where it was.
struct Mirror {
  glm::dvec3 pivot{0}, velocity{0}, spin{0};  // spin: rad/s
  glm::dmat3 rotation{1.0};
  glm::dvec3 normal{0, 0, 1};  // in its own axes
  double offset = 0;

  // Rodrigues' formula, by columns.
  glm::dmat3 turned(double seconds) const {
    const double angle = glm::length(spin) * seconds;
    if (angle == 0) return rotation;
    const glm::dvec3 axis = glm::normalize(spin);
    glm::dmat3 turn(1.0);
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 e = glm::dmat3(1.0)[c];
      turn[c] = std::cos(angle) * e + std::sin(angle) * glm::cross(axis, e) +
                (1 - std::cos(angle)) * glm::dot(axis, e) * axis;
    }
    return turn * rotation;
  }
  double height(const glm::dvec3& p, double seconds) const {
    return glm::dot(p - (pivot + seconds * velocity), turned(seconds) * normal) - offset;
  }
  glm::dvec3 image(const glm::dvec3& p, double seconds) const {
    return p - 2 * height(p, seconds) * (turned(seconds) * normal);
  }
};

// Everything at 0 s; each mirror is an instance of a model of its own, whose one surface it is.
struct MovingWorld {
  EndState tx, rx;
  std::vector<Mirror> mirrors;

  double length(const std::vector<uint32_t>& sequence, double seconds) const {
    glm::dvec3 image = tx.position_m + seconds * tx.velocity_m_s;
    for (const uint32_t m : sequence) image = mirrors[m].image(image, seconds);
    return glm::distance(image, rx.position_m + seconds * rx.velocity_m_s);
  }
  double expected_hz(const std::vector<uint32_t>& sequence) const {
    constexpr double step_s = 1e-5;
    return -(length(sequence, step_s) - length(sequence, -step_s)) / (2 * step_s) / wavelength_m;
  }

  // Returns nothing if the planes have no such path, because legs at one of them would pass through it.
  std::optional<std::vector<glm::dvec3>> points(const std::vector<uint32_t>& sequence) const {
    std::vector<glm::dvec3> images{tx.position_m}, out(sequence.size());
    for (const uint32_t m : sequence) images.push_back(mirrors[m].image(images.back(), 0));
    glm::dvec3 target = rx.position_m;
    for (size_t k = sequence.size(); k-- > 0;) {
      const double from = mirrors[sequence[k]].height(images[k + 1], 0), to = mirrors[sequence[k]].height(target, 0);
      if (from * to >= 0) return {};
      target = out[k] = images[k + 1] + from / (from - to) * (target - images[k + 1]);
    }
    return out;
  }

  double computed_hz(const std::vector<uint32_t>& sequence) const {
    Scene scene;
    std::vector<Scene> models;
    std::vector<Instance> instances;
    WorldState state;
    for (uint32_t m = 0; m < mirrors.size(); ++m) {
      const Mirror& mirror = mirrors[m];
      Scene& model = models.emplace_back();
      model.materials = {{.name = "metal", .c = 1e7}};
      model.surfaces.push_back({.normal = mirror.normal, .offset_m = mirror.offset});
      instances.push_back({.id = "", .type = "", .model = m, .first_surface = m});
      state.instances.push_back({mirror.pivot, mirror.rotation, mirror.velocity, mirror.spin});
    }
    state.transmitters = {tx};
    state.receivers = {rx};
    Config config;
    config.radio.frequency_hz = frequency_hz;
    config.transmitters.resize(1);
    config.receivers.resize(1);

    PathGeometry path;
    path.tx = path.rx = {0};
    path.first = {0, sequence.size()};
    path.surface = sequence;
    path.interaction.assign(sequence.size(), reflection);
    path.vertex = points(sequence).value();
    const Paths paths = FieldModel(scene, config, models, instances).compute(0, path, state);
    CHECK(paths.delay_s[0] * speed_of_light == doctest::Approx(length(sequence, 0)).epsilon(1e-12));
    return paths.doppler_hz[0];
  }

  void check(const std::vector<uint32_t>& sequence) const {
    const double expected = expected_hz(sequence);
    CAPTURE(expected);
    CHECK(std::abs(computed_hz(sequence) - expected) < 1e-4 + 1e-6 * std::abs(expected));
  }
};

// Four mirrors around the two ends, like the walls of a room.
MovingWorld room() {
  MovingWorld world;
  world.tx.position_m = {-2, 1, 0.5};
  world.rx.position_m = {3, -1.5, 1};
  for (const glm::dvec3& inwards : {glm::dvec3{-1, 0.1, 0}, {1, 0.2, 0.1}, {0.1, -1, 0.2}, {0, 0.1, 1}}) {
    Mirror mirror;
    mirror.normal = glm::normalize(inwards);
    mirror.pivot = -9.0 * mirror.normal + glm::dvec3{0.4, -0.7, 0.3};
    mirror.offset = -0.6;
    world.mirrors.push_back(mirror);
  }
  return world;
}

}  // namespace

TEST_CASE("moving ends in a box: every path's shift is that of its length") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = config_of(file.path(), {{1.37, 2.21, 1.55}}, {{6.13, 3.42, 0.87}}, 300000, 3);
  config.radio.frequency_hz = frequency_hz;
  config.transmitters[0].velocity_m_s = {21, -13, 2};
  config.receivers[0].velocity_m_s = {-17, 9, -1};
  const Paths paths = run(config).paths;
  REQUIRE(paths.size() == 63);
  constexpr double step_s = 1e-5;
  const auto before = lengths_after(config, -step_s), after = lengths_after(config, step_s);
  size_t matched = 0;
  double largest = 0;
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::vector<uint32_t> surfaces(
        paths.vertex_surface.begin() + static_cast<std::ptrdiff_t>(paths.vertex_offset[i]),
        paths.vertex_surface.begin() + static_cast<std::ptrdiff_t>(paths.vertex_offset[i + 1]));
    if (!before.contains(surfaces) || !after.contains(surfaces)) continue;
    const double expected = -(after.at(surfaces) - before.at(surfaces)) / (2 * step_s) / wavelength_m;
    CAPTURE(i);
    CHECK(std::abs(paths.doppler_hz[i] - expected) < 1e-4 + 1e-6 * std::abs(expected));
    largest = std::max(largest, std::abs(expected));
    ++matched;
  }
  CHECK(matched == paths.size());
  CHECK(largest > 500);
}

TEST_CASE("closed forms: head-on, broadside, an echo of oneself") {
  const SceneFile file({Quad{{50, -100, -100}, {0, 200, 0}, {0, 0, 200}}});
  Config config = config_of(file.path(), {{0, 0, 0}}, {{10, 0, 0}}, 10000, 1);
  config.radio.frequency_hz = frequency_hz;
  config.transmitters[0].velocity_m_s = {30, 0, 0};
  const Paths paths = run(config).paths;
  REQUIRE(paths.size() == 2);
  CHECK(paths.doppler_hz[0] == doctest::Approx(30 / wavelength_m).epsilon(1e-12));  // towards the receiver
  CHECK(paths.doppler_hz[1] == doctest::Approx(30 / wavelength_m).epsilon(1e-12));  // and towards the wall behind it
  config.transmitters[0].velocity_m_s = {0, 30, 0};
  CHECK(std::abs(run(config).paths.doppler_hz[0]) < 1e-9);
  config.transmitters[0].velocity_m_s = {0, 0, 0};
  config.receivers[0].velocity_m_s = {30, 0, 0};
  const Paths receding = run(config).paths;
  CHECK(receding.doppler_hz[0] == doctest::Approx(-30 / wavelength_m).epsilon(1e-12));  // away from the transmitter
  CHECK(receding.doppler_hz[1] == doctest::Approx(30 / wavelength_m).epsilon(1e-12));   // towards the wall
}

TEST_CASE("shifts do not touch anything else; ends that stand still have none") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = config_of(file.path(), {{1.37, 2.21, 1.55}}, {{6.13, 3.42, 0.87}}, 100000, 2);
  const Paths still = run(config).paths;
  for (const double shift : still.doppler_hz) {
    CHECK(shift == 0);
    CHECK_FALSE(std::signbit(shift));
  }
  config.receivers[0].velocity_m_s = {1, 2, 3};
  Paths moving = run(config).paths;
  CHECK(moving.doppler_hz != still.doppler_hz);
  moving.doppler_hz = still.doppler_hz;
  CHECK(identical(moving, still));
}

TEST_CASE("a mirror that comes nearer shifts its echo by twice its speed; one that slides shifts nothing") {
  MovingWorld world;
  world.mirrors.push_back({.pivot = {20, 0, 0}, .velocity = {-15, 4, 3}, .normal = {-1, 0, 0}});
  CHECK(world.computed_hz({0}) == doctest::Approx(2 * 15 / wavelength_m).epsilon(1e-12));
  world.mirrors[0].velocity = {0, 4, 3};
  CHECK(std::abs(world.computed_hz({0})) < 1e-9);
}

TEST_CASE("an end carried along with its mirror hears itself unshifted") {
  MovingWorld world;
  world.mirrors.push_back({.pivot = {20, 0, 0}, .velocity = {-15, 4, 3}, .normal = {-1, 0, 0}});
  world.tx.velocity_m_s = world.rx.velocity_m_s = {-15, 4, 3};
  CHECK(std::abs(world.computed_hz({0})) < 1e-9);
}

TEST_CASE("moving reflectors: every kind of motion, alone and in sequence, shifts as its length does") {
  MovingWorld still = room();
  CHECK(still.computed_hz({0, 1, 0}) == 0);

  MovingWorld translating = room();
  translating.mirrors[0].velocity = {-20, 5, 1};
  translating.check({0});
  CHECK(std::abs(translating.computed_hz({0})) > 100);
  CHECK(translating.computed_hz({1}) == 0);

  MovingWorld turning = room();
  turning.mirrors[0].spin = {0.2, -0.1, 0.7};
  turning.check({0});
  CHECK(std::abs(turning.computed_hz({0})) > 1);

  MovingWorld two = room();
  two.mirrors[0].velocity = {-20, 5, 1};
  two.mirrors[1].velocity = {3, 12, -2};
  two.mirrors[1].spin = {0.1, 0.3, -0.8};
  two.check({0, 1});
  two.check({1, 0});
  two.check({0, 1, 0, 1});
}

TEST_CASE("random worlds in which all moves and turns: every sequence that has a path, up to depth 4") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&](double size) { return size * glm::dvec3{number(random), number(random), number(random)}; };
  std::vector<std::vector<uint32_t>> sequences{{}};  // no mirror occurs twice in a row
  for (size_t k = 0; k < sequences.size() && sequences[k].size() < 4; ++k)
    for (uint32_t m = 0; m < 4; ++m) {
      if (!sequences[k].empty() && sequences[k].back() == m) continue;
      sequences.push_back(sequences[k]);
      sequences.back().push_back(m);
    }
  REQUIRE(sequences.size() == 1 + 4 + 12 + 36 + 108);
  std::vector<size_t> checked(5, 0);
  double largest = 0;
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    MovingWorld world = room();
    world.tx.position_m += vector(1);
    world.rx.position_m += vector(1);
    world.tx.velocity_m_s = vector(40);
    world.rx.velocity_m_s = vector(40);
    for (Mirror& mirror : world.mirrors) {
      mirror.spin = vector(1);
      mirror.rotation = mirror.turned(0.3);
      mirror.velocity = vector(40);
      mirror.spin = vector(1);
    }
    for (const std::vector<uint32_t>& sequence : sequences) {
      if (!world.points(sequence)) continue;
      world.check(sequence);
      ++checked[sequence.size()];
      largest = std::max(largest, std::abs(world.expected_hz(sequence)));
    }
  }
  for (const size_t count : checked) CHECK(count >= 20);
  CHECK(largest > 2000);
}
