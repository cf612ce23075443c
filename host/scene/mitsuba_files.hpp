// SPDX-License-Identifier: Apache-2.0
// The elements of a Mitsuba scene file and of the files that it includes, as Mitsuba 3.5 reads them: <default>
// parameters replaced, camelCase names of files of version < 2 renamed, <include> and <path> followed.
// The files are not trusted; every message names file and line.
#pragma once
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file.hpp"

namespace wavetracer {

class MitsubaFiles {
 public:
  // Throws InputError if a file cannot be read, is no Mitsuba scene, or includes itself.
  explicit MitsubaFiles(const std::filesystem::path& path);

  // Returns the children of <scene>; those of included files stand in the place of <include>.
  const std::vector<pugi::xml_node>& elements() const { return elements_; }
  // Returns the names of the files that were read, the scene file first.
  std::vector<std::string> names() const;

  // Returns "file:line" of an element.
  std::string where(pugi::xml_node node) const;
  // Returns text such as "<shape type="ply" id="mesh-floor">" for messages.
  static std::string describe(pugi::xml_node node);
  [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const;

  // Returns an attribute with its $parameters replaced, or an empty string if it is absent. Throws if a parameter is
  // unknown or the text becomes longer than 64 KiB.
  std::string attribute(pugi::xml_node node, const char* name) const;
  // Throws if an element has an attribute that is not in the list.
  void check_attributes(pugi::xml_node node, std::initializer_list<std::string_view> known) const;
  // Returns the file that an element names, from the first folder that has it: that of the scene, those of <path>, that
  // of the file with the element. Throws if there is none.
  std::filesystem::path find(pugi::xml_node node, const std::string& name) const;

 private:
  struct Document {
    std::filesystem::path path;
    std::string text;
    pugi::xml_document xml = {};
    std::vector<std::ptrdiff_t> line_ends = {};
  };

  const Document& document_of(pugi::xml_node node) const;
  std::string position(const Document& document, std::ptrdiff_t offset) const;
  const Document& load(const std::filesystem::path& path);
  void check_root(const Document& document, pugi::xml_node root) const;
  void rename_old(pugi::xml_node root) const;
  void add_elements(pugi::xml_node scene, size_t depth);
  void add_element(pugi::xml_node node, size_t depth);

  std::vector<std::unique_ptr<Document>> documents_;
  std::vector<std::filesystem::path> folders_;  // folders in which files are searched
  std::vector<std::filesystem::path> open_;     // files that are being added, each included by the one before
  std::vector<std::pair<std::string, std::string>> defaults_;
  std::vector<pugi::xml_node> elements_;
};

}  // namespace wavetracer
