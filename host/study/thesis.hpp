// `wavetracer bench thesis`: all figures of the thesis in one page, and what a cache's speed costs in error.
// Figures that share a study share its measurement. A figure that fails is named on the page, and the rest is there.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/run.hpp"

namespace wavetracer::study {

// The figures of the page, in order.
std::vector<const Recipe*> thesis_recipes();

// One figure of the page.
struct ThesisFigure {
  std::string name, title;
  Words words = {};      // without a paragraph: nothing was measured
  std::string svg = "";  // empty: gnuplot is absent or failed
  std::vector<std::string> notes = {};
  std::string problem = "";  // why there is nothing, or not all
};

struct ThesisPage {
  DeviceSummary device;
  std::string scene, command_line, date;
  std::vector<CacheRow> rows;  // of all studies, the reference first in each
  std::string svg;             // speed against error
  std::vector<ThesisFigure> figures;
};

// Of a cache: the setting without its hash function.
std::string family(const std::string& setting);
// The table thesis.csv, and the script that draws it: time saved against errors, a point a row.
std::string speed_error_table(const std::vector<CacheRow>& rows);
std::string speed_error_script(const std::vector<CacheRow>& rows, const std::string& device);
// A page without links to anything outside of it.
std::string thesis_html(const ThesisPage& page);
// Text as HTML shows it, also between quotes of an attribute.
std::string escaped(std::string text);
// An SVG document as an element of a page: no prolog, and identifiers that begin with `prefix`.
std::string inline_svg(const std::string& document, const std::string& prefix);

// `request_for`: the config of a recipe with its scene; throws for a mistake of the user's. Writes the files of every
// figure and thesis.{csv,gp,svg,html}.
Report run_thesis(const std::function<Request(const Recipe&)>& request_for, const Host& host);

}  // namespace wavetracer::study
