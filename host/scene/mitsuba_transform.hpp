// A Mitsuba <transform>: its operations composed in the order they stand in the file.
// Assumes affine transforms; the last row of a matrix must be 0 0 0 1.
#pragma once
#include <glm/mat4x4.hpp>
#include <pugixml.hpp>

#include "scene/mitsuba_files.hpp"

namespace wavetracer {

// Throws InputError where an operation or an attribute is not known, and where numbers are missing.
glm::dmat4 read_transform(pugi::xml_node transform, const MitsubaFiles& files);

}  // namespace wavetracer
