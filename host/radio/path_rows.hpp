// Rows of a path geometry: the entries of one path, and a geometry of some of the rows of another.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// The entries of one path in a column that has one per interaction.
template <class T>
std::span<const T> of_path(const PathGeometry& paths, const std::vector<T>& column, size_t path) {
  return std::span(column).subspan(paths.first[path], paths.first[path + 1] - paths.first[path]);
}

// These rows alone, in this order.
PathGeometry rows_of(const PathGeometry& paths, std::span<const uint32_t> rows);

}  // namespace wavetracer
