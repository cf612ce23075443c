// SPDX-License-Identifier: Apache-2.0
// Reflection at one face of an edge in closed form (wt_reflection_between) against the same wave followed as vectors,
// and against the laws that it must keep.
#include "wavetracer/device/corner.h"

#include <doctest/doctest.h>

#include <random>

#include "radio/corner.hpp"

using namespace wavetracer;
using device::wt_corner;
using device::wt_corner_wave;
using device::wt_matrix;

namespace {

constexpr double wavelength_m = 0.05;

wt_corner corner_of(double exterior, const device::wt_wedge_face& face) {
  wt_corner out;
  out.exterior = exterior;
  out.turn = device::wt_cos_sin(exterior);
  out.faces[0] = out.faces[1] = face;
  out.wavelength_m = wavelength_m;
  return out;
}

device::wt_wedge_face face_of(double real, double imag, double thickness_m) {
  device::wt_wedge_face face{};
  face.permittivity = {real, imag};
  face.thickness_m = thickness_m;
  face.zone = 1e-3;
  return face;
}

double difference(const wt_matrix& a, const wt_matrix& b) {
  double out = 0;
  for (int i = 0; i < 4; ++i) out = std::max(out, glm::length(a.m[i] - b.m[i]));
  return out;
}

// A wave from this azimuth, at the angle beta to the edge, reflected at a face: in closed form and by its vectors.
std::pair<wt_matrix, wt_matrix> reflected(const wt_corner& corner, int face, double azimuth, double beta) {
  const double cosine = std::cos(beta), sine = std::sin(beta);
  const wt_corner_wave wave = device::wt_wave_from(device::wt_cos_sin(azimuth), cosine, sine);
  const glm::dvec2 turn = device::wt_cos_sin(face == 0 ? azimuth : corner.exterior - azimuth);
  return {device::wt_reflected_wave(corner.faces[face], face, turn, cosine, sine, 0.0, {0.0, 0.0}, 0.0, wavelength_m),
          device::wt_met(&corner, &wave, face, 1, 0)};
}

}  // namespace

TEST_CASE("reflection at a face of an edge: the closed form is the wave followed as vectors") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0.001, 0.999);
  double worst = 0;
  for (const device::wt_wedge_face& face :
       {face_of(5.24, -0.5, 0.2), face_of(15, -2, INFINITY), face_of(1, -1e9, 0.01)})
    for (int tries = 0; tries < 3000; ++tries) {
      const wt_corner corner = corner_of(std::numbers::pi * (1 + part(random)), face);
      const double azimuth = corner.exterior * part(random), beta = std::numbers::pi * part(random);
      for (int side = 0; side < 2; ++side) {
        const auto [closed, followed] = reflected(corner, side, azimuth, beta);
        worst = std::max(worst, difference(closed, followed));
      }
    }
  CHECK(worst < 1e-11);
}

TEST_CASE("reflection at a face of an edge: a wave that comes along the normal has no plane of incidence") {
  const wt_corner corner = corner_of(1.5 * std::numbers::pi, face_of(5.24, -0.5, 0.2));
  for (const double off : {0.0, 1e-12, 1e-9, 1e-7}) {
    CAPTURE(off);
    const auto [closed, followed] = reflected(corner, 0, std::numbers::pi / 2 + off, std::numbers::pi / 2 + off);
    CHECK(difference(closed, followed) < 1e-7);
    CHECK(difference(closed, reflected(corner, 0, std::numbers::pi / 2, std::numbers::pi / 2).first) < 1e-6);
  }
}
