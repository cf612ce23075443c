// SPDX-License-Identifier: Apache-2.0
// The mean over a rectangle of a product of two waves is a product of two sinc functions. Sines of differences are made
// of sines and cosines of each wave, so pairs need none. Point (m, q) of a set of Hammersley is in column m and row q
// of 32 x 32, and its place within these is q and m with their bits reversed. So a wave's phase there is a part of m
// and a part of q, and points need no sines either.
#include "coverage/cell_area.hpp"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include "radio/constants.hpp"

namespace wavetracer::coverage {
namespace {

constexpr size_t pairs_of_ports = 4, columns_of_points = 32;

// Half the phase of a wave across a side, with its sine and cosine.
struct HalfTurn {
  double half, sine, cosine;
  explicit HalfTurn(double half_phase) : half(half_phase), sine(std::sin(half_phase)), cosine(std::cos(half_phase)) {}
};

// Returns sin(x) / x of the difference x of two half turns.
double sinc(const HalfTurn& a, const HalfTurn& b) {
  constexpr double small = 1e-4;  // below it x^2 / 6 has all digits
  const double x = a.half - b.half;
  if (std::abs(x) < small) return 1 - x * x / 6;
  return (a.sine * b.cosine - a.cosine * b.sine) / x;
}

double mean_power(std::span<const PlaneWave> waves, const glm::dvec2& side_m) {
  std::vector<HalfTurn> across, up;
  for (const PlaneWave& wave : waves) {
    across.emplace_back(0.5 * wave.phase_rad_m.x * side_m.x);
    up.emplace_back(0.5 * wave.phase_rad_m.y * side_m.y);
  }
  double mean = 0;
  for (size_t i = 0; i < waves.size(); ++i) {
    double others = 0;  // parts of the pairs with later waves
    for (size_t j = i + 1; j < waves.size(); ++j) {
      double product = 0;
      for (size_t port = 0; port < pairs_of_ports; ++port) {
        const std::complex<double>&a = waves[i].field[port], &b = waves[j].field[port];
        product += a.real() * b.real() + a.imag() * b.imag();
      }
      others += product * sinc(across[i], across[j]) * sinc(up[i], up[j]);
    }
    mean += waves[i].power + 2 * others;
  }
  return std::max(mean, 0.0);
}

// Returns a number below 1 with the five bits of k reversed behind the point, in the middle of its part of 1/32.
double reversed(size_t k) {
  constexpr size_t bits = 5;
  size_t out = 0;
  for (size_t bit = 0; bit < bits; ++bit) out |= (k >> bit & 1) << (bits - 1 - bit);
  return (static_cast<double>(out) + 0.5) / columns_of_points;
}

// Returns the turn of a wave, exp(j phase), for column (or row) k: a part that its points share.
std::complex<double> turn_of(const glm::dvec2& phase_rad_m, const glm::dvec2& side_m, size_t k, bool column) {
  const double whole = static_cast<double>(k) / columns_of_points - 0.5, part = reversed(k) / columns_of_points;
  const glm::dvec2 place = column ? glm::dvec2(whole, part) : glm::dvec2(part, whole);
  return std::polar(1.0, glm::dot(phase_rad_m, place * side_m));
}

// Complex numbers with a place for each column, in two arrays, which compilers and processors take faster.
struct ColumnValues {
  std::array<double, columns_of_points> re{}, im{};
  void add_product(const std::complex<double>& factor, const ColumnValues& values) {
    const double x = factor.real(), y = factor.imag();
    for (size_t m = 0; m < columns_of_points; ++m) {
      re[m] += x * values.re[m] - y * values.im[m];
      im[m] += x * values.im[m] + y * values.re[m];
    }
  }
};

// Tells which pairs of ports a wave reaches.
std::vector<size_t> used_ports(std::span<const PlaneWave> waves) {
  std::vector<size_t> out;
  for (size_t port = 0; port < pairs_of_ports; ++port)
    if (std::ranges::any_of(waves, [port](const PlaneWave& wave) { return std::norm(wave.field[port]) > 0; }))
      out.push_back(port);
  return out;
}

double variance_of_points(std::span<const PlaneWave> waves, const glm::dvec2& side_m) {
  std::vector<ColumnValues> turns(waves.size());
  for (size_t i = 0; i < waves.size(); ++i)
    for (size_t m = 0; m < columns_of_points; ++m) {
      const std::complex<double> turn = turn_of(waves[i].phase_rad_m, side_m, m, true);
      turns[i].re[m] = turn.real();
      turns[i].im[m] = turn.imag();
    }
  const std::vector<size_t> ports = used_ports(waves);
  std::vector<double> powers;
  std::vector<std::complex<double>> of_row(waves.size());
  for (size_t q = 0; q < columns_of_points; ++q) {
    for (size_t i = 0; i < waves.size(); ++i) of_row[i] = turn_of(waves[i].phase_rad_m, side_m, q, false);
    std::array<double, columns_of_points> power{};
    for (const size_t port : ports) {
      ColumnValues sum;
      for (size_t i = 0; i < waves.size(); ++i) sum.add_product(of_row[i] * waves[i].field[port], turns[i]);
      for (size_t m = 0; m < columns_of_points; ++m) power[m] += sum.re[m] * sum.re[m] + sum.im[m] * sum.im[m];
    }
    powers.insert(powers.end(), power.begin(), power.end());
  }
  double mean = 0, squares = 0;
  for (const double power : powers) mean += power / static_cast<double>(powers.size());
  for (const double power : powers) squares += (power - mean) * (power - mean);
  return squares / static_cast<double>(powers.size());
}

CellSides sides_of(const Map& map) {
  CellSides out{.length_m = map.step_m};
  if (map.plane) out.direction = {{{map.plane->direction, 0}, {0, 0, 1}}};
  return out;
}

// Returns the rows of the paths from each cell's server, cell by cell: those of cell k are first[k] to first[k + 1]
// - 1.
struct RowsOfCells {
  std::vector<size_t> first, rows;
  RowsOfCells(const Paths& paths, std::span<const uint32_t> cell_of, std::span<const uint32_t> server_of)
      : first(server_of.size() + 1, 0) {
    const auto each = [&](const auto& visit) {
      for (size_t i = 0; i < paths.size(); ++i)
        if (const uint32_t k = cell_of[paths.rx[i]]; k < server_of.size() && server_of[k] == paths.tx[i]) visit(k, i);
    };
    each([&](uint32_t k, size_t) { ++first[k + 1]; });
    for (size_t k = 0; k < server_of.size(); ++k) first[k + 1] += first[k];
    std::vector<size_t> next = first;
    rows.resize(first.back());
    each([&](uint32_t k, size_t i) { rows[next[k]++] = i; });
  }
};

PlaneWave wave_of(const Paths& paths, size_t i, double frequency_hz, const std::array<glm::dvec3, 2>& sides) {
  const double theta = paths.aoa_theta_rad[i], phi = paths.aoa_phi_rad[i], turns = frequency_hz * paths.delay_s[i],
               phase_rad_m = 2 * std::numbers::pi * frequency_hz / speed_of_light_m_s;
  const glm::dvec3 from{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  const std::complex<double> carrier = std::polar(1.0, -2 * std::numbers::pi * (turns - std::floor(turns)));
  PlaneWave out{{}, phase_rad_m * glm::dvec2(glm::dot(from, sides[0]), glm::dot(from, sides[1])), 0};
  for (size_t port = 0; port < pairs_of_ports; ++port) {
    out.field[port] = paths.a[i][port] * carrier;
    out.power += std::norm(out.field[port]);
  }
  return out;
}

}  // namespace

AreaPower area_power(std::vector<PlaneWave> waves, const glm::dvec2& side_m) {
  double weak = 0;  // power of the waves that do not interfere
  if (waves.size() > most_interfering_waves) {
    const auto end = waves.begin() + most_interfering_waves;
    std::ranges::nth_element(waves, end, std::greater<>(), &PlaneWave::power);
    for (auto wave = end; wave != waves.end(); ++wave) weak += wave->power;
    waves.erase(end, waves.end());
  }
  return {weak + mean_power(waves, side_m), variance_of_points(waves, side_m)};
}

AreaLevels area_levels(const Paths& paths, std::span<const size_t> rows, double frequency_hz, const CellSides& sides) {
  constexpr double even = 1e-12;  // smaller relative variances are rounding errors
  std::vector<PlaneWave> waves;
  for (const size_t row : rows) waves.push_back(wave_of(paths, row, frequency_hz, sides.direction));
  if (waves.empty()) return {};
  const AreaPower power = area_power(std::move(waves), sides.length_m);
  if (!(power.mean > 0)) return {};
  const double fading = power.variance / (power.mean * power.mean);
  return {10 * std::log10(power.mean), 10 * std::log10(fading > even ? fading : 0)};
}

void add_areas(const Paths& paths, double frequency_hz, std::span<const uint32_t> cell_of,
               std::span<const uint32_t> server_of, Map& map) {
  const RowsOfCells of_cells(paths, cell_of, server_of);
  const CellSides sides = sides_of(map);
  for (size_t k = 0; k < server_of.size(); ++k) {
    const std::span rows(of_cells.rows.data() + of_cells.first[k], of_cells.first[k + 1] - of_cells.first[k]);
    const AreaLevels levels = area_levels(paths, rows, frequency_hz, sides);
    map.cells[k].cell_mean_db = levels.cell_mean_db;
    map.cells[k].fading_db = levels.fading_db;
  }
}

}  // namespace wavetracer::coverage
