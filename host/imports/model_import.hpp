// SPDX-License-Identifier: Apache-2.0
// Turns a city model into meshes: placed on the Earth, set on the ground, triangulated, one mesh per material.
#pragma once
#include <string>
#include <vector>

#include "imports/city_model.hpp"
#include "imports/scene_files.hpp"
#include "scene/georeference.hpp"

namespace wavetracer::imports {

struct PlacedModel {
  Georeference georeference;
  Extent network;                // bounds of options.net, in coordinates of the projection
  bool above_ellipsoid = false;  // heights are above the ellipsoid
};
// Converts the coordinates of the model to those of the scene, in metres, by the system that the file names. Throws
// InputError, and RuntimeError if PROJ has no database.
PlacedModel place_model(CityModel& model, const std::string& name, const ImportOptions& options);

struct ModelScene {
  std::vector<SceneMesh> meshes;  // the ground first
  Georeference georeference;
  ImportSummary summary;  // counts of objects that were built and left out; the files are not set
};
// Throws InputError if nothing can be built.
ModelScene build_model(CityModel model, const std::string& name, const ImportOptions& options);

}  // namespace wavetracer::imports
