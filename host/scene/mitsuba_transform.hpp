// SPDX-License-Identifier: Apache-2.0
// Reads a Mitsuba <transform>: its operations are composed in the order of the file.
// Transforms must be affine: the last row of a matrix must be 0 0 0 1.
#pragma once
#include <glm/mat4x4.hpp>
#include <pugixml.hpp>

#include "scene/mitsuba_files.hpp"

namespace wavetracer {

// Throws InputError if an operation or an attribute is unknown, or numbers are missing.
glm::dmat4 read_transform(pugi::xml_node transform, const MitsubaFiles& files);

}  // namespace wavetracer
