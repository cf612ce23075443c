// SPDX-License-Identifier: Apache-2.0
// Derivatives of paths against differences of the fields of FieldModel, and of delays against their closed form.
#include <doctest/doctest.h>

#include <cstring>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <string>

#include "gradient/gradient_world.hpp"

using namespace wavetracer;
using test::dvec3;
using test::GradientWorld;

namespace {

// All that is differentiated, of one row: a, then delay times 1e9 (which gives it a size near 1), then angles.
using Columns = std::vector<double>;
Columns columns_of(const Paths& paths, size_t row) {
  Columns out;
  for (const auto& a : paths.a[row]) out.insert(out.end(), {a.real(), a.imag()});
  out.insert(out.end(), {paths.delay_s[row] * 1e9, paths.aod_theta_rad[row], paths.aod_phi_rad[row],
                         paths.aoa_theta_rad[row], paths.aoa_phi_rad[row]});
  return out;
}
Columns slopes_of(const PathGradients& of, size_t entry) {
  Columns out;
  for (const auto& a : of.a[entry]) out.insert(out.end(), {a.real(), a.imag()});
  out.insert(out.end(), {of.delay_s[entry] * 1e9, of.aod_theta_rad[entry], of.aod_phi_rad[entry],
                         of.aoa_theta_rad[entry], of.aoa_phi_rad[entry]});
  return out;
}

// Fields where a parameter is larger by a step.
using Moved = std::function<Paths(double step)>;

// Central differences of the fourth order, for all rows.
std::vector<Columns> differences(const Moved& moved, double step) {
  const Paths a = moved(-2 * step), b = moved(-step), c = moved(step), d = moved(2 * step);
  std::vector<Columns> out;
  for (size_t row = 0; row < a.size(); ++row) {
    const Columns pa = columns_of(a, row), pb = columns_of(b, row), pc = columns_of(c, row), pd = columns_of(d, row);
    Columns slopes;
    for (size_t i = 0; i < pa.size(); ++i) slopes.push_back((8 * (pc[i] - pb[i]) - (pd[i] - pa[i])) / (12 * step));
    out.push_back(slopes);
  }
  return out;
}

double size_of(const Columns& v, size_t begin, size_t end) {
  double sum = 0;
  for (size_t i = begin; i < end; ++i) sum += v[i] * v[i];
  return std::sqrt(sum);
}

// The relative error of the coefficients' derivatives and, if larger, that of the others.
double error_of(const Columns& exact, const Columns& difference, const Columns& value) {
  Columns apart;
  for (size_t i = 0; i < exact.size(); ++i) apart.push_back(exact[i] - difference[i]);
  // Differences of numbers that hardly change are rounding: of 1e-9 of the number, they are not compared.
  const double least = 1e-9 * size_of(value, 0, 8);
  const double of_a = size_of(apart, 0, 8) / std::max(size_of(exact, 0, 8), least + 1e-300);
  return std::max(of_a, size_of(apart, 8, 13) / std::max(size_of(exact, 8, 13), 1e-3));
}

GradientWorld with_material(GradientWorld world, uint32_t material, PathParameter parameter, double step) {
  Material& m = world.scene.materials[material];
  if (parameter == PathParameter::permittivity) m.a += step;
  if (parameter == PathParameter::conductivity) m.c += step;
  if (parameter == PathParameter::thickness) m.thickness_m += step;
  if (parameter == PathParameter::scattering) m.scattering += step;
  return world;
}

// Moves all transmitters or receivers, or turns their antennas.
WorldState with_ends(WorldState state, PathParameter parameter, double step) {
  const int number = static_cast<int>(parameter) - static_cast<int>(PathParameter::tx_x);
  const bool turns = number >= 6;
  auto& ends = number % 6 < 3 ? state.transmitters.edit() : state.receivers.edit();
  dvec3 axis{0};
  axis[number % 3] = 1;
  for (EndState& end : ends) {
    if (turns)
      end.rotation = glm::dmat3(glm::rotate(glm::dmat4(1.0), step, axis)) * end.rotation;
    else
      end.position_m += step * axis;
  }
  return state;
}

// The worst error of each parameter over all rows of the world, each at the best of three steps.
std::map<PathParameter, double> worst_errors(const GradientWorld& world) {
  const GradientModel model(world.scene, world.config);
  const PathGradients gradients =
      model.compute(0, world.geometry(world.state), world.state, {.orientations = true});
  std::map<std::pair<PathParameter, uint32_t>, std::vector<std::vector<Columns>>> found;
  std::map<PathParameter, double> worst;
  for (size_t row = 0; row < gradients.paths.size(); ++row) {
    CAPTURE(row);
    for (uint64_t entry = gradients.first[row]; entry < gradients.first[row + 1]; ++entry) {
      const PathParameter parameter = gradients.parameter[entry];
      const uint32_t material = gradients.material[entry];
      CHECK(gradients.gap[entry] == GradientGap::none);
      auto& steps = found[{parameter, material}];
      const bool of_material = material != no_material_number;
      if (steps.empty())
        for (const double share : {1e-2, 1e-3, 1e-4}) {
          if (of_material && parameter == PathParameter::thickness &&
              std::isinf(world.scene.materials[material].thickness_m))
            break;
          const double size = parameter == PathParameter::thickness      ? 1e-2
                              : parameter == PathParameter::conductivity ? 0.3 * world.scene.materials[material].c
                                                                         : 1;
          steps.push_back(differences(
              [&](double step) {
                if (of_material) {
                  const GradientWorld moved = with_material(world, material, parameter, step);
                  return FieldModel(moved.scene, moved.config).compute(0, world.geometry(world.state), world.state);
                }
                const WorldState state = with_ends(world.state, parameter, step);
                return FieldModel(world.scene, world.config).compute(0, world.geometry(state), state);
              },
              size * share));
        }
      const Columns exact = slopes_of(gradients, entry), value = columns_of(gradients.paths, row);
      double error = test::infinity;
      for (const auto& rows : steps) error = std::min(error, error_of(exact, rows[row], value));
      if (steps.empty()) error = size_of(exact, 0, exact.size());  // a half space has no thickness
      worst[parameter] = std::max(worst[parameter], error);
      if (error > 1e-6) MESSAGE("row ", row, " parameter ", static_cast<int>(parameter), " error ", error);
    }
  }
  return worst;
}

void check_world(uint64_t seed, const std::vector<std::vector<uint8_t>>& kinds, int count, size_t parameters) {
  CAPTURE(seed);
  GradientWorld world(seed);
  std::mt19937_64 random(seed);
  for (const auto& of_path : kinds) test::add_random(world, of_path, count, random);
  const std::map<PathParameter, double> worst = worst_errors(world);
  CHECK(worst.size() == parameters);
  for (const auto& [parameter, error] : worst) {
    MESSAGE("worst ", static_cast<int>(parameter), " ", error);
    CAPTURE(static_cast<int>(parameter));
    CHECK(error < 1e-6);
  }
}

constexpr uint8_t R = reflection, T = transmission, D = diffraction, S = scattering;

}  // namespace

TEST_CASE("derivatives of paths without edges are those of differences") {
  for (const uint64_t seed : {1, 2, 3})
    check_world(seed, {{}, {R}, {T}, {R, R}, {R, T}, {T, R, R}, {S}, {R, S}, {S, T}, {R, S, R}}, 4, 16);
}

TEST_CASE("derivatives of paths over one edge are those of differences") {
  for (const uint64_t seed : {4, 5, 6}) check_world(seed, {{D}, {R, D}, {D, R}, {R, D, T}}, 5, 16);
}

TEST_CASE("derivatives of paths over two edges and more are those of differences") {
  for (const uint64_t seed : {7, 8, 9}) check_world(seed, {{D, D}, {D, R, D}, {D, D, D}}, 5, 16);
}
