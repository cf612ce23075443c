// SPDX-License-Identifier: Apache-2.0
// Deleted objects are found by reading the text once more with expat if it contains the words. Entities are not
// expanded: libosmium refuses a file that declares one. Coordinates are found by the names of the two attributes, since
// the text is long and exponents are rare.
#include "imports/osm_text.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "imports/city_model.hpp"
#include "imports/map.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

struct FreeParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

struct Scan {
  XML_Parser parser;
  DeletedObjects found;
};

void take_element(void* user, const XML_Char* element, const XML_Char** attributes) {
  DeletedObjects& found = static_cast<Scan*>(user)->found;
  const std::string_view name = element;
  const auto ids = name == "node"       ? &found.nodes
                   : name == "way"      ? &found.ways
                   : name == "relation" ? &found.relations
                                        : nullptr;
  if (!ids) return;
  std::string_view id, action;
  for (; attributes[0]; attributes += 2) {
    const std::string_view key = attributes[0];
    if (key == "id") id = attributes[1];
    if (key == "action") action = attributes[1];
  }
  int64_t number = 0;
  if (action == "delete" && std::from_chars(id.data(), id.data() + id.size(), number).ec == std::errc())
    ids->insert(number);
}

void refuse_entity(void* user, const XML_Char*, int, const XML_Char*, int, const XML_Char*, const XML_Char*,
                   const XML_Char*, const XML_Char*) {
  XML_StopParser(static_cast<Scan*>(user)->parser, XML_FALSE);
}

constexpr std::string_view blank_characters = " \t\r\n";

// Returns the value of an attribute from the text after its name; empty if there is none.
std::string_view value_after(std::string_view text) {
  const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(blank_characters), text.size())); };
  skip_blanks();
  if (!text.starts_with('=')) return {};
  text.remove_prefix(1);
  skip_blanks();
  if (!text.starts_with('"') && !text.starts_with('\'')) return {};
  const size_t end = text.find(text[0], 1);
  return end == text.npos ? text.substr(1) : text.substr(1, end - 1);
}

bool is_out_of_bounds(std::string_view value) {
  const size_t exponent = value.find_first_of("eE");
  if (exponent == value.npos || value.substr(exponent + 1).starts_with('-')) return false;
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc::result_out_of_range || (error == std::errc() && std::abs(number) >= 1e9);
}

}  // namespace

DeletedObjects deleted_in_editor(std::string_view content) {
  if (content.find("action") == content.npos || content.find("delete") == content.npos) return {};
  const std::unique_ptr<XML_ParserStruct, FreeParser> parser(XML_ParserCreate(nullptr));
  if (!parser) throw std::bad_alloc();
  Scan scan{parser.get(), {}};
  XML_SetUserData(parser.get(), &scan);
  XML_SetElementHandler(parser.get(), &take_element, nullptr);
  XML_SetEntityDeclHandler(parser.get(), &refuse_entity);
  constexpr size_t piece = 1 << 24;
  bool good = true;
  while (good && !content.empty()) {
    const std::string_view now = content.substr(0, piece);
    content.remove_prefix(now.size());
    good = XML_Parse(parser.get(), now.data(), static_cast<int>(now.size()), content.empty()) == XML_STATUS_OK;
  }
  return std::move(scan.found);
}

void check_exponents(std::string_view content, const std::string& name) {
  for (const std::string_view key : {"lat", "lon"})
    for (size_t at = content.find(key, 1); at != content.npos; at = content.find(key, at + key.size())) {
      if (blank_characters.find(content[at - 1]) == blank_characters.npos) continue;
      const std::string_view value = value_after(content.substr(at + key.size(), 200));
      if (is_out_of_bounds(value))
        throw InputError(fmt::format("{}: {} is '{}', which is no place on the globe",
                                     line_of(content, static_cast<std::ptrdiff_t>(at), name), key, printable(value)));
    }
}

}  // namespace wavetracer::imports
