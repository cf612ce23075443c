// SPDX-License-Identifier: Apache-2.0
// Finds objects that an editor has deleted: a file saved by JOSM keeps them, with action='delete', until they are
// uploaded. libosmium does not read that attribute.
#pragma once
#include <cstdint>
#include <string_view>
#include <unordered_set>

namespace wavetracer::imports {

struct DeletedObjects {
  std::unordered_set<int64_t> nodes, ways, relations;  // their ids
};

// Returns the objects of an OSM XML text that have action='delete'. If the text is not well-formed, it returns those
// before the error.
DeletedObjects deleted_in_editor(std::string_view content);

}  // namespace wavetracer::imports
