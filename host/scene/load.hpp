// SPDX-License-Identifier: Apache-2.0
// Loads scenes: one call turns a configuration or a file into a Scene that is ready to trace.
// File names are absolute or relative to the working folder (the config parser makes them absolute).
#pragma once
#include <filesystem>
#include <vector>

#include "scene/scene_wedges.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Loads config.scene.file, or builds the city of config.scene.generate; wedges are found if config.trace.diffraction
// asks for them. Throws ConfigError or InputError.
Scene load_scene(const Config& config);

// Reads Mitsuba XML, PLY, OBJ or glTF; the format is found from the content, or else from the suffix. scene.file and
// scene.generate are ignored. The frequency only chooses between laws of one material name (glass has two ranges).
Scene load_scene_file(const std::filesystem::path& path, const SceneConfig& scene,
                      const std::vector<MaterialConfig>& materials = {},
                      double frequency_hz = RadioConfig{}.frequency_hz, EdgeSearch edges = EdgeSearch::of_scene);

}  // namespace wavetracer
