// SPDX-License-Identifier: Apache-2.0
// A cylinder against its closed form and a sphere against the series of Mie.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <utility>
#include "bodies/bodies.hpp"

using namespace wavetracer;

namespace {

Body cylinder(double radius, double length, int sides) {
  std::vector<Polygon> strips(2);  // the first two are the ends
  for (int i = 0; i < sides; ++i) {
    const double from = 2 * pi * i / sides, to = 2 * pi * (i + 1) / sides;
    const glm::dvec3 a(radius * std::cos(from), radius * std::sin(from), -length / 2);
    const glm::dvec3 b(radius * std::cos(to), radius * std::sin(to), -length / 2);
    strips.push_back({a, b, {b.x, b.y, length / 2}, {a.x, a.y, length / 2}});
    strips[0].push_back({a.x, a.y, length / 2});
    strips[1].insert(strips[1].begin(), a);
  }
  return conductor(strips);
}

// A sphere of triangles: an octahedron whose faces are cut into steps^2, with the mean radius of the sphere.
Body sphere(double radius, int steps) {
  std::vector<Polygon> triangles;
  for (int octant = 0; octant < 8; ++octant) {
    const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
    const auto at = [&](int i, int j) {
      return radius * glm::normalize(glm::dvec3(x * i, y * j, z * (steps - i - j)));
    };
    const auto add = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
      if (x * y * z < 0) std::swap(b, c);
      triangles.push_back({a, b, c});
    };
    for (int i = 0; i < steps; ++i)
      for (int j = 0; i + j < steps; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < steps) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  double distance = 0, area = 0;
  for (const Polygon& t : triangles) {
    const glm::dvec3 across = glm::cross(t[1] - t[0], t[2] - t[0]) * 0.5, middle = (t[0] + t[1] + t[2]) / 3.0;
    distance += glm::length(middle) * glm::length(across);
    area += glm::length(across);
  }
  // The sagitta is largest at the middle and zero at corners, so the mean distance is between both.
  const double mean = (distance / area + radius) / 2;
  for (Polygon& t : triangles)
    for (glm::dvec3& p : t) p *= radius / mean;
  return conductor(triangles);
}

// Amplitudes of a conducting sphere (C. F. Bohren, D. R. Huffman, chapter 4, with the coefficients of a conductor):
// S1 for the polarization across the plane of scattering, S2 for the one in it, with sigma = lambda^2 |S|^2 / pi.
// theta: between the directions of travel; pi is back to the source.
std::array<std::complex<double>, 2> mie(double ka, double theta) {
  const int last = static_cast<int>(ka + 4.05 * std::cbrt(ka) + 20);
  // psi(n) = x j(n), by the downward recurrence; chi(n) = -x y(n) upward; xi = psi - j chi in this time convention.
  std::vector<double> psi(last + 60), chi(last + 1);
  double high = 0, here = 1e-280;
  for (int n = last + 59; n >= 0; --n) {
    psi[n] = here;
    const double low = (2 * n + 1) / ka * here - high;
    high = here;
    here = low;
    if (std::abs(here) > 1e250) {
      for (int m = n; m < last + 60; ++m) psi[m] *= 1e-280;
      high *= 1e-280;
      here *= 1e-280;
    }
  }
  // n = 0 is sin(x); `here` would be n = -1, cos(x).
  const double scale = std::abs(std::sin(ka)) > 0.5 ? std::sin(ka) / psi[0] : std::cos(ka) / here;
  for (double& value : psi) value *= scale;
  chi[0] = std::cos(ka);
  chi[1] = std::cos(ka) / ka + std::sin(ka);
  for (int n = 2; n <= last; ++n) chi[n] = (2 * n - 1) / ka * chi[n - 1] - chi[n - 2];
  std::complex<double> s1 = 0, s2 = 0;
  double pi_before = 0, pi_n = 1;
  const double mu = std::cos(theta);
  for (int n = 1; n <= last; ++n) {
    const std::complex<double> xi(psi[n], -chi[n]), xi_before(psi[n - 1], -chi[n - 1]);
    const double psi_slope = psi[n - 1] - n / ka * psi[n];
    const std::complex<double> a = psi_slope / (xi_before - n / ka * xi), b = psi[n] / xi;
    const double tau = n * mu * pi_n - (n + 1) * pi_before, weight = (2.0 * n + 1) / (n * (n + 1));
    s1 += weight * (a * pi_n + b * tau);
    s2 += weight * (a * tau + b * pi_n);
    const double next = ((2 * n + 1) * mu * pi_n - (n + 1) * pi_before) / n;
    pi_before = pi_n;
    pi_n = next;
  }
  return {s1, s2};
}

// Physical optics of a smooth sphere by a midpoint rule, for a wave along -x, in the plane z = 0.
double smooth_sphere_db(double radius, double bistatic_deg, bool across) {
  const int steps = 600;
  const glm::dvec3 in(-1, 0, 0), out = towards(90, bistatic_deg), up(0, 0, 1);
  const glm::dvec3 heard = across ? up : glm::cross(up, out), field = across ? up : glm::dvec3(0, 1, 0);
  const double k = 2 * pi / wave_m;
  std::complex<double> sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * steps; ++j) {
      const double theta = (i + 0.5) / steps * pi / 2, phi = (j + 0.5) / steps * pi;
      const glm::dvec3 n(std::cos(theta), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi));
      const glm::dvec3 current = 2.0 * glm::cross(n, glm::cross(in, field));
      sum += std::polar(glm::dot(heard, current) * std::sin(theta), k * radius * glm::dot(out - in, n));
    }
  const double area = radius * radius * (pi / 2 / steps) * (pi / steps);
  return db(4 * pi * std::norm(sum * area * k / (4 * pi)));
}

}  // namespace

