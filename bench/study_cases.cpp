// SPDX-License-Identifier: Apache-2.0
// The twenty cases: each has a scene, a depth, and the places of its ends.
// Heights are those of cars, masts, drones and rooms; receivers stand around the first transmitter, as in real links.
#include "study_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "box_scene.hpp"
#include "open_places.hpp"
#include "scene/load.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;
using glm::dvec3;

constexpr double car_m = 1.5, drive_m = 9, frame_s = 0.1;

struct Places {
  std::vector<dvec3> transmitters, receivers;
};

struct Recipe {
  std::string name;
  uint32_t depth;
  std::function<SceneConfig(const fs::path& shared, const fs::path& folder)> scene;
  std::function<Places(OpenPlaces&)> places;
};

// Two transmitters in the inner part of the scene, receivers near the first one and anywhere.
struct Streets {
  double inner = 0.7, transmitter_m = car_m, reach_m = 200;
  size_t near = 40, far = 8;
  bool drone = false;  // the first transmitter hovers over the roofs

  Places operator()(OpenPlaces& draw) const {
    const Area middle = middle_of(draw.area(), inner);
    Places out{{draw.open(middle, transmitter_m), draw.open(middle, transmitter_m)}, {}};
    if (drone) out.transmitters[0].z = draw.upper_m().z + 5;
    for (size_t i = 0; i < near + far; ++i)
      out.receivers.push_back(draw.open(i < near ? around(out.transmitters[0], reach_m) : middle, car_m));
    return out;
  }
};

Places canyon(OpenPlaces& draw) {
  const Area area = draw.area();
  Places out;
  for (int i = 0; i < 2; ++i) out.transmitters.push_back(draw.open(area, car_m));
  for (int i = 0; i < 24; ++i) out.receivers.push_back(draw.open(area, car_m));
  return out;
}

// Ends are anywhere in the inner six tenths.
Places room(OpenPlaces& draw) {
  const dvec3 lower = 0.8 * draw.lower_m() + 0.2 * draw.upper_m(), upper = 0.2 * draw.lower_m() + 0.8 * draw.upper_m();
  Places out{{draw.within(lower, upper)}, {}};
  for (int i = 0; i < 6; ++i) out.receivers.push_back(draw.within(lower, upper));
  return out;
}

// Makes four storeys of slabs and columns on wide ground.
BoxScene park_scene() {
  BoxScene out;
  for (int slab = 0; slab < 5; ++slab) out.box({0, 0, 3 * slab}, {60, 30, 0.3});
  for (int x = -24; x <= 24; x += 12)
    for (int y = -10; y <= 10; y += 10) out.box({x, y, 6}, {0.5, 0.5, 12});
  out.box({0, 0, -0.5}, {300, 300, 0.5});
  return out;
}

Places park(OpenPlaces& draw) {
  constexpr double first_m = 1.65, storey_m = 3;
  const auto on = [&](double level) {
    return draw.within({-28, -13, first_m + storey_m * level}, {28, 13, first_m + storey_m * level});
  };
  Places out{{on(0), on(1)}, {}};
  for (int i = 0; i < 16; ++i) out.receivers.push_back(on(i % 3));
  return out;
}

// Makes a deck on piers along a street, between houses.
BoxScene bridge_scene() {
  BoxScene out;
  out.box({0, 0, -0.5}, {400, 400, 1});
  out.box({0, 0, 6.5}, {240, 14, 1});
  for (int x = -80; x <= 80; x += 40) out.box({x, 0, 3}, {1.5, 10, 6});
  for (int x = -90; x <= 90; x += 60)
    for (int y = -40; y <= 40; y += 80) out.box({x, y, 9}, {40, 20, 18});
  return out;
}

Places bridge(OpenPlaces& draw) {
  const auto lane = [&](double y) { return draw.within({-100, y, car_m}, {100, y + 4, car_m}); };
  const auto deck = [&] { return draw.within({-100, -5, 7 + car_m}, {100, 5, 7 + car_m}); };
  Places out{{lane(18), deck()}, {}};
  for (int i = 0; i < 12; ++i) out.receivers.push_back(lane(i % 2 ? 18 : -22));
  for (int i = 0; i < 6; ++i) out.receivers.push_back(deck());
  return out;
}

// Uses + * / only, so it is the same on every machine: a hill 60 m high, some 120 m wide.
double hill_m(glm::dvec2 p) {
  const double wide = 1 + (p.x * p.x + p.y * p.y) / (150.0 * 150.0);
  return 60 / (wide * wide);
}

