// SPDX-License-Identifier: Apache-2.0
// Bounds of reflectances hold at every angle, and are not much larger than the largest reflectance of their range.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "radio/reflectance_bounds.hpp"
#include "wavetracer/device/slab.h"

using namespace wavetracer;

namespace {

double reflectance(const device::wt_material& material, double cosine, double wavelength_m) {
  const device::wt_slab slab = device::wt_slab_coefficients({material.permittivity[0], material.permittivity[1]},
                                                            cosine, material.thickness_m, wavelength_m);
  const auto square = [](const device::wt_double2& z) { return z.x * z.x + z.y * z.y; };
  return std::max(square(slab.reflection_te), square(slab.reflection_tm));
}

device::wt_material slab(double real, double imaginary, double thickness_m) {
  device::wt_material out{};
  out.permittivity[0] = real;
  out.permittivity[1] = imaginary;
  out.thickness_m = thickness_m;
  return out;
}

}  // namespace

TEST_CASE("bounds of reflectances hold for half spaces and slabs, thin and thick, at low and high frequencies") {
  const double endless = std::numeric_limits<double>::infinity();
  std::mt19937 engine(17);
  std::uniform_real_distribution<double> cosines(0, 1);
  for (const device::wt_material& material :
       {slab(5.24, -0.29, endless), slab(5.24, -0.29, 0.2), slab(6.3, -0.01, 0.006), slab(1.5, -0.001, 0.013),
        slab(3.9, -0.4, 0.3), slab(30, -12, endless), slab(1.0, -0.0001, 1.0)})
    for (const double wavelength_m : {0.33, 0.0857, 0.0107, 0.004}) {
      CAPTURE(material.permittivity[0]);
      CAPTURE(material.thickness_m);
      CAPTURE(wavelength_m);
      const CosineBounds bounds = reflectance_bounds(std::vector{material}, 0, wavelength_m);
      CosineBounds largest{};
      size_t broken = 0;
      for (int i = 0; i < 200000; ++i) {
        const double cosine = cosines(engine);
        const auto k = static_cast<size_t>(cosine * WT_COSINES);
        const double kept = reflectance(material, cosine, wavelength_m);
        broken += kept > bounds[k];
        largest[k] = std::max(largest[k], static_cast<float>(kept));
      }
      CHECK(broken == 0);
      for (size_t k = 1; k < WT_COSINES; ++k) CHECK(bounds[k] <= std::min(1.0f, 1.05f * largest[k] + 1e-6f));
      CHECK(bounds[0] == 1);  // grazing
    }
}

TEST_CASE("conductors, and slabs of very many wavelengths, are bounded by 1") {
  for (const float bound : reflectance_bounds(std::vector{slab(1, -5e7, 0.1)}, 0, 0.0857)) CHECK(bound == 1);
  for (const float bound : reflectance_bounds(std::vector{slab(5, -0.001, 1000)}, 0, 0.0107)) CHECK(bound == 1);
}