TEST_CASE("the series of Mie: a small sphere is Rayleigh's, and forward scattering has the power that is lost") {
  // sigma of a small conducting sphere, back to the source: 9 pi a^2 (ka)^4.
  const double ka = 0.05;
  CHECK(std::norm(mie(ka, pi)[0]) * 4 / (ka * ka) == doctest::Approx(9 * std::pow(ka, 4)).epsilon(0.01));
  // A large one: pi a^2 back, and twice its area is lost, up to the edge's term.
  CHECK(std::norm(mie(200, pi)[0]) * 4 / 4e4 == doctest::Approx(1).epsilon(0.02));
  CHECK(mie(200, 0)[0].real() * 4 / 4e4 == doctest::Approx(2).epsilon(0.05));
}

TEST_CASE("a cylinder, seen from its side, has k a L^2 within 0.5 dB, and lobes of its length") {
  const double radius = 12 * wave_m, length = 20 * wave_m, k = 2 * pi / wave_m;
  // The sagitta of a strip is radius (pi / sides)^2 / 2, here lambda / 100.
  const Body body = cylinder(radius, length, 240);
  for (const double phi : {0.0, 0.4, 33.0}) {
    const glm::dvec3 d = towards(90, phi);
    const auto found = cross_section_db(body, d, d);
    CHECK(std::abs(found[0] - db(k * radius * length * length)) < 0.5);
    CHECK(std::abs(found[3] - db(k * radius * length * length)) < 0.5);
    MESSAGE(fmt::format("cylinder: {:+.2f} and {:+.2f} dB", found[0] - db(k * radius * length * length),
                        found[3] - db(k * radius * length * length)));
  }
  for (const double theta : {91.0, 92.0, 93.5}) {  // the main lobe and the first side lobe
    const glm::dvec3 d = towards(theta, 10);
    const double factor = sinc(k * length * d.z), across = std::sin(theta * pi / 180);
    const double expected = db(k * radius * across * length * length * factor * factor);
    CHECK(std::abs(cross_section_db(body, d, d)[0] - expected) < 0.5);
  }
}

TEST_CASE("a sphere is near the series of Mie, away from forward, and near physical optics of a smooth one") {
  const double radius = 35 / (2 * pi) * wave_m, ka = 35;
  const Body body = sphere(radius, 28);
  REQUIRE(is_closed(body));
  const glm::dvec3 from = towards(90, 0);
  for (double bistatic = 0; bistatic <= 90; bistatic += 10) {
    const auto found = cross_section_db(body, from, towards(90, bistatic), {.max_bounces = 1});
    const auto exact = mie(ka, pi - bistatic * pi / 180);
    const double across = db(wave_m * wave_m / pi * std::norm(exact[0]));
    const double within = db(wave_m * wave_m / pi * std::norm(exact[1]));
    MESSAGE(fmt::format("sphere, {} degrees: {:+.2f} dB across the plane of scattering, {:+.2f} dB in it", bistatic,
                        found[0] - across, found[3] - within));
    // The plane of scattering is z = 0: theta is across it. In that plane the current of physical optics ends abruptly
    // where the sphere turns dark, which costs up to 1.2 dB between 60 and 70 degrees, with any number of facets.
    CHECK_MESSAGE(std::abs(found[0] - across) < 0.3, bistatic);
    CHECK_MESSAGE(std::abs(found[3] - within) < (bistatic <= 50 ? 1.0 : 1.2), bistatic);
    CHECK_MESSAGE(std::abs(found[0] - smooth_sphere_db(radius, bistatic, true)) < 0.3, bistatic);
    CHECK_MESSAGE(std::abs(found[3] - smooth_sphere_db(radius, bistatic, false)) < 0.3, bistatic);
  }
  // Behind the sphere, what is scattered is its shadow, and the wave of the edge of the shadow that physical optics
  // lacks is a part of (ka)^(-2/3).
  const auto ahead = cross_section_db(body, from, towards(90, 180), {.max_bounces = 1});
  CHECK(std::abs(ahead[0] - db(4 * pi * std::pow(pi * radius * radius / wave_m, 2))) < 0.1);
  CHECK(std::abs(ahead[0] - db(wave_m * wave_m / pi * std::norm(mie(ka, 0)[0]))) < 1.0);
}