BoxScene hill_scene() {
  BoxScene out;
  out.height_field(600, 39, hill_m);
  for (int x = -250; x <= 250; x += 50)
    for (int y = -250; y <= 250; y += 50) out.box({x, y, hill_m({x, y}) + 2}, {18, 14, 16});
  return out;
}

// Returns a wave of period 1 and height 1, with the same operations.
double wave(double t) {
  const double s = t - std::floor(t);
  return 16 * s * s * (1 - s) * (1 - s);
}

// Makes hills of this height, some 200 m wide, with houses all over them; 0: the same houses on flat ground.
std::function<BoxScene()> hills_scene(double height_m) {
  return [=] {
    const auto ground_m = [=](glm::dvec2 p) {
      return height_m *
             (0.7 * wave(p.x / 430 + 0.13) * wave(p.y / 510 + 0.4) + 0.3 * wave((p.x + 2 * p.y) / 620 + 0.3));
    };
    BoxScene out;
    out.height_field(600, 39, ground_m);
    for (int x = -250; x <= 250; x += 50)
      for (int y = -250; y <= 250; y += 50) out.box({x, y, ground_m({x, y}) + 2}, {18, 14, 16});
    return out;
  };
}

Places hill(OpenPlaces& draw) {
  return Streets{.inner = 0.75, .transmitter_m = 2, .reach_m = 200, .near = 32, .far = 8}(draw);
}

// Makes a town of 64 houses on a plain of 100 km.
BoxScene plain_scene() {
  BoxScene out;
  out.box({0, 0, -0.5}, {100000, 100000, 1});
  for (int i = -4; i < 4; ++i)
    for (int k = -4; k < 4; ++k) {
      const double height_m = 10 + (7 * i + 3 * k + 40) % 15;
      out.box({50 * i + 25, 50 * k + 25, height_m / 2}, {28 + (i + 4) % 5, 27 + (k + 4) % 7, height_m});
    }
  return out;
}

// An antenna in the sky over the plain, and receivers in the streets of the town.
std::function<Places(OpenPlaces&)> sky(const dvec3& antenna_m) {
  return [=](OpenPlaces& draw) {
    Places out{{antenna_m}, {}};
    for (int i = 0; i < 16; ++i)
      out.receivers.push_back(i % 2 ? draw.within({-190, -4, car_m}, {190, 4, car_m})
                                    : draw.within({-4, -190, car_m}, {4, 190, car_m}));
    return out;
  };
}

std::function<SceneConfig(const fs::path&, const fs::path&)> city(const std::string& options) {
  return [=](const fs::path&, const fs::path&) {
    SceneConfig out;
    out.generate = options;
    return out;
  };
}

std::function<SceneConfig(const fs::path&, const fs::path&)> shared_scene(const std::string& name) {
  return [=](const fs::path& shared, const fs::path&) {
    SceneConfig out;
    out.file = (shared / "scenes" / name / (name + ".xml")).string();
    if (!fs::exists(out.file)) throw InputError(fmt::format("{} is not there; --shared names its folder", out.file));
    return out;
  };
}

std::function<SceneConfig(const fs::path&, const fs::path&)> own(const std::string& name,
                                                                 const std::function<BoxScene()>& build) {
  return [=](const fs::path&, const fs::path& folder) {
    SceneConfig out;
    out.file = (folder / (name + ".obj")).string();
    out.default_material = "concrete";
    build().write(out.file);
    return out;
  };
}

