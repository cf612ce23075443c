// SPDX-License-Identifier: Apache-2.0
// Rows are made as on devices, in the order of links; then they are computed row by row, on all cores.
#include "radio/fields.hpp"

#include "radio/antenna.hpp"
#include "radio/field_frame.hpp"

namespace wavetracer {
namespace {

glm::dvec3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

FieldModel::FieldModel(const Scene& scene, const Config& config, std::span<const Scene> models,
                       std::span<const Instance> instances)
    : scene_(scene),
      models_(models),
      instances_(instances.begin(), instances.end()),
      tables_(make_field_tables(scene, config, models, instances)) {
  const auto still = [&](const std::vector<RadioEnd>& ends, SharedList<EndState>& states) {
    for (const RadioEnd& end : ends)
      states.push_back({.position_m = to_vector(end.position_m) - scene.origin_m,
                        .rotation = rotation_of(end.orientation_deg),
                        .velocity_m_s = to_vector(end.velocity_m_s)});
  };
  still(config.transmitters, still_.transmitters);
  still(config.receivers, still_.receivers);
}

Paths FieldModel::compute(uint32_t frame, const PathGeometry& geometry, const WorldState& state,
                          LeftOut* left_out) const {
  const FieldFrame rows = make_field_frame(tables_, scene_, models_, instances_, geometry, state, left_out);
  return paths_of(rows, tables_, scene_.origin_m, frame);
}

Paths compute_paths(const Scene& scene, const Config& config, uint32_t frame, const PathGeometry& geometry) {
  return FieldModel(scene, config).compute(frame, geometry);
}

}  // namespace wavetracer
