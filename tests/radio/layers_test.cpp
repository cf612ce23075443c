// SPDX-License-Identifier: Apache-2.0
// Walls of several layers against the textbook's characteristic matrices in long double, closed forms, slabs, and
// conservation of energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "radio/slab.hpp"
#include "radio/world.hpp"

using namespace wavetracer;
using test::infinity;
using test::wavelength_m;
using Complex = std::complex<double>;
using Long = std::complex<long double>;
using Wall = std::vector<WallLayer>;

namespace {

// The coefficients of one polarisation from the product of characteristic matrices (Born and Wolf, section 1.6). TM is
// about the magnetic field, whose coefficients have the signs that the program gives TM.
std::array<Long, 2> textbook(const Wall& wall, long double c, bool tm) {
  const Long j{0, 1};
  Long m[2][2] = {{1, 0}, {0, 1}};
  for (const WallLayer& layer : wall) {
    const Long eta = layer.permittivity, s = std::sqrt(eta - (1 - c * c)), w = tm ? s / eta : s;
    const Long q = 2 * std::numbers::pi_v<long double> * layer.thickness_m / wavelength_m * s;
    const Long n[2][2] = {{std::cos(q), j * std::sin(q) / w}, {j * w * std::sin(q), std::cos(q)}};
    Long out[2][2];
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < 2; ++column) out[row][column] = m[row][0] * n[0][column] + m[row][1] * n[1][column];
    std::copy(&out[0][0], &out[0][0] + 4, &m[0][0]);
  }
  const Long field = m[0][0] + m[0][1] * c, other = m[1][0] + m[1][1] * c;
  return {(c * field - other) / (c * field + other), 2 * c / (c * field + other)};
}

SlabCoefficients textbook(const Wall& wall, double cosine) {
  const auto te = textbook(wall, cosine, false), tm = textbook(wall, cosine, true);
  const auto narrow = [](const Long& z) {
    return Complex(static_cast<double>(z.real()), static_cast<double>(z.imag()));
  };
  return {narrow(te[0]), narrow(tm[0]), narrow(te[1]), narrow(tm[1])};
}

std::array<Complex, 4> all_of(const SlabCoefficients& s) {
  return {s.reflection_te, s.reflection_tm, s.transmission_te, s.transmission_tm};
}

// The largest difference of two coefficients.
double apart(const SlabCoefficients& a, const SlabCoefficients& b) {
  double out = 0;
  for (int i = 0; i < 4; ++i) out = std::max(out, std::abs(all_of(a)[i] - all_of(b)[i]));
  return out;
}

double apart_by_ratio(const SlabCoefficients& a, const SlabCoefficients& b) {
  double out = 0;
  for (int i = 0; i < 4; ++i) out = std::max(out, std::abs(all_of(a)[i] / all_of(b)[i] - 1.0));
  return out;
}

double kept_te(const SlabCoefficients& s) { return std::norm(s.reflection_te) + std::norm(s.transmission_te); }
double kept_tm(const SlabCoefficients& s) { return std::norm(s.reflection_tm) + std::norm(s.transmission_tm); }

Wall reversed(Wall wall) {
  std::ranges::reverse(wall);
  return wall;
}

class Walls {
 public:
  // A wall of 2 to 8 layers up to `most_m` thick, of permittivity 1 to 9 and losses up to `most_loss`.
  Wall wall(double most_m, double most_loss) {
    Wall out(2 + engine_() % 7);
    for (WallLayer& layer : out)
      layer = {{1 + 8 * share_(engine_), -most_loss * share_(engine_)}, most_m * share_(engine_)};
    return out;
  }
  double cosine() { return share_(engine_); }

 private:
  std::mt19937 engine_{29};
  std::uniform_real_distribution<double> share_{0, 1};
};

const double cosines[] = {1.0, 0.9, 0.5, 0.1, 1e-3, 1e-9, 1e-200};

}  // namespace

TEST_CASE("layers: walls of two to eight layers are those of the textbook's matrices") {
  Walls walls;
  double most = 0;
  for (int i = 0; i < 20000; ++i) {
    const Wall wall = walls.wall(i % 2 == 0 ? 0.1 : 0.01, i % 3 == 0 ? 0 : 1.5);
    const double cosine = walls.cosine();
    most = std::max(most, apart(wall_coefficients(wall, cosine, wavelength_m), textbook(wall, cosine)));
  }
  CHECK(most < 1e-12);
}