const std::vector<Recipe>& recipes() {
  const Streets mast{.transmitter_m = 6}, munich{.inner = 0.6, .reach_m = 150, .near = 40, .far = 8};
  const Streets low_mast{.inner = 0.6, .transmitter_m = 5, .reach_m = 150, .near = 40, .far = 8};
  static const std::vector<Recipe> list = {
      {"city_a", 5, city("--seed 11 --blocks 6x6"), Streets{}},
      {"city_b", 6, city("--seed 12 --blocks 8x8 --block-m 60 --street-m 14 --floors 4:6"), Streets{}},
      {"city_c", 5, city("--seed 13 --blocks 4x4 --block-m 140 --street-m 40 --floors 2:4"), Streets{}},
      {"city_d", 8, city("--seed 14 --blocks 10x10 --block-m 65 --street-m 14 --floors 3:5"), Streets{}},
      {"towers", 5, city("--seed 15 --blocks 6x6 --block-m 80 --street-m 25 --floors 10:40"), mast},
      {"mast", 5, city("--seed 16 --blocks 6x6 --floors 3:6"), mast},
      {"low", 6, city("--seed 17 --blocks 8x8 --block-m 60 --street-m 15 --floors 1:2"), Streets{}},
      {"drone", 4, city("--seed 18 --blocks 5x5 --floors 3:9"), Streets{.drone = true}},
      {"wide", 8, city("--seed 19 --blocks 3x3 --block-m 200 --street-m 60 --floors 5:9"), Streets{}},
      {"munich_0", 5, shared_scene("munich"), munich},
      {"munich_1", 5, shared_scene("munich"), low_mast},
      {"munich_2", 7, shared_scene("munich"), munich},
      {"munich_3", 8, shared_scene("munich"), munich},
      {"canyon", 8, shared_scene("simple_street_canyon"), canyon},
      {"canyon_cars", 6, shared_scene("simple_street_canyon_with_cars"), canyon},
      {"room", 6, shared_scene("box"), room},
      {"room_screens", 5, shared_scene("box_two_screens"), room},
      {"park", 5, own("park", park_scene), park},
      {"bridge", 5, own("bridge", bridge_scene), bridge},
      {"hill", 5, own("hill", hill_scene), hill},
      {"hills_0", 5, own("hills_0", hills_scene(0)), hill},
      {"hills_10", 5, own("hills_10", hills_scene(10)), hill},
      {"hills_30", 5, own("hills_30", hills_scene(30)), hill},
      {"hills_100", 5, own("hills_100", hills_scene(100)), hill},
      {"plain_1", 3, own("plain_1", plain_scene), sky({1000, 600, 700})},
      {"plain_4", 3, own("plain_4", plain_scene), sky({3000, 1700, 2000})},
      {"plain_16", 3, own("plain_16", plain_scene), sky({12000, 7000, 8000})},
      {"plain_40", 3, own("plain_40", plain_scene), sky({30000, 17000, 20000})}};
  return list;
}
constexpr size_t study_cases = 20;  // the other recipes are hills and plains

std::vector<RadioEnd> ends(const char* prefix, const std::vector<dvec3>& points) {
  std::vector<RadioEnd> out;
  for (const dvec3& p : points)
    out.push_back({.name = fmt::format("{}{}", prefix, out.size()), .position_m = {p.x, p.y, p.z}});
  return out;
}

}  // namespace

std::vector<std::string> study_case_names() {
  std::vector<std::string> out;
  for (size_t i = 0; i < study_cases; ++i) out.push_back(recipes()[i].name);
  return out;
}

std::vector<std::string> further_case_names() {
  std::vector<std::string> out;
  for (size_t i = study_cases; i < recipes().size(); ++i) out.push_back(recipes()[i].name);
  return out;
}

StudyCase study_case(const std::string& name, const fs::path& shared, const fs::path& folder, uint64_t seed) {
  const auto recipe = std::find_if(recipes().begin(), recipes().end(), [&](const Recipe& r) { return r.name == name; });
  if (recipe == recipes().end()) throw ConfigError(fmt::format("there is no case '{}'; --help names them", name));
  StudyCase out{.name = name, .config = {}, .starts_m = {}};
  out.config.scene = recipe->scene(shared, folder);
  out.config.radio.frequency_hz = 5.9e9;
  out.config.trace.max_depth = recipe->depth;
  const Scene scene = load_scene(out.config);
  // Each case draws from its own stream, so that a case alone has the same places as among all cases; the others share
  // one stream.
  const auto stream = std::min<uint64_t>(static_cast<uint64_t>(recipe - recipes().begin()), study_cases);
  OpenPlaces draw(scene, seed * 1000 + stream);
  const Places places = recipe->places(draw);
  out.config.transmitters = ends("tx", places.transmitters);
  out.config.receivers = ends("rx", places.receivers);
  for (const dvec3& end : places.transmitters) {
    const dvec3 start = draw.free_start(end, drive_m);
    out.starts_m.push_back({start.x, start.y, start.z});
  }
  return out;
}

Config driving(const StudyCase& study_case, uint32_t frames) {
  Config out = study_case.config;
  const double end_s = (frames - 1) * frame_s;
  out.transmitters.clear();
  out.vehicle_types = {{.name = "antenna", .model = "none", .length_m = 1, .width_m = 1, .height_m = 1}};
  out.mounts = {{.name = "tx", .role = "transmitter"}};
  out.time.step_s = frame_s;
  for (size_t i = 0; i < study_case.starts_m.size(); ++i) {
    const auto &from = study_case.starts_m[i], &to = study_case.config.transmitters[i].position_m;
    out.tracks.push_back(
        {fmt::format("drive{}", i), "antenna", {{0, from[0], from[1], from[2]}, {end_s, to[0], to[1], to[2]}}});
  }
  return out;
}

}  // namespace wavetracer::bench
