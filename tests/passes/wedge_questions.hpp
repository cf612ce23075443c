// SPDX-License-Identifier: Apache-2.0
// Paths over edges that tests ask wedge_solve for, one candidate each.
#pragma once
#include <doctest/doctest.h>

#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "passes/solved_rows.hpp"
#include "passes/wedge_cases.hpp"
#include "passes/wedge_solve.hpp"
#include "passes/wedges.hpp"

namespace wavetracer::test {

constexpr double bounds_wave_m = 0.05;  // wavelength: that of bounds where links have floors

struct Question {
  uint32_t transmitter, receiver;
  std::vector<uint32_t> before, wedges, after;  // after: from the receiver on
};

// Found rows by question; transmitters of the trie are the transmitters, then the receivers. of_one_listener: the way
// back of every receiver is that of receiver 0, as listeners share it. limits: as for wedge_solve.
inline std::map<size_t, PathRow> solve(const Scene& scene, const std::vector<glm::dvec3>& transmitters,
                                       const std::vector<glm::dvec3>& receivers, const std::vector<Question>& questions,
                                       uint32_t max_depth = 6, bool of_one_listener = false,
                                       const LinkLimits* limits = nullptr) {
  const DeviceScene uploaded = make_device_scene(context(), scene, false, 100);
  std::vector<EndState> tx, rx;
  std::vector<uint32_t> listeners;
  for (const glm::dvec3& p : transmitters) tx.push_back({.position_m = p});
  for (const glm::dvec3& p : receivers) {
    listeners.push_back(static_cast<uint32_t>(rx.size()));
    rx.push_back({.position_m = p});
  }
  const RadioEnds ends = make_radio_ends(context(), tx, rx, {}, single_listeners(listeners));
  const Wedges wedges(context(), scene, {}, {}, true);
  std::vector<Sequence> sequences;
  const auto first_listener = static_cast<uint32_t>(tx.size());
  for (const Question& q : questions) {
    if (!q.before.empty()) sequences.push_back({q.transmitter, q.before});
    if (!q.after.empty()) sequences.push_back({first_listener + (of_one_listener ? 0 : q.receiver), q.after});
  }
  Sequences set(context(), 1 << 12);
  if (!sequences.empty())
    enter(set, uploaded, sequences, max_depth);
  else
    set.clear();
  const uint32_t count = set.collect(first_listener + static_cast<uint32_t>(rx.size()));
  const std::vector<uint64_t> table = set.table().read();
  std::map<Sequence, uint32_t> nodes;
  for (const uint32_t node : set.nodes().read(0, count)) nodes[sequence_of(table, node)] = node;
  std::vector<wt_wedge_candidate> candidates;
  for (const Question& q : questions)
    candidates.push_back({nodes.at({q.transmitter, q.before}),
                          nodes.at({first_listener + (of_one_listener ? 0 : q.receiver), q.after}),
                          {q.wedges[0], q.wedges.size() > 1 ? q.wedges[1] : WT_NONE},
                          q.receiver,
                          WT_ALL_QUARTERS});
  set.counters().restart(&wt_counters::wedge_candidates, static_cast<uint32_t>(candidates.size()), Stage::wedge_solve);
  WedgeSolve pass(context(), max_depth, limits ? bounds_wave_m : every_wave_m);
  const SolvedList& list = pass(uploaded, wedges.list(), ends, set.table(), context().buffer(candidates, "candidates"),
                                static_cast<uint32_t>(candidates.size()), set.counters(), limits);
  // Rows come in any order: a row answers the question with its ends and steps.
  std::map<std::tuple<uint32_t, uint32_t, std::vector<uint32_t>>, size_t> asked;
  for (size_t i = 0; i < questions.size(); ++i) {
    const Question& q = questions[i];
    std::vector<uint32_t> steps = q.before;
    for (const uint32_t w : q.wedges) steps.push_back(WT_STEP_DIFFRACTION | w);
    steps.insert(steps.end(), q.after.rbegin(), q.after.rend());
    asked[{q.transmitter, q.receiver, steps}] = i;
  }
  std::map<size_t, PathRow> out;
  const std::vector<PathRow> rows = download_rows(list);
  const auto headers = rows.empty() ? std::vector<wt_solved>{} : list.headers.read(0, list.count);
  for (size_t i = 0; i < rows.size(); ++i) {
    CHECK(headers[i].node == WT_NONE);
    CHECK(out.emplace(asked.at({headers[i].transmitter, headers[i].receiver, rows[i].steps}), rows[i]).second);
  }
  return out;
}

}  // namespace wavetracer::test
