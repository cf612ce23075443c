// SPDX-License-Identifier: Apache-2.0
// Writes the city and the vehicles of a run as DeepMIMO's Scene: one triangle mesh per object, and a list of materials.
// Files that can no longer be loaded are left out with a warning; the channels do not need them.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include "base/pending_folder.hpp"
#include "convert/convert.hpp"
#include "results/saved_world.hpp"

namespace wavetracer {

struct SceneSize {
  size_t objects = 0, vertices = 0, triangles = 0;
};

class DeepmimoScene {
 public:
  DeepmimoScene(const SavedRun& run, Warnings& warnings);
  const Config& config() const { return world_.config; }
  nlohmann::ordered_json materials() const;
  // Writes vertices.npz, faces.npz, materials.npz and objects.json into a folder of the scenario.
  SceneSize write(const PendingFolder& folder, const std::filesystem::path& where, const SavedFrame& frame) const;

 private:
  SavedWorld world_;
  std::vector<std::string> vehicles_;  // names, one for each row of /instances
  // Index of the first material of the scene and of each model in the list of all materials.
  std::vector<uint32_t> first_material_;
  double frequency_hz_ = 0;
};

// Replaces bytes of names that are not UTF-8.
std::string json_text(const nlohmann::ordered_json& value);

}  // namespace wavetracer
