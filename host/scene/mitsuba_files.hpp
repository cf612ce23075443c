// The elements of a Mitsuba scene file and of the files that it includes, as Mitsuba 3.5 reads them: <default>
// parameters replaced, camelCase names of files of version < 2 renamed, <include> and <path> followed.
// Assumes nothing of the files; every message names file and line.
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
  // Throws InputError where a file cannot be read, is no Mitsuba scene, or includes itself.
  explicit MitsubaFiles(const std::filesystem::path& path);

  // Children of <scene>, those of included files in the place of <include>.
  const std::vector<pugi::xml_node>& elements() const { return elements_; }
  // That were read, the scene file first.
  std::vector<std::string> names() const;

  // "file:line" of an element.
  std::string where(pugi::xml_node node) const;
  // "<shape type="ply" id="mesh-floor">", for messages.
  static std::string describe(pugi::xml_node node);
  [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const;

  // An attribute with its $parameters replaced; the empty string where it is absent. Throws where a parameter is not
  // known, and where the text becomes longer than 64 KiB.
  std::string attribute(pugi::xml_node node, const char* name) const;
  // Throws where an element has an attribute that is not among these.
  void check_attributes(pugi::xml_node node, std::initializer_list<std::string_view> known) const;
  // The file that an element names, in the first folder that has it: that of the scene, those of <path>, that of the
  // file with the element. Throws where there is none.
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
  std::vector<std::filesystem::path> folders_;  // where files are looked for
  std::vector<std::filesystem::path> open_;     // those whose elements are added, each included by the one before
  std::vector<std::pair<std::string, std::string>> defaults_;
  std::vector<pugi::xml_node> elements_;
};

}  // namespace wavetracer
