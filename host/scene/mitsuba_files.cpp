// SPDX-License-Identifier: Apache-2.0
// Follows the rules of Mitsuba's own parser: a parameter keeps the first value that it is given, the longest name that
// fits wins, and includes nest at most 15 deep.
#include "scene/mitsuba_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/input_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr size_t most_included_deep = 15, most_files = 1000;
// The largest length of an attribute: parameters that name each other several times would grow without bound.
constexpr size_t longest_attribute = 65536;

bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

// Turns toWorld into to_world.
std::string snake_case(std::string_view name) {
  std::string out;
  for (size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && is_upper(name[i]) && is_lower(name[i - 1])) out += '_';
    out += is_upper(name[i]) && !out.empty() ? static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])))
                                             : name[i];
  }
  return out;
}

}  // namespace

MitsubaFiles::MitsubaFiles(const std::filesystem::path& path) {
  folders_.push_back(path.parent_path());
  open_.push_back(path);
  const pugi::xml_node scene = load(path).xml.document_element();
  if (std::string_view(scene.name()) != "scene")
    throw InputError(fmt::format("{}: the root element is <{}>, but that of a Mitsuba scene is <scene>", where(scene),
                                 scene.name()));
  add_elements(scene, 0);
}

std::vector<std::string> MitsubaFiles::names() const {
  std::vector<std::string> out;
  for (const auto& document : documents_)
    if (std::ranges::find(out, document->path.string()) == out.end()) out.push_back(document->path.string());
  return out;
}

const MitsubaFiles::Document& MitsubaFiles::document_of(pugi::xml_node node) const {
  const auto found = std::ranges::find_if(documents_, [&](const auto& d) { return d->xml == node.root(); });
  return found == documents_.end() ? *documents_.front() : **found;
}

std::string MitsubaFiles::position(const Document& document, std::ptrdiff_t offset) const {
  const auto before = std::ranges::lower_bound(document.line_ends, offset) - document.line_ends.begin();
  return fmt::format("{}:{}", document.path.string(), 1 + before);
}

std::string MitsubaFiles::where(pugi::xml_node node) const { return position(document_of(node), node.offset_debug()); }

std::string MitsubaFiles::describe(pugi::xml_node node) {
  std::string out = fmt::format("<{}", node.name());
  for (const char* key : {"type", "id"}) {
    if (const auto a = node.attribute(key)) out += fmt::format(" {}=\"{}\"", key, a.value());
  }
  return out + ">";
}

void MitsubaFiles::fail(pugi::xml_node node, const std::string& what) const {
  throw InputError(fmt::format("{}: {}{}", where(node), describe(node), what));
}

std::string MitsubaFiles::attribute(pugi::xml_node node, const char* name) const {
  std::string value = node.attribute(name).value();
  for (size_t at = value.find('$'); at != std::string::npos; at = value.find('$', at)) {
    // The longest parameter wins: $resx before $res.
    const std::pair<std::string, std::string>* best = nullptr;
    for (const auto& entry : defaults_) {
      if (value.compare(at + 1, entry.first.size(), entry.first) != 0) continue;
      if (!best || entry.first.size() > best->first.size()) best = &entry;
    }
    if (!best) fail(node, fmt::format(": the parameter '{}' has no <default>", value.substr(at)));
    value.replace(at, best->first.size() + 1, best->second);
    at += best->second.size();
    if (value.size() > longest_attribute)
      fail(node,
           fmt::format(": {} is longer than {} characters once its parameters are replaced", name, longest_attribute));
  }
  return value;
}

void MitsubaFiles::check_attributes(pugi::xml_node node, std::initializer_list<std::string_view> known) const {
  for (const pugi::xml_attribute attribute : node.attributes()) {
    if (std::ranges::find(known, std::string_view(attribute.name())) != known.end()) continue;
    fail(node, fmt::format(" has the attribute {}, which is not known here; known: {}", attribute.name(),
                           fmt::join(known, ", ")));
  }
}

std::filesystem::path MitsubaFiles::find(pugi::xml_node node, const std::string& name) const {
  std::vector<std::filesystem::path> folders = folders_;
  folders.push_back(document_of(node).path.parent_path());
  std::error_code unnameable;  // ignores errors, such as a name that is too long
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path file = folder / name;
    if (std::filesystem::exists(file, unnameable)) return file;
  }
  const std::filesystem::path file = folders_.front() / name;
  fail(node, fmt::format(": there is no file {}{}", file.string(), backslash_hint(file)));
}

