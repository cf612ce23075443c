// SPDX-License-Identifier: Apache-2.0
// The orders of rays: one row for each method, used by all code that names, plans or compares methods. The words are
// those of OrderMethod; the methods with a mnemonic are those of A. Zhdanov, TU Munich, 2014, section 6.2.2.
#pragma once
#include <array>
#include <optional>

#include "wavetracer/config.hpp"

namespace wavetracer {

// The key by which rays are sorted.
enum class OrderKey { morton, morton_bins, hilbert_bins, direction_origin };

struct OrderMethodRow {
  OrderMethod name, mnemonic;      // both words are the same if the thesis has no such method
  std::optional<OrderKey> key;     // not set: rays keep the order of their launch
  unsigned launch_dimensions = 0;  // dimensions of the Hilbert curve that its launch follows; 0: any launch is possible
};

// "auto" has no row: it chooses one of these.
inline constexpr std::array<OrderMethodRow, 7> order_methods{{
    {"none", "WS", {}},
    {"morton", "Z", OrderKey::morton},
    {"hilbert3d-histogram", "H3DH", OrderKey::hilbert_bins},
    {"morton-histogram", "HZ", OrderKey::morton_bins},
    {"hilbert3d-histogram-hilbert2d", "H3DH2DH", OrderKey::hilbert_bins, 2},
    {"hilbert3d-histogram-hilbert3d", "H3DH3DH", OrderKey::hilbert_bins, 3},
    {"direction-origin", "direction-origin", OrderKey::direction_origin},
}};

// The row of a method by either of its words; not set for "auto".
constexpr std::optional<OrderMethodRow> find_order_method(OrderMethod method) {
  for (const OrderMethodRow& row : order_methods)
    if (method == row.name || method == row.mnemonic) return row;
  return std::nullopt;
}

}  // namespace wavetracer
