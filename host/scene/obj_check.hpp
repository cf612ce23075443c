// SPDX-License-Identifier: Apache-2.0
// Finds statements of an OBJ file that assimp ignores silently: unknown statements, curves, lines, points.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace wavetracer {

// Returns warnings, each with a count and the first line concerned. Throws InputError that names the line where
// triangles would be lost or moved: invalid numbers, statements that do not begin their line, and calls of other files.
std::vector<std::string> check_obj(const std::filesystem::path& path);

}  // namespace wavetracer
