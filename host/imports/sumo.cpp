// SPDX-License-Identifier: Apache-2.0
// Reads SUMO's polygons (.poly.xml) and the <location> of its networks.
// The text is not trusted: pugixml neither recurses nor expands entities.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>

#include "imports/map.hpp"
#include "imports/straight_walls.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr size_t header_size = 1 << 20;  // <location> comes early, while networks have gigabytes

// Returns two or three numbers separated by commas, or nothing.
std::optional<glm::dvec2> parse_pair(std::string_view text) {
  std::array<double, 3> numbers{};
  size_t count = 0;
  while (count < 3) {
    const size_t comma = std::min(text.find(','), text.size());
    const auto [stop, error] = std::from_chars(text.data(), text.data() + comma, numbers[count]);
    if (error != std::errc() || stop != text.data() + comma || !std::isfinite(numbers[count])) return {};
    ++count;
    if (comma == text.size()) break;
    text.remove_prefix(comma + 1);
    if (count == 3) return {};
  }
  if (count < 2) return {};
  return glm::dvec2(numbers[0], numbers[1]);
}

std::optional<RingM> parse_shape(std::string_view text) {
  RingM out;
  constexpr std::string_view blanks = " \t\r\n";
  for (size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    const auto point = parse_pair(text.substr(begin, end - begin));
    if (!point) return {};
    out.push_back(*point);
    begin = text.find_first_not_of(blanks, end);
  }
  return out;
}

// Reads four numbers separated by commas. If there is nothing, SUMO writes lower > upper, which becomes an empty
// extent.
Extent read_boundary(std::string_view text, const std::string& at) {
  if (text.empty()) return {};
  const size_t second = text.find(',') == text.npos ? text.npos : text.find(',', text.find(',') + 1);
  const auto lower = parse_pair(text.substr(0, second)),
             upper = second == text.npos ? std::nullopt : parse_pair(text.substr(second + 1));
  if (!lower || !upper || text.find(',', text.find(',', second + 1) + 1) != text.npos)
    throw InputError(fmt::format("{}: <location convBoundary=\"{}\"> must be four numbers with commas", at, text));
  const Extent out{*lower, *upper};
  return out.empty() ? Extent{} : out;
}

SumoLocation read_location(const pugi::xml_node node, const std::string& at) {
  const auto offset = parse_pair(node.attribute("netOffset").value());
  if (!offset) {
    throw InputError(fmt::format("{}: <location netOffset=\"{}\"> must be two numbers with a comma", at,
                                 node.attribute("netOffset").value()));
  }
  Georeference out{node.attribute("projParameter").value(), *offset, {}};
  // SUMO writes "!" for none, and "-" for unchanged coordinates.
  if (!out.projection.starts_with("+proj")) out.projection.clear();
  return {out, read_boundary(node.attribute("convBoundary").value(), at)};
}

Tags tags_of(const pugi::xml_node poly) {
  Tags out;
  for (const pugi::xml_node param : poly.children("param")) {
    out[param.attribute("key").value()] = param.attribute("value").value();
  }
  const std::string_view type = poly.attribute("type").value();
  // polyconvert writes "building.yes" with --osm.keep-full-type, else "building"; other programs write "building:part".
  out.try_emplace(type.starts_with("building:part") ? "building:part" : "building", "yes");
  return out;
}

// Returns the report's name for a polygon that is no building: its type in printable letters. The number of types is
// limited, since a report of thousands of them would not help.
std::string left_out_type(std::string_view type, const std::map<std::string, uint64_t>& left_out) {
  constexpr size_t most_types = 50;
  std::string shown(type.substr(0, 40));
  std::ranges::replace_if(
      shown, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7F; }, ' ');
  const std::string reason = fmt::format("polygon of the type '{}'", shown);
  return left_out.size() < most_types || left_out.contains(reason) ? reason : "polygon of another type";
}

}  // namespace

std::string line_of(std::string_view content, std::ptrdiff_t offset, const std::string& name) {
  const auto size = static_cast<std::ptrdiff_t>(content.size());
  return fmt::format(
      "{}:{}", name,
      1 + std::count(content.begin(), content.begin() + std::clamp<std::ptrdiff_t>(offset, 0, size), '\n'));
}

std::string_view root_element(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (true) {
    const size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos || text[begin] != '<') return {};
    text.remove_prefix(begin + 1);
    std::string_view end;
    if (text.starts_with("!--")) {
      end = "-->";
    } else if (text.starts_with("?") || text.starts_with("!")) {
      end = ">";
    } else {
      return text.substr(0, text.find_first_of(" \t\r\n/>"));
    }
    const size_t stop = text.find(end);
    if (stop == std::string_view::npos) return {};
    text.remove_prefix(stop + end.size());
  }
}

bool is_sumo_polygons(std::string_view first_bytes) {
  const std::string_view root = root_element(first_bytes);
  return root == "additional" || root == "polygons" || root == "shapes";
}

std::optional<SumoLocation> sumo_location(std::string_view content, const std::string& name) {
  content = content.substr(0, header_size);
  const size_t begin = content.find("<location");
  if (begin == std::string_view::npos) return {};
  const size_t end = content.find('>', begin);
  if (end == std::string_view::npos) return {};
  pugi::xml_document document;
  const std::string_view element = content.substr(begin, end + 1 - begin);
  const std::string at = line_of(content, static_cast<std::ptrdiff_t>(begin), name);
  if (!document.load_buffer(element.data(), element.size())) {
    throw InputError(fmt::format("{}: the element <location> cannot be read", at));
  }
  return read_location(document.child("location"), at);
}

Map read_sumo_polygons(std::string_view content, const std::string& name) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(content.data(), content.size());
  if (!result) {
    throw InputError(
        fmt::format("{}: not well-formed XML: {}", line_of(content, result.offset, name), result.description()));
  }
  Map map;
  map.nested_are_courtyards = true;
  const pugi::xml_node root = document.document_element();
  if (const pugi::xml_node location = root.child("location")) {
    const SumoLocation read = read_location(location, line_of(content, location.offset_debug(), name));
    map.georeference = read.georeference;
    map.network = read.boundary;
  }
  // polyconvert writes its own configuration into a comment.
  if (content.substr(0, header_size).find("<osm-files") != std::string_view::npos) {
    map.georeference.attribution = osm_attribution;
  }
  std::optional<Projection> projection;
  size_t count = 0;
  for (const pugi::xml_node poly : root.children("poly")) {
    ++count;
    const std::string_view type = poly.attribute("type").value();
    if (!type.starts_with("building")) {
      ++map.left_out[left_out_type(type, map.left_out)];
      continue;
    }
    const auto at = [&] { return line_of(content, poly.offset_debug(), name); };
    auto shape = parse_shape(poly.attribute("shape").value());
    if (!shape) {
      throw InputError(
          fmt::format("{}: <poly id=\"{}\">: shape must be points \"x,y\" or \"x,y,z\" separated by blanks", at(),
                      poly.attribute("id").value()));
    }
    if (poly.attribute("geo").as_bool()) {
      if (!projection) {
        if (map.georeference.projection.empty()) {
          throw InputError(fmt::format("{}: <poly geo=\"1\"> needs a <location> with a projection", at()));
        }
        projection.emplace(map.georeference);
      }
      for (glm::dvec2& p : *shape) p = projection->scene(p);
    }
    map.footprints.push_back(
        {fmt::format("polygon_{}", count), poly.attribute("id").value(), std::move(*shape), {}, tags_of(poly)});
  }
  map.rounding_m = rounding_of(map.footprints, metre_steps);
  return map;
}

}  // namespace wavetracer::imports
