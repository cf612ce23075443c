// SPDX-License-Identifier: Apache-2.0
// Reads of an OSM XML text what libosmium does not: objects that an editor has deleted, and coordinates that are no
// places.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>

namespace wavetracer::imports {

struct DeletedObjects {
  std::unordered_set<int64_t> nodes, ways, relations;  // their ids
};

// Returns the objects of an OSM XML text that have action='delete'. If the text is not well-formed, it returns those
// before the error.
DeletedObjects deleted_in_editor(std::string_view content);

// Throws InputError with the line if a lat or lon of an OSM XML text has an exponent that makes it 10^9 or more.
void check_exponents(std::string_view content, const std::string& name);

}  // namespace wavetracer::imports
