// SPDX-License-Identifier: Apache-2.0
// The tags are those of Mitsuba 3.5 (src/core/xml.cpp).
#include "scene/mitsuba_properties.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <vector>

#include "base/spelling.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Applies Mitsuba's transform operations: translate, scale, rotate, matrix, lookat. The first one in the file acts
// first. Numbers are separated by blanks or commas, as Mitsuba writes and reads them.
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

bool is_mitsuba_property(pugi::xml_node node) {
  static constexpr std::array<std::string_view, 9> tags = {"boolean", "integer", "float",    "string",   "point",
                                                           "vector",  "rgb",     "spectrum", "transform"};
  return std::ranges::find(tags, std::string_view(node.name())) != tags.end();
}

void check_properties(const MitsubaFiles& files, pugi::xml_node node, const std::vector<std::string>& known,
                      const std::vector<std::string_view>& objects) {
  std::set<std::string> seen;
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    if (!is_mitsuba_property(child)) {
      if (std::ranges::find(objects, std::string_view(child.name())) != objects.end()) continue;
      files.fail(child, fmt::format(" is not known inside of {}", MitsubaFiles::describe(node)));
    }
    const std::string name = child.attribute("name").value();
    if (std::ranges::find(known, name) == known.end()) {
      const bool old = std::ranges::any_of(name, [](char c) { return c >= 'A' && c <= 'Z'; });
      files.fail(child, fmt::format(": {} has no property '{}'{}; known: {}{}", MitsubaFiles::describe(node), name,
                                    spelling_hint(name, known), fmt::join(known, ", "),
                                    old ? ". Names with capitals are those of Mitsuba before 2.0: a file of that time "
                                          "begins with <scene version=\"0.6.0\">"
                                        : ""));
    }
    if (!seen.insert(name).second)
      files.fail(child, fmt::format(": {} has the property '{}' twice", MitsubaFiles::describe(node), name));
  }
}

pugi::xml_node mitsuba_property(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                std::initializer_list<std::string_view> tags) {
  for (const pugi::xml_node child : node.children()) {
    if (child.attribute("name").value() != name || !is_mitsuba_property(child)) continue;
    if (std::ranges::find(tags, std::string_view(child.name())) == tags.end())
      files.fail(child, fmt::format(": {} of {} must be a <{}>", name, MitsubaFiles::describe(node),
                                    fmt::join(tags, "> or <")));
    return child;
  }
  return {};
}

std::optional<double> mitsuba_number(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                     double least, bool infinite) {
  const pugi::xml_node child = mitsuba_property(files, node, name, {"float", "integer"});
  if (!child) return std::nullopt;
  files.check_attributes(child, {"name", "value"});
  const std::string text = files.attribute(child, "value");
  const size_t last = text.find_last_not_of(" \t\r\n") + 1;  // 0 if there are only blanks, or nothing
  const size_t first = std::min(text.find_first_not_of(" \t\r\n"), last);
  const char* const end = text.data() + last;
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data() + first, end, value);
  if (error != std::errc() || stop != end || !(value >= least) || (!infinite && std::isinf(value))) {
    throw InputError(fmt::format("{}: {}: {} = '{}' must be a number of at least {}", files.where(child),
                                 MitsubaFiles::describe(node), name, text, least));
  }
  return value;
}

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
