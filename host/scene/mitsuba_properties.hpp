// The properties of a Mitsuba element: children that have a name and a value.
// Mitsuba refuses a property that nothing asks for; so does this, as it may be a misspelt one that matters.
#pragma once
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mitsuba_files.hpp"

namespace wavetracer {

// Is this child a property, by its tag (float, string, transform, ...)?
bool is_mitsuba_property(pugi::xml_node node);

// Throws InputError where a property is not among the known ones, or is there twice, and where a child is neither a
// property nor has one of the tags in objects.
void check_properties(const MitsubaFiles& files, pugi::xml_node node, const std::vector<std::string>& known,
                      const std::vector<std::string_view>& objects);

// The property of this name; an empty node where there is none. Throws where it is one of another tag.
pugi::xml_node mitsuba_property(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                std::initializer_list<std::string_view> tags);

// The value of a <float> or <integer>; empty where it is absent. Throws where it is no number of at least `least`.
std::optional<double> mitsuba_number(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                     double least, bool infinite);

}  // namespace wavetracer
