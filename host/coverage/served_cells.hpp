// SPDX-License-Identifier: Apache-2.0
// The links that cells hear, and the values of a cell that follow from them.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>
#include "coverage/coverage_map.hpp"
#include "results/link_rows.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::coverage {

// The links of a cell that count.
struct Heard {
  const LinkRow *best = nullptr, *second = nullptr, *server = nullptr;
  double others = 0;  // sum of the path gains of all but the server, as powers
};

// Returns what each of `cells` cells hears. links outlive it; those without power do not count. cell_of: cell of each
// receiver, or no_cell. tx: the server of all cells; nothing: the strongest of each.
std::vector<Heard> heard_links(std::span<const LinkRow> links, std::span<const uint32_t> cell_of, size_t cells,
                               std::optional<uint32_t> tx);

// Returns all values but those of areas.
Cell values_of(const Heard& heard, const RadioConfig& radio);

}  // namespace wavetracer::coverage
