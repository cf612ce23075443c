// Pages of what experiments found, in HTML and in Markdown: headings, sections, tables, drawings.
// Strings only. Assumes SVG as gnuplot writes it, with its identifiers in quotes and references that begin with #.
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

// Where numbers come from.
struct Heading {
  DeviceSummary device = {};
  std::string scene = "", command_line = "", date = "";
};
// With the date of today.
Heading heading_of(const Config& config, const DeviceSummary& device, const std::string& command_line);

// One experiment of a page.
struct Section {
  std::string name, title;
  std::string caption = "";  // of its plot
  Words words = {};          // without a paragraph: nothing was measured
  std::string svg = "";      // empty: gnuplot is absent or failed
  std::vector<std::string> notes = {};
  std::string problem = "";  // why there is nothing, or not all
};
Section section_of(const Experiment& experiment, const Findings& found);

// Device, scene, date, version and command, a line each.
std::string heading_markdown(const Heading& heading);

// A page of one section, whose plot is NAME.svg beside it.
std::string page_markdown(const Section& section, const Heading& heading);

// Text as HTML shows it, also between quotes of an attribute.
std::string escaped(std::string text);
// "<td>a</td><td>b</td>" of the tag "td".
std::string cells_html(const std::vector<std::string>& cells, const char* tag);
std::string table_html(const NumberTable& table);
// more: items beside those of the heading, after the scene.
std::string heading_html(const Heading& heading, const std::vector<std::string>& more = {});
std::string section_html(const Section& section);
// A page that refers to nothing outside of it.
std::string document_html(const std::string& title, const std::string& style, const std::string& body);

// The text of a file; empty where it cannot be read.
std::string file_text(const std::filesystem::path& file);
// An SVG document as an element of a page: no prolog, and identifiers that begin with `prefix`.
std::string inline_svg(const std::string& document, const std::string& prefix);

}  // namespace wavetracer::study
