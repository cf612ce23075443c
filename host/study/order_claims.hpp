// What the thesis claims of orders, as predicates on rows; and the words and numbers of their figures.
#pragma once
#include <string>
#include <vector>
#include "study/claim.hpp"
#include "study/order_rows.hpp"

namespace wavetracer::study {

// "reached with the sort not paid, not reached with it paid", or that it was not measured: the speed against WS at this
// number of rays.
Judge<OrderRow> gains(const Series& series, uint64_t rays, double claimed_gain);
// What figure 6.18 claims of H3DH: 23% less time at 1,000 rays, 2.5 times the speed at 49,000.
Claims<OrderRow> h3dh_gains();
// "yes with the sort not paid, no with it paid", at the most rays: none of `others`, in one dimension, gains more than
// the worst of `best`.
Judge<OrderRow> fastest_are(std::vector<std::string> best, std::vector<std::string> others);
// Likewise: each of these takes no more time than WS, at every number of rays.
Judge<OrderRow> none_slower_than_ws(std::vector<std::string> methods);
// Likewise, at the most rays: the order takes more time than each of others, but no more than a quarter more.
Judge<OrderRow> slightly_slower(const std::string& method, std::vector<std::string> than);
// "yes with the sort not paid, no with it paid": at every measured number of rays from `first` to `last`, the order
// takes no more than a twentieth more time than another one; "not measured" where there is none.
Judge<OrderRow> no_slower(const std::string& method, const std::string& than, uint64_t first, uint64_t last);
// Likewise: beyond `bound` rays an order loses a fifth of its speed against another one, by that at the numbers of rays
// up to it.
Judge<OrderRow> degrades_beyond(const std::string& method, const std::string& against, uint64_t bound);
// Likewise: the gain over WS at the most rays is larger than at the fewest.
Judge<OrderRow> gain_grows(const std::string& method);
// "a factor of 1.03 at most", at the most rays: what launches in two or three dimensions gain over one.
Judge<OrderRow> shapes_gain();

// {device}, {most}: the most rays, {frames}: the times are an average of, and {reason} (where WS was measured at 1,000
// and 49,000 rays): how much of its time at the latter the device takes at the former already, which no order can
// change.
Fields order_fields(const std::vector<OrderRow>& rows, const std::string& device);

// Speed against WS, a series per row, the fastest at the most rays first, a number of rays per column: where the thesis
// states its gain and at the most rays, as far as they were measured. "3.00 (2.40)": sort not paid, and paid.
NumberTable gain_table(const std::vector<OrderRow>& rows);

}  // namespace wavetracer::study
