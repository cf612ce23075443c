// The simulation knows the world; what was found, only the results do.
#include "app/missing.hpp"
#include <fmt/format.h>

namespace wavetracer::app {
namespace {

std::vector<std::string> missing_words(const Simulation& simulation, const Results& results) {
  const Totals& totals = results.totals;
  const bool none = totals.counts.paths == 0;
  if (totals.frames == 0 || (simulation.frame_count() > 1 && !none)) return {};
  std::vector<Link> found;
  for (const LinkFigures& link : results.last_links)
    if (link.paths > 0) found.push_back({link.tx, link.rx});
  std::vector<std::string> out;
  if (none && totals.links == 0)
    out.push_back("no path was found, because no frame has a link: look at [links], and at when vehicles are there");
  else if (none)
    out.push_back(fmt::format("no path was found, of {} links in {} frame{}", totals.links, totals.frames,
                              totals.frames == 1 ? "" : "s"));
  else if (results.last_links.empty())
    return {};  // others have computed them
  for (std::string& text : simulation.explain_missing(totals.last, found)) out.push_back(std::move(text));
  return out;
}

}  // namespace

Run with_missing_words(const Simulation& simulation, const Run& run, Results& results) {
  Run out = run;
  const std::vector<std::string> words = missing_words(simulation, results);
  add_warnings(out.summary.warnings, words);
  add_warnings(results.totals.warnings, words);
  return out;
}

}  // namespace wavetracer::app
