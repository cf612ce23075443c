// Finds what assimp passes over in an OBJ file without a word: statements that it does not know, curves, lines, points.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace wavetracer {

// Returns warnings, each with a count and the first line that it is about. Throws InputError that names the line where
// triangles would be lost or moved: numbers that are none, statements that do not begin their line, and files that are
// called.
std::vector<std::string> check_obj(const std::filesystem::path& path);

}  // namespace wavetracer
