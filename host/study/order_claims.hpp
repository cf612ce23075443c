// SPDX-License-Identifier: Apache-2.0
// The thesis' claims about orders, as predicates on rows; and the words and numbers of their figures.
#pragma once
#include <string>
#include <vector>
#include "study/claim.hpp"
#include "study/order_rows.hpp"

namespace wavetracer::study {

// Says "reached with the sort not paid, not reached with it paid", or that it was not measured: the speed against WS at
// this number of rays.
Judge<OrderRow> gains(const Series& series, uint64_t rays, double claimed_gain);
// The claims of figure 6.18 about H3DH: 23% less time at 1,000 rays, 2.5 times the speed at 49,000.
Claims<OrderRow> h3dh_gains();
// Says "yes with the sort not paid, no with it paid", at the most rays: whether none of `others`, in one dimension,
// gains more than the worst of `best`.
Judge<OrderRow> fastest_are(std::vector<std::string> best, std::vector<std::string> others);
// Says in the same way whether each of these takes no more time than WS, at every number of rays.
Judge<OrderRow> none_slower_than_ws(std::vector<std::string> methods);
// Says in the same way, at the most rays, whether the order takes more time than each of others, but at most a quarter
// more.
Judge<OrderRow> slightly_slower(const std::string& method, std::vector<std::string> than);
// Says "yes with the sort not paid, no with it paid": whether at every measured number of rays from `first` to `last`,
// the order takes at most a twentieth more time than another one; "not measured" if there is none.
Judge<OrderRow> no_slower(const std::string& method, const std::string& than, uint64_t first, uint64_t last);
// Says in the same way whether beyond `bound` rays an order loses a fifth of its speed against another one, compared
// with the numbers of rays up to it.
Judge<OrderRow> degrades_beyond(const std::string& method, const std::string& against, uint64_t bound);
// Says in the same way whether the gain over WS at the most rays is larger than at the fewest.
Judge<OrderRow> gain_grows(const std::string& method);
// Says "a factor of 1.03 at most", at the most rays: the gain of launches in two or three dimensions over one.
Judge<OrderRow> shapes_gain();

// Fields: {device}, {most}: the most rays, {frames}: the number of averaged frames, and {reason} (if WS was measured at
// 1,000 and 49,000 rays): the part of the time at 49,000 that the device already needs at 1,000, which no order can
// change.
Fields order_fields(const std::vector<OrderRow>& rows, const std::string& device);

// Returns speed against WS, a series per row, the fastest at the most rays first, a number of rays per column: where
// the thesis states its gain and at the most rays, as far as they were measured. "3.00 (2.40)": sort not paid, and
// paid.
NumberTable gain_table(const std::vector<OrderRow>& rows);

}  // namespace wavetracer::study
