// SPDX-License-Identifier: Apache-2.0
// Helpers of the hard suite: fields of links summed over their paths, kinds of paths, errors in decibels. Ends have two
// ports each, V and H, as config_of makes them.
#pragma once
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "hard/cases.hpp"
#include "simulation/run.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer::test {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr double frequency_hz = 5.9e9;  // the default of a configuration
constexpr double wavelength_m = speed_of_light / frequency_hz;
constexpr double other_bands_hz[] = {0.7e9, 28e9, 60e9};

// h(f) between ports, element 2 r + t from tx port t to rx port r.
using Response = std::array<Complex, 4>;

// Returns the sum of a exp(-j 2 pi f tau) of the paths from tx to each receiver, for paths up to this length.
inline std::vector<Response> responses(const Paths& paths, uint32_t tx, size_t receivers,
                                       double longest_m = std::numeric_limits<double>::infinity(),
                                       double hz = frequency_hz) {
  std::vector<Response> sums(receivers);
  for (size_t i = 0; i < paths.size(); ++i) {
    if (paths.tx[i] != tx || paths.delay_s[i] * speed_of_light > longest_m) continue;
    const Complex turn = std::polar(1.0, -2 * pi * hz * paths.delay_s[i]);
    for (size_t k = 0; k < 4; ++k) sums[paths.rx[i]][k] += paths.a[i][k] * turn;
  }
  return sums;
}

// The same at a frequency, of all paths.
inline std::vector<Response> responses_at(double hz, const Paths& paths, uint32_t tx, size_t receivers) {
  return responses(paths, tx, receivers, std::numeric_limits<double>::infinity(), hz);
}

inline double friis(double length_m, double hz = frequency_hz) { return speed_of_light / hz / (4 * pi * length_m); }
inline double decibels(double amplitude) { return 20 * std::log10(amplitude); }

// The kinds of a path's interactions in order, "" the line of sight: R, S, T, D.
inline std::string kinds_of(const Paths& paths, size_t i) {
  std::string out;
  for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
    const InteractionKind* kind = find_interaction(paths.vertex_interaction[k]);
    out += kind ? static_cast<char>(std::toupper(kind->word.front())) : '?';
  }
  return out;
}

// Rows of one link.
inline std::vector<size_t> rows_between(const Paths& paths, uint32_t tx, uint32_t rx) {
  std::vector<size_t> rows;
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.tx[i] == tx && paths.rx[i] == rx) rows.push_back(i);
  return rows;
}

// Kinds of a link's paths, sorted by delay, as "LOS R TRT".
inline std::string kinds_between(const Paths& paths, uint32_t tx, uint32_t rx) {
  std::string out;
  for (const size_t i : rows_between(paths, tx, rx)) {
    const std::string kinds = kinds_of(paths, i);
    out += (out.empty() ? "" : " ") + (kinds.empty() ? "LOS" : kinds);
  }
  return out;
}

// The largest difference of the paths of two runs, row by row; infinite if their number or kinds differ.
struct Difference {
  double gain_db = 0, delay_s = 0;
};
inline Difference difference(const Paths& a, const Paths& b) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (a.tx != b.tx || a.rx != b.rx || a.vertex_interaction != b.vertex_interaction) return {never, never};
  Difference worst;
  for (size_t i = 0; i < a.size(); ++i) {
    worst.gain_db = std::max(worst.gain_db, std::abs(a.gain_db[i] - b.gain_db[i]));
    worst.delay_s = std::max(worst.delay_s, std::abs(a.delay_s[i] - b.delay_s[i]));
  }
  return worst;
}

// Counts values of the result that are not finite; there should be none.
inline double not_finite(const Paths& paths) {
  size_t count = 0;
  const auto look = [&](double x) { count += !std::isfinite(x); };
  for (size_t i = 0; i < paths.size(); ++i) {
    for (const double x : {paths.delay_s[i], paths.gain_db[i], paths.doppler_hz[i], paths.aod_theta_rad[i],
                           paths.aod_phi_rad[i], paths.aoa_theta_rad[i], paths.aoa_phi_rad[i]})
      look(x);
    for (const Complex& x : paths.a[i]) look(std::abs(x));
  }
  for (const glm::dvec3& p : paths.vertex_position_m) look(p.x + p.y + p.z);
  return static_cast<double>(count);
}

// Paths of a link without diffraction.
inline size_t geometrical_paths(const Paths& paths, uint32_t tx, uint32_t rx) {
  size_t count = 0;
  for (const size_t i : rows_between(paths, tx, rx)) count += kinds_of(paths, i).find('D') == std::string::npos;
  return count;
}

// The distances of receivers from a shadow boundary, along the circle about the edge: exactly on it, 1 nm beside it,
// then doubling up to 0.03 mm, with steps of at most 2 milliradians of phase. The first and the last, at 1 mm, are
// clearly on one side.
inline std::vector<double> boundary_steps(double hz = frequency_hz) {
  std::vector<double> out{0};
  for (double d = 1e-9; d < 4e-5; d += std::min(d, 2e-3 * speed_of_light / (2 * pi * hz)))
    out.insert(out.end(), {-d, d});
  out.insert(out.end(), {-1e-3, 1e-3});
  std::sort(out.begin(), out.end());
  return out;
}

// The field of tx port t at the receivers of a boundary: its largest deviation from the straight line through the
// fields of the two receivers before, divided by its size. It contains a jump completely; a smooth field only leaves
// its curvature, which is largest for standing waves: (2 * 2e-3)^2 / 2, that is 8e-6.
inline double boundary_jump(const std::vector<double>& at_m, const std::vector<Response>& h, size_t first, size_t t) {
  double worst = 0, size = 0;
  for (size_t i = 3; i + 1 < at_m.size(); ++i) {
    const double ratio = (at_m[i] - at_m[i - 1]) / (at_m[i - 1] - at_m[i - 2]);
    double square = 0, field = 0;
    for (const size_t k : {t, 2 + t}) {
      const Complex &a = h[first + i - 2][k], &b = h[first + i - 1][k], &c = h[first + i][k];
      square += std::norm(c - b - ratio * (b - a));
      field += std::norm(c);
    }
    worst = std::max(worst, std::sqrt(square));
    size = std::max(size, std::sqrt(field));
  }
  return worst / size;
}

inline FrameResult run(const Config& config, const std::string& device) {
  return Simulation(config, device).run_frame(0);
}

}  // namespace wavetracer::test
