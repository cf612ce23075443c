// SPDX-License-Identifier: Apache-2.0
// The shapes of vehicle types: sizes for the readers of trajectories, bodies for the scene.
// A type of a trajectory is a [[vehicle_type]], else a class of SUMO, else trajectories.default_type.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "motion/trajectories.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

class VehicleModels {
 public:
  // Loads the mesh files of all types. The configuration must outlive this. Throws ConfigError or InputError.
  explicit VehicleModels(const Config& config);

  // The types of [[vehicle_type]], sizes complete.
  const std::vector<VehicleType>& given_types() const { return given_types_; }
  // trajectories.default_type, where there is one.
  const std::optional<VehicleType>& default_type() const { return default_type_; }
  // The type of this name, as a reader of trajectories finds it. Empty where nothing knows the name.
  std::optional<VehicleType> find_type(std::string_view name) const;

  // The index into models() of a vehicle's body, which is built if it is new; empty if it has no body.
  std::optional<uint32_t> model_of(const VehicleType& type, std::string_view vehicle_id);
  // Each has its own file or kind, material and size.
  const std::vector<Scene>& models() const { return models_; }
  std::vector<Scene> take_models() && { return std::move(models_); }

 private:
  using Key = std::tuple<std::string, std::string, double, double, double>;  // kind or file, material, sizes

  const VehicleTypeConfig* row_of(std::string_view name) const;
  SceneConfig material_rules() const;
  const Scene& mesh_of(const VehicleTypeConfig& row);
  VehicleType sized(const VehicleTypeConfig& row);

  const Config& config_;
  std::map<std::pair<std::string, std::string>, Scene> meshes_;  // by file and material, as the file has them
  std::vector<VehicleType> given_types_;                         // in the order of Config::vehicle_types
  std::optional<VehicleType> default_type_;
  std::map<Key, uint32_t> index_;
  std::vector<Scene> models_;
};

// Lists what was said of the files of models when they were read, and of sizes that no vehicle has; each once, and
// nothing that was said of the scene.
std::vector<std::string> model_warnings(const std::vector<Scene>& models, const Scene& scene);

}  // namespace wavetracer
