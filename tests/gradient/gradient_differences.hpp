// SPDX-License-Identifier: Apache-2.0
// Derivatives of GradientModel against central differences of FieldModel.
#pragma once
#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <utility>

#include "gradient/gradient_world.hpp"

namespace wavetracer::test {

// All that is differentiated, of one row: a, then delay times 1e9 (which gives it a size near 1), then angles.
using Columns = std::vector<double>;
inline Columns columns_of(const Paths& paths, size_t row) {
  Columns out;
  for (const auto& a : paths.a[row]) out.insert(out.end(), {a.real(), a.imag()});
  out.insert(out.end(), {paths.delay_s[row] * 1e9, paths.aod_theta_rad[row], paths.aod_phi_rad[row],
                         paths.aoa_theta_rad[row], paths.aoa_phi_rad[row]});
  return out;
}
inline Columns slopes_of(const PathGradients& of, size_t entry) {
  Columns out;
  for (const auto& a : of.a[entry]) out.insert(out.end(), {a.real(), a.imag()});
  out.insert(out.end(), {of.delay_s[entry] * 1e9, of.aod_theta_rad[entry], of.aod_phi_rad[entry],
                         of.aoa_theta_rad[entry], of.aoa_phi_rad[entry]});
  return out;
}

// Fields where a parameter is larger by a step.
using Moved = std::function<Paths(double step)>;

// Central differences of the fourth order, for all rows.
inline std::vector<Columns> differences(const Moved& moved, double step) {
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

inline double size_of(const Columns& v, size_t begin, size_t end) {
  double sum = 0;
  for (size_t i = begin; i < end; ++i) sum += v[i] * v[i];
  return std::sqrt(sum);
}

// The relative error of the coefficients' derivatives and, if larger, that of the others.
inline double error_of(const Columns& exact, const Columns& difference, const Columns& value) {
  Columns apart;
  for (size_t i = 0; i < exact.size(); ++i) apart.push_back(exact[i] - difference[i]);
  // Differences of numbers that hardly change are rounding: of 1e-9 of the number, they are not compared.
  const double least = 1e-9 * size_of(value, 0, 8);
  const double of_a = size_of(apart, 0, 8) / std::max(size_of(exact, 0, 8), least + 1e-300);
  return std::max(of_a, size_of(apart, 8, 13) / std::max(size_of(exact, 8, 13), 1e-3));
}

// The material of a record, all materials of the scene being used: layers of walls follow the materials, each wall with
// one record more.
inline Material& material_of(Scene& scene, uint32_t record) {
  if (record < scene.materials.size()) return scene.materials[record];
  auto first = static_cast<uint32_t>(scene.materials.size());
  for (Material& wall : scene.materials) {
    if (wall.layers.empty()) continue;
    if (record - first < wall.layers.size()) return wall.layers[record - first];
    first += static_cast<uint32_t>(wall.layers.size()) + 1;
  }
  throw std::logic_error("no material has this record");
}

inline GradientWorld with_material(GradientWorld world, uint32_t material, PathParameter parameter, double step) {
  Material& m = material_of(world.scene, material);
  if (parameter == PathParameter::permittivity) m.a += step;
  if (parameter == PathParameter::conductivity) m.c += step;
  if (parameter == PathParameter::thickness) m.thickness_m += step;
  if (parameter == PathParameter::scattering) m.scattering += step;
  if (parameter == PathParameter::attenuation) *m.vegetation->attenuation_db_m += step;
  if (parameter == PathParameter::most_attenuation) *m.vegetation->max_attenuation_db += step;
  return world;
}

// Moves all transmitters or receivers, or turns their antennas.
inline WorldState with_ends(WorldState state, PathParameter parameter, double step) {
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

// Fields where a parameter of all paths is larger by a step.
inline Paths moved_paths(const GradientWorld& world, PathParameter parameter, uint32_t material, double step) {
  if (material != no_material_number) {
    const GradientWorld moved = with_material(world, material, parameter, step);
    return FieldModel(moved.scene, moved.config).compute(0, world.geometry(world.state), world.state);
  }
  const WorldState state = with_ends(world.state, parameter, step);
  return FieldModel(world.scene, world.config).compute(0, world.geometry(state), state);
}

// Differences for four sizes of steps, since a large one may go over a line of a pattern; a half space has no
// thickness, so there are none.
inline std::vector<std::vector<Columns>> all_differences(const GradientWorld& world, PathParameter parameter,
                                                         uint32_t material) {
  std::vector<std::vector<Columns>> out;
  double size = 1;
  Scene scene = world.scene;
  if (parameter == PathParameter::thickness) size = 1e-2;
  if (parameter == PathParameter::thickness && std::isinf(material_of(scene, material).thickness_m)) return out;
  if (parameter == PathParameter::conductivity) size = 0.3 * material_of(scene, material).c;
  for (const double share : {1e-2, 1e-3, 1e-4, 1e-5})
    out.push_back(
        differences([&](double step) { return moved_paths(world, parameter, material, step); }, size * share));
  return out;
}

// The rows whose field jumps by rounding: it is another one where an end is 10 nanometres away. Differences say nothing
// of them.
inline std::vector<bool> jumping_rows(const GradientWorld& world) {
  const Paths paths = moved_paths(world, PathParameter::tx_x, no_material_number, 0);
  std::vector<bool> out(paths.size());
  for (int i = 0; i < 6; ++i)
    for (const double step : {-1e-8, -1e-9, 1e-9, 1e-8}) {
      const auto parameter = static_cast<PathParameter>(static_cast<int>(PathParameter::tx_x) + i);
      const Paths beside = moved_paths(world, parameter, no_material_number, step);
      for (size_t row = 0; row < paths.size(); ++row) {
        const Columns a = columns_of(paths, row), b = columns_of(beside, row);
        Columns apart;
        for (size_t k = 0; k < 8; ++k) apart.push_back(a[k] - b[k]);
        if (size_of(apart, 0, 8) > 1e-4 * size_of(a, 0, 8)) out[row] = true;
      }
    }
  return out;
}

// The worst error of each parameter over all rows of the world, each at the best of four steps. All rows have all
// derivatives. jumps: the number of rows that are not compared.
inline std::map<PathParameter, double> worst_errors(const GradientWorld& world, size_t& jumps) {
  const GradientModel model(world.scene, world.config);
  const ModelGradients gradients = model.compute(0, world.geometry(world.state), world.state, {.orientations = true});
  std::map<std::pair<PathParameter, uint32_t>, std::vector<std::vector<Columns>>> found;
  std::map<PathParameter, double> worst;
  const std::vector<bool> jumping = jumping_rows(world);
  jumps = static_cast<size_t>(std::ranges::count(jumping, true));
  for (size_t row = 0; row < gradients.paths.size(); ++row)
    for (uint64_t entry = gradients.first[row]; entry < gradients.first[row + 1]; ++entry) {
      CAPTURE(row);
      const PathParameter parameter = gradients.parameter[entry];
      const uint32_t material = gradients.material[entry];
      CHECK(gradients.gap[entry] == GradientGap::none);
      if (jumping[row]) continue;
      const auto [place, is_new] = found.try_emplace({parameter, material});
      if (is_new) place->second = all_differences(world, parameter, material);
      const Columns exact = slopes_of(gradients, entry), value = columns_of(gradients.paths, row);
      double error = place->second.empty() ? size_of(exact, 0, exact.size()) : infinity;
      for (const auto& rows : place->second) error = std::min(error, error_of(exact, rows[row], value));
      worst[parameter] = std::max(worst[parameter], error);
    }
  return worst;
}

// Checks that differences agree to 1e-6 for this number of parameters. most_jumps: see jumping_rows.
inline void check_worst(const GradientWorld& world, size_t parameters, size_t most_jumps = 0) {
  size_t jumps = 0;
  const std::map<PathParameter, double> worst = worst_errors(world, jumps);
  CHECK(jumps <= most_jumps);
  CHECK(worst.size() == parameters);
  for (const auto& [parameter, error] : worst) {
    CAPTURE(static_cast<int>(parameter));
    CHECK(error < 1e-6);
  }
}

}  // namespace wavetracer::test
