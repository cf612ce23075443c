// SPDX-License-Identifier: Apache-2.0
// Permittivities against ITU-R P.2040-3, Table 3, worked by hand, and the range that a material is known in.
// sigma / (2 pi f eps0) is written as 17.9751 sigma / f_GHz (P.2040-3, eq. 12): five digits.
#include "radio/material.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "radio/world.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

TEST_CASE("permittivity follows a f^b and c f^d") {
  const std::complex<double> concrete = complex_permittivity(test::concrete(0.1), 5.9e9);
  CHECK(concrete.real() == test::near(5.24, 1e-15));
  CHECK(concrete.imag() == test::near(-17.9751 * 0.0462 * std::pow(5.9, 0.7822) / 5.9, 1e-5));

  const std::complex<double> ground = complex_permittivity(test::medium_dry_ground(), 5.9e9);
  CHECK(ground.real() == test::near(15 * std::pow(5.9, -0.1), 1e-14));
  CHECK(ground.imag() == test::near(-17.9751 * 0.035 * std::pow(5.9, 1.63) / 5.9, 1e-5));

  const Material marble{"marble", 7.074, 0, 0.0055, 0.9262, 1, 60};
  CHECK_NOTHROW(complex_permittivity(marble, 60e9));  // 60e9 * 1e-9 is more than 60

  const Material own{.name = "own", .a = 3.5, .c = 0.02};
  CHECK(complex_permittivity(own, 1e6).real() == 3.5);
  CHECK(complex_permittivity(own, 1e9).imag() == test::near(-17.9751 * 0.02, 1e-5));
}

TEST_CASE("a material is refused outside its range, with a message that helps") {
  const Material concrete = test::concrete(0.1);
  CHECK_NOTHROW(complex_permittivity(concrete, 1e9));
  CHECK_NOTHROW(complex_permittivity(concrete, 100e9));
  for (const double frequency_hz : {0.99e9, 100.1e9}) {
    CAPTURE(frequency_hz);
    try {
      complex_permittivity(concrete, frequency_hz);
      FAIL("no error");
    } catch (const ConfigError& error) {
      const std::string message = error.what();
      for (const char* part : {"radio.frequency_hz", "concrete", "1 to 100 GHz", "[[material]]"}) {
        CAPTURE(part);
        CHECK(message.find(part) != std::string::npos);
      }
    }
  }
}

TEST_CASE("all materials that are not known at the carrier are named at once, with what may be done") {
  const Material concrete = test::concrete(0.1), own{.name = "own", .a = 3.5, .c = 0.02};
  const Material ground = test::medium_dry_ground(), metal{"metal", 1, 0, 1e7, 0, 1, 100};
  const std::vector<Material> all{concrete, own, ground, metal};
  CHECK(range_problem(all, 5.9e9).empty());
  const std::string at_d_band = range_problem(all, 140e9);
  for (const char* part : {"radio.frequency_hz = 1.4e+11", "\"concrete\" is only known from 1 to 100 GHz",
                           "\"medium_dry_ground\" is only known from 1 to 10 GHz", "\"metal\"",
                           "scene.itu_edition = \"P.2040-4\"", "scene.extrapolate_materials = true"}) {
    CAPTURE(part);
    CHECK(at_d_band.find(part) != std::string::npos);
  }
  CHECK(at_d_band.find("\"own\"") == std::string::npos);
  const std::string of_ground = range_problem({&ground, 1}, 28e9);  // its range is a limit, in every edition
  CHECK(of_ground.find("extrapolate") == std::string::npos);
  CHECK(of_ground.find("itu_edition") == std::string::npos);
}
