// Phrases that set a claim of the thesis beside rows of the table.
// Factors have two decimals; whoever compares them with the table rounds likewise.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/findings.hpp"
#include "study/measure.hpp"

namespace wavetracer::study {

// What figure 6.18 states: 23% less time at 1,000 rays, 2.5 times as fast at 49,000.
constexpr double claimed_gain_few = 1 / (1 - 0.23), claimed_gain_many = 2.5;

// Null where the series was not measured at that ray count.
const Row* find_row(const std::vector<Row>& rows, const Series& series, uint64_t rays);

// Speed against WS, a series a row, the fastest at the most rays first, a ray count a column: where the thesis states
// its gain and at the most rays, as far as they were measured. "3.00 (2.40)": with the sort not paid, and paid.
NumberTable gain_table(const std::vector<Row>& rows);

// "reached with the sort not paid, not reached with it paid", or that it was not measured.
std::string verdict_words(const std::vector<Row>& rows, const Series& series, uint64_t rays, double claimed_gain);
// What figure 6.18 claims of H3DH.
std::vector<Verdict> gain_verdicts(const std::vector<Row>& rows);

// Why: how much of WS's time at 49,000 rays the device takes at 1,000 already, which no order can change. Empty where
// either was not measured.
std::string reason_words(const std::vector<Row>& rows);

}  // namespace wavetracer::study
