// SPDX-License-Identifier: Apache-2.0
// The jumps of waves at the boundaries of a convex edge: no face reflects more than it gets, wherever both ends are.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <random>

#include "wavetracer/device/utd.h"

using namespace wavetracer;

namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// The largest amplitude of a wave that the matrix makes of one of amplitude 1.
double gain_of(const device::wt_matrix& m) {
  double sum = 0;
  for (const glm::dvec2& element : m.m) sum += glm::dot(element, element);
  const auto number = [&](int i) { return std::complex<double>(m.m[i].x, m.m[i].y); };
  const double det = std::abs(number(0) * number(3) - number(1) * number(2));
  return std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * det * det))) / 2);
}

device::wt_wedge_face any_face(Random& random) {
  device::wt_wedge_face face{};
  const bool conducts = random() % 5 == 0;
  face.permittivity =
      conducts ? glm::dvec2(INFINITY, 0) : glm::dvec2(between(random, 1, 15), -std::exp(between(random, -7, 7)));
  face.thickness_m = random() % 2 ? INFINITY : between(random, 0.01, 0.5);
  return face;
}

// Half of all azimuths are near a face.
double any_azimuth(Random& random, double exterior) {
  if (random() % 2) return between(random, 0, exterior);
  const double off = std::min(std::exp(between(random, std::log(1e-6), 0)), exterior);
  return random() % 2 ? off : exterior - off;
}

// The largest gains that were found: of the incident wave, and of reflections, less what they may be.
struct Largest {
  double incident = 0, reflected = 0, excess = -1;
};

// Adds the jumps of a random edge, with random ends.
void add_edge(Random& random, Largest& out) {
  device::wt_wedge_frame frame{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, std::numbers::pi * between(random, 1.001, 2)};
  if (random() % 2) frame.exterior = std::numbers::pi * (random() % 2 ? 1.5 : 2);
  const device::wt_wedge_face face = any_face(random), faces[2] = {face, face};
  const double in = any_azimuth(random, frame.exterior), away = any_azimuth(random, frame.exterior);
  const double beta = between(random, 0.1, std::numbers::pi - 0.1), sine = std::sin(beta);
  const glm::dvec3 come{-sine * std::cos(in), -sine * std::sin(in), std::cos(beta)},
      leave{sine * std::cos(away), sine * std::sin(away), std::cos(beta)};
  const double legs_m[2] = {std::exp(between(random, 0, 5)), std::exp(between(random, 0, 5))};
  const double wavelength_m = std::exp(between(random, -5, 0));
  const device::wt_turn turn = device::wt_turn_at(&frame, come, leave);
  const device::wt_bend bend = device::wt_bend_at(&frame, faces, come, leave, legs_m, &turn, wavelength_m, 0);
  const double distance_m = legs_m[0] * legs_m[1] / (legs_m[0] + legs_m[1]) * sine * sine;
  const double root_2kl = std::sqrt(4 * std::numbers::pi * distance_m / wavelength_m);
  for (int term = 0; term < WT_BOUNDARIES; ++term) {
    const device::wt_term_factors factors = device::wt_factors_of(turn.boundaries[term].epsilon, bend.n);
    const double s = root_2kl * factors.sine;
    glm::dvec2 spread{0, 0};
    if (term >= 2)
      spread = device::wt_spread_of(s, device::wt_transition_over_root(s),
                                    std::copysign(root_2kl * wavelength_m / (2 * std::numbers::pi), -factors.ratio));
    const double gain = gain_of(device::wt_jump(&bend, term, root_2kl, 0, spread));
    if (term < 2) {
      out.incident = std::max(out.incident, gain);
      continue;
    }
    out.reflected = std::max(out.reflected, gain);
    out.excess = std::max(out.excess, gain - (1 + 2 / (1 + s * s)));
  }
}

}  // namespace

// kernels/lib/bend_bound.clh takes these limits for granted.
TEST_CASE("no face of an edge reflects more than it gets, but for the surroundings of its boundary") {
  Random random(17);
  Largest found;
  for (int i = 0; i < 300000; ++i) add_edge(random, found);
  CHECK(found.incident <= 1 + 1e-7);  // rounding
  CHECK(found.excess <= 1e-9);
  CHECK(found.reflected >= 1);
}