TEST_CASE("layers: thin layers and grazing waves lose no digits") {
  Walls walls;
  double thin = 0, grazing = 0;
  for (int i = 0; i < 3000; ++i) {
    const Wall wall = walls.wall(1e-7, 1.5), usual = walls.wall(0.02, 1.5);
    const double cosine = walls.cosine();
    // At Brewster's angle of a layer the reflection itself is a difference, so this stays away from it. Thinner layers
    // take more digits from the textbook's form than long double has to spare.
    thin = std::max(thin, apart_by_ratio(wall_coefficients(wall, 0.8 + 0.2 * cosine, wavelength_m),
                                         textbook(wall, 0.8 + 0.2 * cosine)));
    grazing = std::max(
        grazing, apart_by_ratio(wall_coefficients(usual, 1e-9 * cosine, wavelength_m), textbook(usual, 1e-9 * cosine)));
  }
  CHECK(thin < 1e-13);
  CHECK(grazing < 1e-13);
}

TEST_CASE("layers: a quarter of a wave of the right permittivity on a half space reflects nothing at its frequency") {
  const double thickness_m = wavelength_m / 4 / std::sqrt(2.0);
  const Wall coated{{2.0, thickness_m}, {4.0, infinity}};
  const SlabCoefficients s = wall_coefficients(coated, 1, wavelength_m);
  CHECK(std::abs(s.reflection_te) < 1e-15);
  CHECK(std::abs(s.reflection_tm) < 1e-15);
  CHECK(s.transmission_te == 0.0);
  // Half the frequency away from it, the coating helps little: a bare half space reflects 1/3.
  CHECK(std::abs(wall_coefficients(coated, 1, wavelength_m / 2).reflection_te) == test::near(1.0 / 3, 1e-12));
  CHECK(std::abs(wall_coefficients(Wall{{2.0, 0.0}, {4.0, infinity}}, 1, wavelength_m).reflection_te) ==
        test::near(1.0 / 3, 1e-15));
}

TEST_CASE("layers: a mirror of quarter waves has the reflectance of its closed form") {
  const double low = 1.5, high = 2.5;
  Wall mirror;
  for (int pairs = 1; pairs <= 4; ++pairs) {
    mirror.push_back({high * high, wavelength_m / 4 / high});
    mirror.push_back({low * low, wavelength_m / 4 / low});
    const double ratio = std::pow(high / low, 2 * pairs);
    CHECK(std::abs(wall_coefficients(mirror, 1, wavelength_m).reflection_te) ==
          test::near((ratio - 1) / (ratio + 1), 1e-13));
  }
}

TEST_CASE("layers: walls without losses keep all energy, and others never add any") {
  Walls walls;
  double lossless = 0, lossy = 0;
  for (int i = 0; i < 2000; ++i)
    for (const double cosine : cosines) {
      const SlabCoefficients s = wall_coefficients(walls.wall(0.2, 0), cosine, wavelength_m);
      lossless = std::max({lossless, std::abs(kept_te(s) - 1), std::abs(kept_tm(s) - 1)});
      const SlabCoefficients t = wall_coefficients(walls.wall(0.2, 20), cosine, wavelength_m);
      lossy = std::max({lossy, kept_te(t), kept_tm(t)});
    }
  CHECK(lossless < 1e-12);
  CHECK(lossy <= 1 + 1e-12);
}

TEST_CASE("layers: one layer has the bits of the slab") {
  for (const Complex eta : {Complex{5.24, -0.56}, {1, -3e7}, {2.5, 0}, {1, 0}})
    for (const double thickness_m : {0.0, 1e-6, 0.1, 30.0, infinity})
      for (const double cosine : {1.0, 0.3, 1e-9, 0.0}) {
        CAPTURE(eta);
        CAPTURE(thickness_m);
        CAPTURE(cosine);
        const auto wall = all_of(wall_coefficients(Wall{{eta, thickness_m}}, cosine, wavelength_m));
        CHECK(wall == all_of(slab_coefficients(eta, cosine, thickness_m, wavelength_m)));
      }
}

