// SPDX-License-Identifier: Apache-2.0
// `wavetracer thesis all`, or with several names: figures of the thesis in one page, and the error that a cache's speed
// costs. Figures that share a study share its measurement. If a figure fails, the page says so, and has the others.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/page.hpp"
#include "study/run.hpp"

namespace wavetracer::study {

// Returns the experiments of the page, in order: the thesis' figures, then further studies of caches.
std::vector<const Experiment*> thesis_experiments();

struct ThesisPage {
  Heading heading;
  std::vector<CacheRow> rows;  // rows of all studies, the reference first in each
  std::string svg;             // speed against error
  std::vector<Section> figures;
};

// Returns the setting of a cache without its hash function.
std::string family(const std::string& setting);
// Returns the table thesis.csv and what draws it: time saved against errors, a point per row.
plots::Figure speed_error_figure(const std::vector<CacheRow>& rows, const std::string& device);
// Returns every claim with its origin, its outcome and what was measured; for a figure without claims, its result.
// Columns: figure, claim, origin, verdict, measured.
NumberTable verdicts_of(const std::vector<Section>& figures);
// Returns how many claims of each origin have each outcome; figures without claims do not count.
NumberTable outcome_counts(const std::vector<Section>& figures);
std::string thesis_html(const ThesisPage& page);
// Returns the verdicts, then every figure's words and plot, which is NAME.svg beside it.
std::string thesis_markdown(const ThesisPage& page);

// Runs experiments in this order; the first one's request decides folder and device. request_for: returns the config of
// an experiment with its scene; throws for a mistake of the user. Writes the files of every figure and
// thesis.{csv,gp,svg,html,md}.
Report run_thesis(const std::vector<const Experiment*>& figures,
                  const std::function<Request(const Experiment&)>& request_for, const Host& host);

}  // namespace wavetracer::study
