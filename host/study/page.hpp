// SPDX-License-Identifier: Apache-2.0
// Makes pages of the results of experiments, in HTML and in Markdown: headings, sections, tables, drawings.
// It only handles strings. SVG is as gnuplot writes it, with its identifiers in quotes and references that begin with
// #.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "study/text.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

struct Experiment;
struct Findings;

// The origin of the numbers.
struct Heading {
  DeviceSummary device = {};
  std::string scene = "", command_line = "", date = "";
};
// Makes a heading with today's date.
Heading heading_of(const Config& config, const DeviceSummary& device, const std::string& command_line);

// One experiment of a page.
struct Section {
  std::string name, title;
  std::string caption = "";  // of its plot
  Words words = {};          // without a paragraph if nothing was measured
  std::string svg = "";      // empty if gnuplot is missing or failed
  std::vector<std::string> notes = {};
  std::string problem = "";  // why there is no result, or only a part of it
};
Section section_of(const Experiment& experiment, const Findings& found);

// Returns device, scene, date, version and command, one per line.
std::string heading_markdown(const Heading& heading);

// Returns a page of one section, whose plot is NAME.svg beside it.
std::string page_markdown(const Section& section, const Heading& heading);

// Returns the cells of a claim, its verdict, coloured, and what was measured. verdict_style() is their CSS.
std::string verdict_cells(const Verdict& verdict);
const char* verdict_style();
// Returns a table that can be scrolled sideways where the page is narrow.
std::string table_html(const NumberTable& table);
// more: items in addition to those of the heading, after the scene.
std::string heading_html(const Heading& heading, const std::vector<std::string>& more = {});
std::string section_html(const Section& section);

// Returns the text of a file; empty if it cannot be read.
std::string file_text(const std::filesystem::path& file);
// Returns an SVG document as an element of a page: without prolog, and with identifiers that begin with `prefix`.
std::string inline_svg(const std::string& document, const std::string& prefix);

}  // namespace wavetracer::study
