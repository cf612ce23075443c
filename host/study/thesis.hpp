// `wavetracer bench thesis`: all figures of the thesis in one page, and what a cache's speed costs in error.
// Figures that share a study share its measurement. A figure that fails is named on the page, and the rest is there.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/page.hpp"
#include "study/run.hpp"

namespace wavetracer::study {

// The experiments of the page, in order: the thesis' figures, then further studies of caches.
std::vector<const Experiment*> thesis_experiments();

struct ThesisPage {
  Heading heading;
  std::vector<CacheRow> rows;  // of all studies, the reference first in each
  std::string svg;             // speed against error
  std::vector<Section> figures;
};

// Of a cache: the setting without its hash function.
std::string family(const std::string& setting);
// The table thesis.csv, and the script that draws it: time saved against errors, a point per row.
std::string speed_error_table(const std::vector<CacheRow>& rows);
std::string speed_error_script(const std::vector<CacheRow>& rows, const std::string& device);
// Every claim with its outcome and what was measured; of a figure without one, what there is to know of it. Columns:
// figure, claim, verdict, measured.
NumberTable verdicts_of(const std::vector<Section>& figures);
// "Of 90 claims, 40 are reproduced, 10 are exceeded, 20 hold in part, 15 are refuted, and 5 could not be judged."
std::string outcome_counts(const std::vector<Section>& figures);
std::string thesis_html(const ThesisPage& page);
// The verdicts, then every figure's words and plot, which is NAME.svg beside it.
std::string thesis_markdown(const ThesisPage& page);

// `request_for`: the config of an experiment with its scene; throws for a mistake of the user's. Writes the files of
// every figure and thesis.{csv,gp,svg,html,md}.
Report run_thesis(const std::function<Request(const Experiment&)>& request_for, const Host& host);

}  // namespace wavetracer::study
