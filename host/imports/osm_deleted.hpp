// Objects that an editor has deleted: in a file that JOSM saved, a deleted object stays, with action='delete', until it
// is sent. libosmium does not read that attribute.
#pragma once
#include <cstdint>
#include <string_view>
#include <unordered_set>

namespace wavetracer::imports {

struct DeletedObjects {
  std::unordered_set<int64_t> nodes, ways, relations;  // their ids
};

// Returns the objects of an OSM XML text that have action='delete'. If the text is not well-formed, these are the ones
// before its fault.
DeletedObjects deleted_in_editor(std::string_view content);

}  // namespace wavetracer::imports
