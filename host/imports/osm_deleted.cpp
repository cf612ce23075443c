// SPDX-License-Identifier: Apache-2.0
// Reads the text once more with expat if it contains the words.
// Entities are not expanded: libosmium refuses a file that declares one.
#include "imports/osm_deleted.hpp"

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <memory>

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

}  // namespace wavetracer::imports