TEST_CASE("layers: parts of one slab are the slab") {
  for (const Complex eta : {Complex{5.24, -0.56}, {6.31, -0.02}, {2.5, 0}, {1, -3e7}, {40, -30}})
    for (const double thickness_m : {1e-9, 1e-4, 0.02, 0.1, 0.4, 30.0})
      for (const double cosine : cosines) {
        CAPTURE(eta);
        CAPTURE(thickness_m);
        CAPTURE(cosine);
        const SlabCoefficients slab = slab_coefficients(eta, cosine, thickness_m, wavelength_m);
        CHECK(apart(wall_coefficients(Wall(2, {eta, thickness_m / 2}), cosine, wavelength_m), slab) < 1e-12);
        CHECK(apart(wall_coefficients(Wall(8, {eta, thickness_m / 8}), cosine, wavelength_m), slab) < 1e-12);
      }
}

TEST_CASE("layers: both sides of a wall transmit alike, and reflect alike only if it is symmetric") {
  Walls walls;
  double transmitted = 0;
  for (int i = 0; i < 2000; ++i) {
    const Wall wall = walls.wall(0.05, 1.5);
    const double cosine = walls.cosine();
    const SlabCoefficients there = wall_coefficients(wall, cosine, wavelength_m),
                           back = wall_coefficients(reversed(wall), cosine, wavelength_m);
    transmitted = std::max({transmitted, std::abs(there.transmission_te - back.transmission_te),
                            std::abs(there.transmission_tm - back.transmission_tm)});
  }
  CHECK(transmitted < 1e-13);
  const Wall insulated{{{3.91, -0.1}, 0.12}, {{1.2, 0}, 0.1}, {{5.24, -0.56}, 0.2}};
  const SlabCoefficients outside = wall_coefficients(insulated, 0.8, wavelength_m),
                         inside = wall_coefficients(reversed(insulated), 0.8, wavelength_m);
  CHECK(std::abs(outside.reflection_te - inside.reflection_te) > 0.05);
  const Wall glazing{{{6.31, -0.02}, 0.004}, {{1, 0}, 0.016}, {{6.31, -0.02}, 0.004}};
  CHECK(all_of(wall_coefficients(glazing, 0.8, wavelength_m)) ==
        all_of(wall_coefficients(reversed(glazing), 0.8, wavelength_m)));
}

TEST_CASE("layers: an endless or opaque layer hides what is behind it") {
  const WallLayer coat{{2.6, -0.1}, 0.02}, plaster{{2.7, -0.1}, 0.013};
  for (const double cosine : {1.0, 0.4, 1e-6})
    for (const WallLayer& core : {WallLayer{{5.24, -0.56}, infinity}, {{1, -3e7}, 0.01}, {{5.24, -5.0}, 60.0}}) {
      const SlabCoefficients more = wall_coefficients(Wall{coat, core, plaster, coat}, cosine, wavelength_m);
      CHECK(apart(more, wall_coefficients(Wall{coat, core}, cosine, wavelength_m)) < 1e-13);
      CHECK(std::abs(more.transmission_te) < 1e-200);
    }
}

TEST_CASE("layers: every wall has finite coefficients, at most 1 in size") {
  const std::vector<WallLayer> extremes{{{1, -1e17}, 0.1}, {{1e6, 0}, 1e-6},  {{1e6, -1e6}, 1e9},
                                        {{1, 0}, 1.0},     {{1, -1e-9}, 1e6}, {{4, 0}, 1e300},
                                        {{2, -1}, 1e-300}, {{0.5, 0}, 3.0},   {{3, -3e7}, infinity}};
  std::mt19937 engine(3);
  double most = 0;
  for (int i = 0; i < 20000; ++i) {
    Wall wall;
    for (size_t k = 0; k < 2 + engine() % 7; ++k) wall.push_back(extremes[engine() % extremes.size()]);
    for (const double cosine : {1.0, 0.5, 1e-3, 1e-200, 0.0})
      for (const Complex z : all_of(wall_coefficients(wall, cosine, wavelength_m)))
        most = std::isfinite(std::abs(z)) ? std::max(most, std::abs(z)) : infinity;
  }
  CHECK(most <= 1 + 1e-11);
  const Wall empty{{{1, 0}, 0.3}, {{4, 0}, 0.0}};
  for (const double cosine : {1.0, 1e-200, 0.0}) {
    CHECK(std::abs(wall_coefficients(empty, cosine, wavelength_m).reflection_te) < 1e-15);
    CHECK(std::abs(wall_coefficients(empty, cosine, wavelength_m).transmission_tm) == test::near(1, 1e-15));
  }
}
