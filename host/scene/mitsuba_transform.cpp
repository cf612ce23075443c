// Mitsuba's transform operations: translate, scale, rotate, matrix. The first one in the file acts first.
// Assumes numbers separated by blanks or commas, as Mitsuba writes and reads them.
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
  TransformReader(const std::function<std::string(pugi::xml_node, const char*)>& attribute,
                  const std::function<std::string(pugi::xml_node)>& where)
      : attribute_(attribute), where_(where) {}

  glm::dmat4 operation(pugi::xml_node node) const {
    const std::string_view tag = node.name();
    const glm::dmat4 one(1);
    if (tag == "translate") return glm::translate(one, vector(node, 0));
    if (tag == "scale") {
      const glm::dvec3 factors = vector(node, 1);
      if (factors.x * factors.y * factors.z == 0) fail(node, "a factor is zero");
      return glm::scale(one, factors);
    }
    if (tag == "rotate") {
      const glm::dvec3 axis = vector(node, 0);
      const std::vector<double> angle = numbers(node, "angle");
      if (angle.size() != 1 || glm::length(axis) == 0)
        fail(node, "needs an axis (x, y, z or value) and an angle in degrees");
      return glm::rotate(one, glm::radians(angle[0]), axis);
    }
    if (tag == "matrix") return matrix(node);
    fail(node, "is not supported; known: translate, scale, rotate, matrix");
  }

 private:
  [[noreturn]] void fail(pugi::xml_node node, std::string_view what) const {
    throw InputError(fmt::format("{}: <{}> of a transform {}", where_(node), node.name(), what));
  }

  std::vector<double> numbers(pugi::xml_node node, const char* key) const {
    const std::string text = attribute_(node, key);
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

  // value="x y z", value="s" for all three, or attributes x, y, z with a default each.
  glm::dvec3 vector(pugi::xml_node node, double absent) const {
    const std::vector<double> value = numbers(node, "value");
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

  glm::dmat4 matrix(pugi::xml_node node) const {
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

  const std::function<std::string(pugi::xml_node, const char*)>& attribute_;
  const std::function<std::string(pugi::xml_node)>& where_;
};

}  // namespace

glm::dmat4 read_transform(pugi::xml_node transform,
                          const std::function<std::string(pugi::xml_node, const char*)>& attribute,
                          const std::function<std::string(pugi::xml_node)>& where) {
  const TransformReader reader(attribute, where);
  glm::dmat4 out(1);
  for (const pugi::xml_node node : transform.children()) {
    if (node.type() == pugi::node_element) out = reader.operation(node) * out;
  }
  return out;
}

}  // namespace wavetracer
