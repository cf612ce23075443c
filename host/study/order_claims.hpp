// SPDX-License-Identifier: Apache-2.0
// The thesis' claims about orders, as judges of rows; and the words and numbers of their figures.
#pragma once
#include <string>
#include <vector>
#include "study/claim.hpp"
#include "study/order_rows.hpp"

namespace wavetracer::study {

// The cases of these judges are the numbers of rays, each with the sort not paid and with the sort paid. Values are
// speeds as factors of another one's.

// Answers whether the speed against WS is at least this; more may be beyond it.
Judge<OrderRow> gains(const Series& series, double claimed_gain);
// The claims of figure 6.18 about H3DH: 23% less time at 1,000 rays, 2.5 times the speed at 49,000.
Claims<OrderRow> h3dh_gains();
// Answers whether the slowest of `best` is faster than the fastest of `others`, all in one dimension.
Judge<OrderRow> fastest_are(std::vector<std::string> best, std::vector<std::string> others);
// Answers whether the slowest of these takes less time than WS.
Judge<OrderRow> all_faster_than_ws(std::vector<std::string> methods);
// Answers whether the order takes more time than each of others, but at most a quarter more.
Judge<OrderRow> slightly_slower(const std::string& method, std::vector<std::string> than);
// Answers whether the order takes at most a twentieth more time than another one.
Judge<OrderRow> no_slower(const std::string& method, const std::string& than);
// Answers for each number of rays beyond `bound` whether an order loses a fifth of its speed against another one,
// compared with the most rays up to the bound.
Judge<OrderRow> degrades_beyond(const std::string& method, const std::string& against, uint64_t bound);
// Answers whether the gain over WS at the most rays is larger than at the fewest.
Judge<OrderRow> gain_grows(const std::string& method);
// Answers, with the sort not paid, whether launches in two or three dimensions gain a twentieth at most over one.
Judge<OrderRow> shapes_gain_nothing();

// Judges the same claims for each number of bins: orders with a histogram have that number, the others are the same.
// Groups are called "64 bins, sort paid".
Claims<OrderRow> over_bins(Claims<OrderRow> claims);

// Fields: {device}, {most}: the most rays, {frames}: the number of averaged frames, and {reason} (if WS was measured at
// 1,000 and 49,000 rays): the part of the time at 49,000 that the device already needs at 1,000, which no order can
// change.
Fields order_fields(const std::vector<OrderRow>& rows, const std::string& device);

// Returns speed against WS, a series per row, the fastest at the most rays first; two columns for each number of rays:
// with the sort counted once, as the thesis counts it, and in each frame, as a frame pays it. The numbers of rays are
// those where the thesis states its gain and the most, as far as they were measured.
NumberTable gain_table(const std::vector<OrderRow>& rows);

}  // namespace wavetracer::study
