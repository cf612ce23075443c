// SPDX-License-Identifier: Apache-2.0
// Compares a link over a flat ground, from the scene to both gains, with the two-ray formula with Fresnel's reflection.
// (J. D. Parsons, The Mobile Radio Propagation Channel, 2nd ed., section 2.3.)
#include "radio/links.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("two rays over 100 m at 1.6 m: the sum of powers is -85.5 dB, the coherent sum 18 dB below") {
  constexpr double frequency_hz = 5.9e9, height_m = 1.6, distance_m = 100, epsilon_0 = 8.8541878128e-12;
  constexpr double permittivity = 5.24, conductivity_s_m = 0.185;
  const SceneFile file({Part{{Quad{{-200, -200, 0}, {400, 0, 0}, {0, 400, 0}}}, "concrete"}});
  Config config = config_of(file.path(), {{0, 0, height_m}}, {{distance_m, 0, height_m}}, 100000, 2);
  config.radio.frequency_hz = frequency_hz;
  config.transmitters[0].polarization = config.receivers[0].polarization = "V";
  MaterialConfig ground;
  ground.name = "concrete";
  ground.permittivity = permittivity;
  ground.conductivity_s_m = conductivity_s_m;
  ground.thickness_m = std::numeric_limits<double>::infinity();
  config.materials = {ground};
  const FrameResult frame = run(config);
  REQUIRE(frame.paths.size() == 2);
  const LinkFigures link = link_figures(frame.paths, 0, frame.world.links, frequency_hz)[0];

  const double pi = std::acos(-1.0), lambda = speed_of_light / frequency_hz;
  const double reflected_m = std::hypot(distance_m, 2 * height_m);
  const double sine = 2 * height_m / reflected_m, cosine = distance_m / reflected_m;
  const std::complex<double> eta(permittivity, -conductivity_s_m / (2 * pi * frequency_hz * epsilon_0));
  const std::complex<double> root = std::sqrt(eta - cosine * cosine);
  const std::complex<double> fresnel = (eta * sine - root) / (eta * sine + root);  // vertical polarization
  const double direct = lambda / (4 * pi * distance_m), reflected = lambda / (4 * pi * reflected_m);
  const double powers = direct * direct + std::norm(fresnel) * reflected * reflected;
  const double coherent =
      std::norm(direct + fresnel * reflected * std::polar(1.0, -2 * pi * (reflected_m - distance_m) / lambda));
  CHECK(link.path_gain_db == doctest::Approx(10 * std::log10(powers)).epsilon(1e-7));
  CHECK(link.narrowband_gain_db == doctest::Approx(10 * std::log10(coherent)).epsilon(1e-5));
  CHECK(link.path_gain_db == doctest::Approx(-85.5).epsilon(0.002));
  CHECK(link.narrowband_gain_db == doctest::Approx(-103.8).epsilon(0.01));
}

TEST_CASE("a frame that is given up tells nothing, and the next one is as if it had never been") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = config_of(file.path(), {{1, 1, 1}}, {{6, 3, 2}}, 300000, 3);
  config.trace.batch_rays = 100000;
  Simulation simulation(config);
  std::vector<FrameProgress> seen;
  const auto observe = [&](size_t most) {
    seen.clear();
    simulation.observe([&seen, most](const FrameProgress& at) {
      seen.push_back(at);
      return seen.size() < most;
    });
  };
  observe(100);
  const FrameResult whole = simulation.run_frame(0);
  REQUIRE(seen.size() >= 5);
  CHECK(seen[0].stage.word() == "rays");
  CHECK(seen[0].done == 100000);
  CHECK(seen[2].done == 300000);
  CHECK(seen[2].total == 300000);
  CHECK(seen[3].stage.word() == "paths");
  for (const size_t most : {1, 2, 4}) {
    observe(most);
    CHECK_THROWS_AS(simulation.run_frame(0), FrameStopped);
    CHECK(seen.size() == most);
  }
  simulation.observe({});
  CHECK(simulation.run_frame(0).paths.delay_s == whole.paths.delay_s);
}