const MitsubaFiles::Document& MitsubaFiles::load(const std::filesystem::path& path) {
  documents_.push_back(std::make_unique<Document>(path, read_file(path)));
  Document& document = *documents_.back();
  for (size_t at = document.text.find('\n'); at != std::string::npos; at = document.text.find('\n', at + 1))
    document.line_ends.push_back(static_cast<std::ptrdiff_t>(at));
  const pugi::xml_parse_result parsed = document.xml.load_buffer(document.text.data(), document.text.size());
  if (!parsed)
    throw InputError(
        fmt::format("{}: not well-formed XML: {}", position(document, parsed.offset), parsed.description()));
  const pugi::xml_node root = document.xml.document_element();
  check_root(document, root);
  rename_old(root);
  return document;
}

void MitsubaFiles::check_root(const Document& document, pugi::xml_node root) const {
  if (const std::string_view tag = root.name(); tag == "osm" || tag == "additional" || tag == "polygons")
    throw InputError(
        fmt::format("{}: the root element is <{}>: this is a map; `wavetracer convert {} -o FOLDER` converts it to "
                    "a scene, FOLDER/city.xml",
                    where(root), root.name(), document.path.string()));
}

// Renames properties and operations of files before version 2.0.0, as Mitsuba does.
void MitsubaFiles::rename_old(pugi::xml_node root) const {
  const std::string_view text = root.attribute("version").value();
  if (text.empty()) return;
  int major = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), major);
  if (error != std::errc() || (end != text.data() + text.size() && *end != '.'))
    fail(root, fmt::format(": version=\"{}\" is no version; write version=\"3.0.0\"", text));
  if (major >= 2) return;
  struct Renamer : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      if (std::string_view(node.name()) == "lookAt") node.set_name("lookat");
      if (pugi::xml_attribute name = node.attribute("name"); name && std::string_view(node.name()) != "default")
        name.set_value(snake_case(name.value()).c_str());
      return true;
    }
  } renamer;
  root.traverse(renamer);
}

void MitsubaFiles::add_elements(pugi::xml_node scene, size_t depth) {
  for (const pugi::xml_node node : scene.children("default")) {
    check_attributes(node, {"name", "value"});
    const std::string name = node.attribute("name").value();
    if (name.empty()) fail(node, " needs a name");
    if (std::ranges::find(defaults_, name, &std::pair<std::string, std::string>::first) == defaults_.end())
      defaults_.emplace_back(name, attribute(node, "value"));
  }
  for (const pugi::xml_node node : scene.children("path")) {
    check_attributes(node, {"value"});
    folders_.push_back(find(node, attribute(node, "value")));
  }
  for (const pugi::xml_node node : scene.children()) {
    if (node.type() == pugi::node_element) add_element(node, depth);
  }
}

void MitsubaFiles::add_element(pugi::xml_node node, size_t depth) {
  const std::string_view tag = node.name();
  if (tag == "default" || tag == "path") return;
  if (tag != "include") {
    elements_.push_back(node);
    return;
  }
  check_attributes(node, {"filename"});
  if (attribute(node, "filename").empty()) fail(node, " needs filename=\"...\"");
  if (depth >= most_included_deep)
    fail(node, fmt::format(": files include each other more than {} deep", most_included_deep));
  if (documents_.size() >= most_files) fail(node, fmt::format(": more than {} files are included", most_files));
  const std::filesystem::path file = find(node, attribute(node, "filename"));
  if (const std::string problem = input_file_problem(file, "the included file"); !problem.empty())
    fail(node, fmt::format(": {}: {}", file.string(), problem));
  std::error_code error;
  if (std::ranges::any_of(open_, [&](const auto& open) { return std::filesystem::equivalent(open, file, error); }))
    fail(node, fmt::format(": {} includes itself", file.string()));
  open_.push_back(file);
  const pugi::xml_node root = load(file).xml.document_element();
  if (std::string_view(root.name()) == "scene") {
    add_elements(root, depth + 1);
  } else {
    add_element(root, depth + 1);
  }
  open_.pop_back();
}

}  // namespace wavetracer
