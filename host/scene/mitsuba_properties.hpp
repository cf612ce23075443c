// SPDX-License-Identifier: Apache-2.0
// Checks and reads the properties of a Mitsuba element: children that have a name and a value, such as a number or a
// transform. Like Mitsuba, it refuses a property that no code asks for, as it may be a misspelt one that matters.
#pragma once
#include <glm/mat4x4.hpp>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mitsuba_files.hpp"

namespace wavetracer {

// Tells whether this child is a property, by its tag (float, string, transform, ...).
bool is_mitsuba_property(pugi::xml_node node);

// Throws InputError if a property is unknown or appears twice, or if a child is no property and its tag is not in
// `objects`.
void check_properties(const MitsubaFiles& files, pugi::xml_node node, const std::vector<std::string>& known,
                      const std::vector<std::string_view>& objects);

// Returns the property of this name, or an empty node if it is missing. Throws if it has another tag.
pugi::xml_node mitsuba_property(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                std::initializer_list<std::string_view> tags);

// Returns the value of a <float> or <integer>, or nothing if it is absent. Throws if it is no number of at least
// `least`.
std::optional<double> mitsuba_number(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                     double least, bool infinite);

// Throws InputError if an operation or an attribute is unknown, or numbers are missing.
glm::dmat4 read_transform(pugi::xml_node transform, const MitsubaFiles& files);

}  // namespace wavetracer
