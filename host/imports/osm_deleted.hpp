// What an editor has deleted: in a file that JOSM saved, a deleted object stays, with action='delete', until it is
// sent. libosmium does not read that attribute.
#pragma once
#include <cstdint>
#include <string_view>
#include <unordered_set>

namespace wavetracer::imports {

struct DeletedObjects {
  std::unordered_set<int64_t> nodes, ways, relations;  // their ids
};

// Those of an OSM XML text. A text that is not well-formed gives what comes before its fault.
DeletedObjects deleted_in_editor(std::string_view content);

}  // namespace wavetracer::imports
