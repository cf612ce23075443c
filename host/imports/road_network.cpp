// SPDX-License-Identifier: Apache-2.0
// Reads networks by pugixml, which neither recurses nor expands entities.
// Networks have the form of net_file.xsd: <net><edge><lane shape="x,y[,z] ...">.
#include "imports/road_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string>

#include "imports/map.hpp"
#include "motion/byte_stream.hpp"
#include "motion/input_text.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double sumo_lane_width_m = 3.2;
constexpr size_t most_bytes = size_t{1} << 30;

std::string text_of(const std::filesystem::path& file) {
  ByteStream stream(file, "road network");
  std::string text;
  for (std::string_view chunk = stream.next(); !chunk.empty(); chunk = stream.next()) {
    if (text.size() + chunk.size() > most_bytes)
      throw InputError(
          fmt::format("{}: a road network of more than 1 GiB of text cannot be read: cut out the region of "
                      "the scene with `netconvert --keep-edges.in-boundary`",
                      file.string()));
    text += chunk;
  }
  return text;
}

class NetworkReader {
 public:
  explicit NetworkReader(const std::filesystem::path& file) : file_(file.string()), text_(text_of(file)) {}

  std::vector<Street> read() {
    const std::string_view root = imports::root_element(text_);
    if (root.empty())
      throw InputError(fmt::format(
          "{}: this is no XML text, but a SUMO network is one: give the .net.xml that netconvert wrote", file_));
    if (root != "net")
      throw InputError(
          fmt::format("{}: the root element is <{}>, but that of a SUMO network is <net>: give the "
                      ".net.xml that netconvert wrote",
                      file_, root.substr(0, 40)));
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(text_.data(), text_.size());
    if (!result) fail(result.offset, fmt::format("not well-formed XML: {}", result.description()));
    std::vector<Street> streets;
    for (const pugi::xml_node edge : document.document_element().children("edge")) {
      const std::string_view function = edge.attribute("function").value();
      if (function == "crossing" || function == "walkingarea") continue;
      for (const pugi::xml_node lane : edge.children("lane")) streets.push_back(street_of(lane));
    }
    if (streets.empty()) throw InputError(fmt::format("{}: the network has no lane", file_));
    return streets;
  }

 private:
  [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& what) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    fail_at(file_, 1 + static_cast<uint64_t>(std::count(text_.begin(), end, '\n')), what);
  }

  Street street_of(const pugi::xml_node lane) const {
    const std::string name = fmt::format("<lane id=\"{}\">", lane.attribute("id").value());
    Street out{{}, sumo_lane_width_m};
    if (const pugi::xml_attribute width = lane.attribute("width")) {
      const std::optional<double> value = finite_number(width.value());
      if (!value || !(*value > 0))
        fail(lane.offset_debug(), fmt::format("{}: width = '{}' is not a positive number", name, width.value()));
      out.width_m = *value;
    }
    const std::string_view shape = lane.attribute("shape").value();
    constexpr std::string_view blanks = " \t\r\n";
    for (size_t at = shape.find_first_not_of(blanks); at != shape.npos; at = shape.find_first_not_of(blanks, at)) {
      const size_t end = std::min(shape.find_first_of(blanks, at), shape.size());
      const std::optional<glm::dvec3> point = point_of(shape.substr(at, end - at));
      if (!point)
        fail(lane.offset_debug(),
             fmt::format("{}: shape must be points \"x,y\" or \"x,y,z\" separated by blanks, not '{}'", name,
                         shape.substr(at, std::min<size_t>(end - at, 60))));
      out.centre_m.push_back(*point);
      at = end;
    }
    if (out.centre_m.size() < 2) fail(lane.offset_debug(), fmt::format("{}: shape has less than two points", name));
    return out;
  }

  static std::optional<glm::dvec3> point_of(std::string_view text) {
    glm::dvec3 out{0};
    for (int axis = 0; axis < 3; ++axis) {
      const size_t comma = std::min(text.find(','), text.size());
      const std::optional<double> value = finite_number(text.substr(0, comma));
      if (!value) return std::nullopt;
      out[axis] = *value;
      if (comma == text.size()) return axis > 0 ? std::optional(out) : std::nullopt;
      text.remove_prefix(comma + 1);
    }
    return std::nullopt;
  }

  std::string file_, text_;
};

}  // namespace

std::vector<Street> read_road_network(const std::filesystem::path& file) { return NetworkReader(file).read(); }

std::vector<Street> known_streets(const Config& config) {
  if (config.scene.streets.empty())
    return config.scene.generate.empty() ? std::vector<Street>{}
                                         : city_streets(parse_city_options(config.scene.generate));
  std::vector<Street> out = read_road_network(config.scene.streets);
  const TrajectoriesConfig& moved = config.trajectories;
  const glm::dvec3 offset_m{moved.offset_m[0], moved.offset_m[1], moved.offset_m[2]};
  for (Street& street : out) {
    street.width_m *= moved.scale;
    for (glm::dvec3& p : street.centre_m) p = moved.scale * p + offset_m;
  }
  return out;
}

}  // namespace wavetracer
