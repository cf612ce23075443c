// Phrases that set a claim of the thesis beside rows of the table.
// Factors have two decimals and percentages none; whoever compares them with the table rounds likewise.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "recipes/measure.hpp"

namespace wavetracer::recipes {

// What figure 6.18 states: 23% less time at 1,000 rays, 2.5 times as fast at 49,000.
constexpr double claimed_gain_few = 1 / (1 - 0.23), claimed_gain_many = 2.5;

// Null where the series was not measured at that ray count.
const Row* find_row(const std::vector<Row>& rows, const Series& series, uint64_t rays);

// "at 1,000 rays 1.35 times as fast as WS (26% less time) with the sort not paid and 0.90 times (11% more time) with it
// paid; at 49,000 ...": where the thesis states its gain and at the most rays, as far as they were measured.
std::string gain_words(const std::vector<Row>& rows, const Series& series);

// "23% at 1,000 rays: reached with the sort not paid, not reached with it paid", or that it was not measured.
std::string verdict_words(const std::vector<Row>& rows, const Series& series, uint64_t rays, const std::string& claim,
                          double claimed_gain);

// Why: how much of WS's time at 49,000 rays the device takes at 1,000 already, which no order can change. Empty where
// either was not measured.
std::string reason_words(const std::vector<Row>& rows);

// "HZ 2.41, H3DH 2.40, ..., WS 1.00": the series of one ray count by one of the gains, the fastest first.
std::string ranking_words(const std::vector<Row>& rows, uint64_t rays, double Row::*gain);

}  // namespace wavetracer::recipes
