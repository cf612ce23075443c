// SPDX-License-Identifier: Apache-2.0
// Applies Mitsuba's transform operations: translate, scale, rotate, matrix, lookat. The first one in the file acts
// first. Numbers are separated by blanks or commas, as Mitsuba writes and reads them.
#include "scene/mitsuba_transform.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

class TransformReader {
 public:
  explicit TransformReader(const MitsubaFiles& files) : files_(files) {}

  glm::dmat4 operation(pugi::xml_node node) const {
    const std::string_view tag = node.name();
    const glm::dmat4 one(1);
    if (tag == "translate") {
      files_.check_attributes(node, {"value", "x", "y", "z"});
      return glm::translate(one, vector(node, 0));
    }
    if (tag == "scale") {
      files_.check_attributes(node, {"value", "x", "y", "z"});
      const glm::dvec3 factors = vector(node, 1);
      if (factors.x * factors.y * factors.z == 0) fail(node, "a factor is zero");
      return glm::scale(one, factors);
    }
    if (tag == "rotate") {
      files_.check_attributes(node, {"value", "x", "y", "z", "angle"});
      const glm::dvec3 axis = vector(node, 0);
      const std::vector<double> angle = numbers(node, "angle");
      if (angle.size() != 1 || glm::length(axis) == 0)
        fail(node, "needs an axis (x, y, z or value) and an angle in degrees");
      return glm::rotate(one, glm::radians(angle[0]), axis);
    }
    if (tag == "matrix") return matrix(node);
    if (tag == "lookat") return look_at(node);
    fail(node, "is not supported; known: translate, scale, rotate, matrix, lookat");
  }

 private:
  [[noreturn]] void fail(pugi::xml_node node, std::string_view what) const {
    throw InputError(fmt::format("{}: <{}> of a transform {}", files_.where(node), node.name(), what));
  }

  std::vector<double> numbers(pugi::xml_node node, const char* key) const {
    const std::string text = files_.attribute(node, key);
    std::vector<double> out;
    const char* next = text.data();
    const char* const end = next + text.size();
    while (true) {
      while (next < end && (std::isspace(static_cast<unsigned char>(*next)) || *next == ',')) ++next;
      if (next == end) return out;
      double value = 0;
      const auto [stop, error] = std::from_chars(*next == '+' ? next + 1 : next, end, value);
      if (error != std::errc() || !std::isfinite(value))
        fail(node, fmt::format("has a bad number in {}=\"{}\"", key, text));
      out.push_back(value);
      next = stop;
    }
  }

  // Parses value="x y z", value="s" for all three, or attributes x, y, z with a default each.
  glm::dvec3 vector(pugi::xml_node node, double absent) const {
    const std::vector<double> value = numbers(node, "value");
    if (!value.empty() && (node.attribute("x") || node.attribute("y") || node.attribute("z")))
      fail(node, "has a value beside x, y or z: keep one of them");
    if (value.size() == 1) return glm::dvec3(value[0]);
    if (value.size() == 3) return {value[0], value[1], value[2]};
    if (!value.empty()) fail(node, "needs one or three numbers in value");
    glm::dvec3 out(absent);
    const char* const keys[] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
      const std::vector<double> component = numbers(node, keys[k]);
      if (component.size() > 1) fail(node, "needs one number in each of x, y, z");
      if (component.size() == 1) out[k] = component[0];
    }
    return out;
  }

  glm::dvec3 point(pugi::xml_node node, const char* key) const {
    const std::vector<double> value = numbers(node, key);
    if (value.size() != 3) fail(node, "needs three numbers in each of origin, target and up");
    return {value[0], value[1], value[2]};
  }

  // Returns the axes of a camera that looks from origin to target: x to the left, y up, z forward.
  glm::dmat4 look_at(pugi::xml_node node) const {
    files_.check_attributes(node, {"origin", "target", "up"});
    const glm::dvec3 origin = point(node, "origin"), forward = point(node, "target") - origin, up = point(node, "up");
    const glm::dvec3 left = glm::cross(up, forward);
    if (!(glm::length(left) > 0)) fail(node, "looks nowhere, or along up");
    const glm::dvec3 z = glm::normalize(forward), x = glm::normalize(left);
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
  }

  glm::dmat4 matrix(pugi::xml_node node) const {
    files_.check_attributes(node, {"value"});
    const std::vector<double> value = numbers(node, "value");
    const int n = value.size() == 16 ? 4 : 3;
    if (value.size() != 16 && value.size() != 9) fail(node, "needs 16 numbers (or 9), row by row");
    glm::dmat4 out(1);
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) out[column][row] = value[static_cast<size_t>(row * n + column)];
    }
    if (out[0][3] != 0 || out[1][3] != 0 || out[2][3] != 0 || out[3][3] != 1) fail(node, "must end in the row 0 0 0 1");
    return out;
  }

  const MitsubaFiles& files_;
};

}  // namespace

glm::dmat4 read_transform(pugi::xml_node transform, const MitsubaFiles& files) {
  files.check_attributes(transform, {"name", "id"});
  const TransformReader reader(files);
  glm::dmat4 out(1);
  for (const pugi::xml_node node : transform.children()) {
    if (node.type() == pugi::node_element) out = reader.operation(node) * out;
  }
  return out;
}

}  // namespace wavetracer
