// SPDX-License-Identifier: Apache-2.0
// Keys of [trace] that need another key: those that ask for paths are refused without it, settings are named.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "config/contradictions.hpp"
#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

namespace {

std::vector<std::string> idle(const std::string& keys) {
  return config::idle_settings(parse_config(scene + keys + ends, "a.toml"));
}

const std::string target =
    "[[target_model]]\nname = \"ball\"\nrcs_dbsm = [0]\n"
    "[[target]]\nname = \"a\"\nmodel = \"ball\"\nposition_m = [1, 2, 3]\n";

}  // namespace

TEST_CASE("what asks for paths of a kind that is off is refused") {
  const auto check = [](const std::string& key, const std::string& need, const std::string& with,
                        const std::string& after = {}) {
    CAPTURE(key);
    const std::string line = "trace." + key + "\n";
    check_contains(error_of(scene + line + ends), "trace." + key + " has no effect without " + need);
    CHECK(error_of(scene + line + with + ends + after) == "no error");
  };
  const std::string edges = "trace.diffraction = true\n", tiles = "trace.scattering = true\n";
  check("diffraction_floor_db = -150", "trace.diffraction = true", edges);
  check("edge_ends = true", "trace.diffraction = true", edges);
  check("scattering_reflections = 1", "trace.scattering = true", tiles);
  check("scattering_floor_db = -150", "trace.scattering = true and trace.scattering_reflections of at least 1",
        tiles + "trace.scattering_reflections = 1\n");
  check("target_reflections = 1", "a [[target]], or a [[target_model]] with on", "", target);
  check("target_floor_db = -150", "a [[target]], or a [[target_model]] with on", "", target);
  check("target_diffraction = true", "a [[target]], or a [[target_model]] with on",
        edges + "trace.target_reflections = 1\n", target);
}

TEST_CASE("a floor of scattering that has no reflections says so, at its line") {
  check_contains(error_of(scene + "trace.scattering = true\ntrace.scattering_floor_db = -150\n" + ends), "a.toml:3");
}

TEST_CASE("settings of features that are off are named, and nothing else") {
  CHECK(idle("") == std::vector<std::string>{});
  const auto check = [](const std::string& key, const std::string& need, const std::string& with) {
    CAPTURE(key);
    const std::string line = "trace." + key + "\n";
    CHECK(idle(line) == std::vector<std::string>{"trace." + key + " has no effect without " + need});
    CHECK(idle(line + with) == std::vector<std::string>{});
  };
  check("max_diffractions = 2", "trace.diffraction = true", "trace.diffraction = true\n");
  check("free_edges = false", "trace.diffraction = true", "trace.diffraction = true\n");
  check("edge_rays = 3000", "trace.diffraction = true", "trace.diffraction = true\n");
  check("diffraction_rays = 3000",
        "trace.diffraction = true, trace.scattering_reflections or trace.target_reflections of at least 1",
        "trace.diffraction = true\n");
  check("max_transmissions = 3", "trace.transmission = true", "trace.transmission = true\n");
  check("tile_m = 2", "trace.scattering = true", "trace.scattering = true\n");
  check("recall = 0.999", "trace.rays = \"auto\"", "trace.rays = \"auto\"\n");
  check("max_rays = 1000000", "trace.rays = \"auto\"", "trace.rays = \"auto\"\n");
  CHECK(idle("trace.forget_frames = 9\ntrace.reuse = false\n") ==
        std::vector<std::string>{"trace.forget_frames = 9 has no effect without trace.reuse = true"});
  CHECK(idle("trace.refresh_rays = 9\ntrace.reuse = false\n").size() == 1);
  CHECK(idle("trace.sphere_radius_m = 2\n").size() == 1);
}

TEST_CASE("keys of targets that are switched off are named") {
  const std::string keys = "trace.target = false\ntrace.target_reflections = 1\ntrace.target_floor_db = -150\n";
  const auto found = config::idle_settings(parse_config(scene + keys + ends + target, "a.toml"));
  CHECK(found == std::vector<std::string>{"trace.target_reflections = 1 has no effect without trace.target = true",
                                          "trace.target_floor_db = -150 has no effect without trace.target = true"});
}
