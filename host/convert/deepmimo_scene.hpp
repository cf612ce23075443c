// The city and the vehicles of a run as DeepMIMO's Scene: a triangle mesh an object, and a list of materials.
// What can no longer be loaded is left out with a warning; the channels do not need it.
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
  // vertices.npz, faces.npz, materials.npz and objects.json in a folder of the scenario.
  SceneSize write(const PendingFolder& folder, const std::filesystem::path& where, const SavedFrame& frame) const;

 private:
  SavedWorld world_;
  std::vector<std::string> vehicles_;     // names, a row of /instances each
  std::vector<uint32_t> first_material_;  // of the scene and of each model, in the list of all of them
  double frequency_hz_ = 0;
};

// What is not UTF-8 in names is replaced.
std::string json_text(const nlohmann::ordered_json& value);

}  // namespace wavetracer
