// SPDX-License-Identifier: Apache-2.0
// Mitsuba 3 XML scenes, the format of Sionna RT: meshes with transforms and radio materials; cameras and lights are
// skipped. Assumes file names relative to the XML file.
#pragma once
#include <filesystem>

#include "scene/raw_scene.hpp"

namespace wavetracer {

// Throws InputError that names file, line and element.
RawScene read_mitsuba(const std::filesystem::path& path);

}  // namespace wavetracer
