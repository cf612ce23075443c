// SPDX-License-Identifier: Apache-2.0
// Paths over two edges, compared with the sums of Kouyoumjian and Pathak's coefficients that they represent.
// The cases are a strip of two free edges, and a ridge of two wedges with a flat top, both of a perfect conductor.
#include "radio/fields.hpp"

#include "radio/world.hpp"

using namespace wavetracer;

namespace {

constexpr double width_m = 3;

// Edges along z through the origin and (width, 0, 0); the face between them is y = 0. The ridge's other faces go down.
test::World two_edges(bool strip) {
  test::World world;
  world.scene.origin_m = {0, 0, 0};
  const uint32_t top = world.add_plane({0, 1, 0}, {0, 0, 0}, test::conductor());
  const uint32_t left = world.add_plane({1, 0, 0}, {0, 0, 0}, test::conductor());
  const uint32_t right = world.add_plane({1, 0, 0}, {width_m, 0, 0}, test::conductor());
  const double exterior_rad = (strip ? 2 : 1.5) * std::numbers::pi;
  // Face 0 is the top for both, seen from above: azimuths go up from it.
  world.scene.wedges = {{.start = {0, 0, -50},
                         .along = {0, 0, 1},
                         .length_m = 100,
                         .face = {1, 0, 0},
                         .normal = {0, 1, 0},
                         .exterior_rad = exterior_rad,
                         .surface = {top, strip ? top : left}},
                        {.start = {width_m, 0, 50},
                         .along = {0, 0, -1},
                         .length_m = 100,
                         .face = {-1, 0, 0},
                         .normal = {0, 1, 0},
                         .exterior_rad = exterior_rad,
                         .surface = {top, strip ? top : right}}};
  world.config.transmitters = {test::World::end({-6, strip ? 4.0 : -4.0, 0}, "isotropic", "VH")};
  world.config.receivers = {test::World::end({width_m + 5, strip ? 3.0 : -3.0, 0}, "isotropic", "VH")};
  world.add_path(0, 0, {0, 1}, {diffraction, diffraction}, {{0, 0, 0}, {width_m, 0, 0}});
  return world;
}

// K-P's coefficient for a perfect conductor at normal incidence, far from shadow boundaries; sign: 1 hard, -1 soft.
std::complex<double> conductor_edge(double sign, double n, double phi, double phi_in, double k) {
  std::complex<double> sum = 0;
  for (const double beta : {phi - phi_in, phi + phi_in})
    sum += (beta == phi - phi_in ? 1 : sign) *
           (1 / std::tan((std::numbers::pi + beta) / (2 * n)) + 1 / std::tan((std::numbers::pi - beta) / (2 * n)));
  return -std::polar(1 / (2 * n * std::sqrt(2 * std::numbers::pi * k)), -std::numbers::pi / 4) * sum;
}

// Returns its derivative by phi, the azimuth of a face, there.
std::complex<double> soft_slope(double n, double face, double phi_in, double k) {
  const double step = 1e-5, inside = face == 0 ? step : face - step;
  return conductor_edge(-1, n, inside, phi_in, k) / (inside - face);
}

}  // namespace

TEST_CASE("over two edges of one face a hard wave, half of it on each side, and the slope of a soft one") {
  using std::numbers::pi;
  for (const bool strip : {true, false}) {
    CAPTURE(strip);
    const test::World world = two_edges(strip);
    const double k = 2 * pi / world.wavelength_m(), n = strip ? 2 : 1.5;
    // Azimuths from the face towards its free side: the transmitter's about one edge, the receiver's about the other.
    const auto azimuth = [](double x, double y) { return std::atan2(y, x) + (y < 0 ? 2 * pi : 0); };
    const double in = azimuth(-6, strip ? 4 : -4), out = azimuth(-5, strip ? 3 : -3);
    const double s0 = std::hypot(6.0, 4.0), s2 = std::hypot(5.0, 3.0);
    const double spread = 1 / std::sqrt(s0 * width_m * s2 * (s0 + width_m + s2));
    std::complex<double> hard = 0, soft = 0;
    for (const double face : strip ? std::vector<double>{0, 2 * pi} : std::vector<double>{0}) {
      hard += conductor_edge(1, n, face, in, k) * conductor_edge(1, n, out, face, k) / 2.0;
      // The soft wave vanishes at the face: its slope across the face is what the second edge diffracts.
      soft += soft_slope(n, face, in, k) * soft_slope(n, face, out, k) / (std::complex<double>(0, 2) * k * width_m);
    }
    const double at_1_m = world.wavelength_m() / (4 * pi);
    const Paths paths = world.paths();
    REQUIRE(paths.size() == 1);
    // The hard wave has its electric field across the edges: H here. Transition functions are 1 to a few thousandths.
    CHECK(std::abs(paths.a[0][3]) == test::near(at_1_m * std::abs(hard) * spread, 0.02));
    CHECK(std::abs(paths.a[0][0]) == test::near(at_1_m * std::abs(soft) * spread, 0.02));
  }
}
