// From a city model to meshes: placed on the earth, set on the ground, triangulated, one mesh for each material.
#pragma once
#include <string>
#include <vector>

#include "imports/city_model.hpp"
#include "imports/scene_files.hpp"
#include "scene/georeference.hpp"

namespace wavetracer::imports {

struct PlacedModel {
  Georeference georeference;
  Extent network;                // of options.net, in coordinates of the projection
  bool above_ellipsoid = false;  // what heights are measured from
};
// Turns the coordinates of the model into those of the scene, in metres, by the system that the file names. Throws
// InputError, and RuntimeError where PROJ has no database.
PlacedModel place_model(CityModel& model, const std::string& name, const ImportOptions& options);

struct ModelScene {
  std::vector<SceneMesh> meshes;  // the ground first
  Georeference georeference;
  ImportSummary summary;  // what was built and left out; without the files
};
// Throws InputError where nothing can be built.
ModelScene build_model(CityModel model, const std::string& name, const ImportOptions& options);

}  // namespace wavetracer::imports
