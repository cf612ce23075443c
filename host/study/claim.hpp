// SPDX-License-Identifier: Apache-2.0
// A claim of the thesis: its words, and the condition on rows.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/judgement.hpp"
#include "study/text.hpp"

namespace wavetracer::study {

// Returns the verdict on rows. order_claims.hpp, cache_claims.hpp, table_regions.hpp and coherence_frames.hpp make such
// judges.
template <class Row>
using Judge = std::function<Judgement(const std::vector<Row>&)>;

template <class Row>
struct Claim {
  std::string words;  // with fields, see filled()
  Judge<Row> judge;
};

template <class Row>
using Claims = std::vector<Claim<Row>>;

template <class Row>
std::vector<Verdict> judged(const Claims<Row>& claims, const std::vector<Row>& rows, const Fields& fields) {
  std::vector<Verdict> out;
  for (const Claim<Row>& claim : claims) {
    Judgement found = claim.judge(rows);
    out.push_back({filled(claim.words, fields), found.outcome, std::move(found.words)});
  }
  return out;
}

}  // namespace wavetracer::study
