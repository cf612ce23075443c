// Loads scenes: one call turns a configuration, or a file, into a Scene that is ready to trace.
// Assumes file names absolute or relative to the working folder (the config parser makes them absolute).
#pragma once
#include <filesystem>
#include <vector>

#include "scene/scene_wedges.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Loads config.scene.file, or builds the city of config.scene.generate; with wedges where config.trace.diffraction asks
// for them. Throws ConfigError or InputError.
Scene load_scene(const Config& config);

// Reads Mitsuba XML, PLY, OBJ or glTF, by content and else by suffix. scene.file and scene.generate are ignored.
// The frequency only chooses between laws of one material name (glass has two ranges).
Scene load_scene_file(const std::filesystem::path& path, const SceneConfig& scene,
                      const std::vector<MaterialConfig>& materials = {},
                      double frequency_hz = RadioConfig{}.frequency_hz, EdgeSearch edges = EdgeSearch::of_scene);

}  // namespace wavetracer
