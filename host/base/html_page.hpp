// SPDX-License-Identifier: Apache-2.0
// A page of text, tables and drawings in HTML. Text is escaped by xml_text.
// The page of a run is none of these: it is a program of its own, in viewer/page, whose data are filled in.
#pragma once
#include <string>
#include <vector>

namespace wavetracer {

// Returns a page that refers to nothing outside of it. title: text; style: CSS after that of all pages; body and head:
// HTML, the latter elements of <head> besides the title.
std::string html_page(const std::string& title, const std::string& style, const std::string& body,
                      const std::string& head = "");

// Returns "<td>a</td><td>b</td>" for the tag "td", with escapes.
std::string html_cells(const std::vector<std::string>& cells, const char* tag);

}  // namespace wavetracer
