// A Mitsuba <transform>: its operations composed in the order they stand in the file.
// Assumes affine transforms; the last row of a matrix must be 0 0 0 1.
#pragma once
#include <functional>
#include <glm/mat4x4.hpp>
#include <pugixml.hpp>
#include <string>

namespace wavetracer {

// attribute: the value of an attribute with parameters replaced, empty where absent; where: "file:line" of a node.
// Throws InputError.
glm::dmat4 read_transform(pugi::xml_node transform,
                          const std::function<std::string(pugi::xml_node, const char*)>& attribute,
                          const std::function<std::string(pugi::xml_node)>& where);

}  // namespace wavetracer
