// SPDX-License-Identifier: Apache-2.0
// A claim: its words, who made it, the numbers of rays that it is about, and the predicate on rows that answers each
// case. judged() makes the verdict of these, in the same way for all claims.
#pragma once
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "study/judgement.hpp"
#include "study/text.hpp"

namespace wavetracer::study {

// Returns an answer for each case that rows have. order_claims.hpp, cache_claims.hpp, table_regions.hpp,
// innerframe_claims.hpp and coherence_frames.hpp make such judges. Rows are those within the claim's range; there is
// one at least.
template <class Row>
using Judge = std::function<Cases(const std::vector<Row>&)>;

template <class Row>
struct Claim {
  std::string words;  // with fields, see filled()
  Judge<Row> judge;
  std::optional<Range> range = {};  // not given: that of the figure
  Origin origin = Origin::thesis;
};

template <class Row>
using Claims = std::vector<Claim<Row>>;

// Returns the numbers of rays of rows, ascending, each once; none for rows that have one number of rays alone.
template <class Row>
std::vector<uint64_t> measured_rays(const std::vector<Row>& rows) {
  std::vector<uint64_t> out;
  if constexpr (requires(const Row& row) { row.rays; }) {
    for (const Row& row : rows) out.push_back(row.rays);
    std::ranges::sort(out);
    out.erase(std::ranges::unique(out).begin(), out.end());
  }
  return out;
}

// Judges one claim of a figure whose claims are about `range`, unless they say something else.
template <class Row>
Judgement judgement_of(const Claim<Row>& claim, const std::vector<Row>& rows, const Range& range) {
  if constexpr (requires(const Row& row) { row.rays; }) {
    const Range own = claim.range.value_or(range);
    const std::vector<uint64_t> counts = measured_rays(rows);
    std::vector<Row> within;
    for (const Row& row : rows)
      if (own.contains(row.rays)) within.push_back(row);
    return own.is_covered(counts) ? judgement_of(claim.judge(within)) : not_measured_there(counts);
  } else {
    return judgement_of(claim.judge(rows));
  }
}

template <class Row>
std::vector<Verdict> judged(const Claims<Row>& claims, const std::vector<Row>& rows, const Range& range,
                            const Fields& fields) {
  std::vector<Verdict> out;
  for (const Claim<Row>& claim : claims) {
    Judgement found = judgement_of(claim, rows, range);
    out.push_back({filled(claim.words, fields), found.outcome, std::move(found.words), claim.origin});
  }
  return out;
}

// Returns claims that repeat those of another figure, or of the same figure about other tables.
template <class Row>
Claims<Row> repeated(Claims<Row> claims) {
  for (Claim<Row>& claim : claims) claim.origin = Origin::repetition;
  return claims;
}

}  // namespace wavetracer::study
