// The table behind a figure: one line a ray count and series.
// Comma-separated; no cell needs quotes.
#pragma once
#include <string>
#include <vector>
#include "study/measure.hpp"

namespace wavetracer::study {

// The columns from `rays` to `gain_paid`; where the rows are averages over frames, also `frames` and the reductions of
// time, in percent, that the gains amount to.
std::string encode_table(const std::vector<Row>& rows);

// The position of a column in any table, from 1 as gnuplot counts.
size_t column_number(const std::string& name);

// How much less time a gain means, in percent; negative: more time.
double reduction_percent(double gain);

}  // namespace wavetracer::study
