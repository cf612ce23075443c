// SPDX-License-Identifier: Apache-2.0
// A receiver that is also a transmitter is one antenna, and shares its errors.
#include "accuracy/input_variation.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include "accuracy/latin_hypercube.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::accuracy {
namespace {

constexpr size_t no_column = std::numeric_limits<size_t>::max(), columns_of_end = 3, columns_of_vehicle = 2;

bool is_varied(const Varied& varied, Input input) { return varied[static_cast<size_t>(input)]; }

}  // namespace

Config varied_config(const std::string& file, const std::vector<std::string>& sets) {
  Config config = load_config(file, sets);
  if (!config.live_vehicles.empty())
    throw ConfigError(file +
                      ": its [[live_vehicle]] tables need a client that sends poses, so nothing can be varied; "
                      "give trajectories instead of them");
  config.cache.kind = "none";
  config.output.waypoints = 0;
  config.radars.clear();
  return config;
}

InputVariation::InputVariation(const RunPlan& plan, const InputErrors& errors, uint32_t samples, uint64_t seed,
                               const std::vector<bool>& at_rest)
    : plan_(plan),
      errors_(errors),
      materials_(
          make_field_tables(plan.scene, plan.asked, plan.world.fleet.models, plan.world.fleet.instances).materials) {
  const std::vector<uint32_t>& twins = plan.world.twins.transmitter_of_receiver;
  size_t next = columns_of_end * plan.world.transmitters.ends.size();
  for (size_t i = 0; i < at_rest.size(); ++i) {
    if (at_rest[i]) {
      receivers_.push_back(no_column);
      continue;
    }
    receivers_.push_back(twins[i] == no_end ? next : columns_of_end * twins[i]);
    next += columns_of_end;  // twins leave theirs unused
  }
  vehicles_ = next;
  first_material_ = vehicles_ + columns_of_vehicle * plan.world.fleet.instances.size();
  hypercube_ = normal_hypercube(samples, first_material_ + materials_.size(), seed);
}

Varied InputVariation::varied() const {
  const auto fixed = [](const EndState& end) { return end.instance == no_instance; };
  const WorldState state = plan_.world.state(0);
  bool moves = std::ranges::any_of(state.transmitters, fixed);
  for (size_t i = 0; i < receivers_.size(); ++i)
    moves = moves || (receivers_[i] != no_column && fixed(state.receivers[i]));
  return {errors_.position_m > 0 && moves, errors_.height_m > 0, errors_.permittivity > 0,
          errors_.vehicles_m > 0 && !state.instances.empty()};
}

glm::dvec3 InputVariation::vehicle_shift(const std::vector<double>& row, size_t i) const {
  const size_t at = vehicles_ + columns_of_vehicle * i;
  return glm::dvec3(row[at], row[at + 1], 0) * errors_.vehicles_m;
}

void InputVariation::move(EndState& end, const std::vector<double>& row, size_t at, const Varied& varied) const {
  const bool fixed = end.instance == no_instance;
  if (fixed && is_varied(varied, Input::position))
    end.position_m += glm::dvec3(row[at], row[at + 1], 0) * errors_.position_m;
  if (is_varied(varied, Input::height)) end.position_m.z += row[at + 2] * errors_.height_m;
  if (!fixed && is_varied(varied, Input::vehicles)) end.position_m += vehicle_shift(row, end.instance);
}

void InputVariation::apply(size_t sample, const Varied& varied, WorldState& state,
                           std::vector<device::wt_material>& materials) const {
  const std::vector<double>& row = hypercube_[sample];
  for (size_t i = 0; i < state.transmitters.size(); ++i) move(state.transmitters[i], row, columns_of_end * i, varied);
  for (size_t i = 0; i < state.receivers.size(); ++i)
    if (receivers_[i] != no_column) move(state.receivers[i], row, receivers_[i], varied);
  if (is_varied(varied, Input::vehicles))
    for (size_t i = 0; i < state.instances.size(); ++i) state.instances[i].position_m += vehicle_shift(row, i);
  if (!is_varied(varied, Input::permittivity)) return;
  for (size_t i = 0; i < materials.size(); ++i) {
    const double factor = std::exp(errors_.permittivity * row[first_material_ + i]);
    double* const permittivity = materials[i].permittivity;
    permittivity[0] = 1 + (permittivity[0] - 1) * factor;
    permittivity[1] *= factor;
  }
}

}  // namespace wavetracer::accuracy
