// SPDX-License-Identifier: Apache-2.0
// Parsing: the TOML tree is flattened into assignments to fields, --set options replace earlier ones, and only then is
// each checked and stored, so that a value overridden on the command line cannot fail.
#include "wavetracer/config_file.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <deque>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>
#include "base/input_file.hpp"
#include "base/spelling.hpp"
#include "config/contradictions.hpp"
#include "config/field_table.hpp"
#include "config/retired_keys.hpp"
#include "config/values.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using namespace config;
namespace fs = std::filesystem;

// The place of an assignment: a position in the file, or a --set.
struct Place {
  toml::source_position position{};  // position in the file
  size_t set = 0;                    // 1 + the index of the --set, 0 for the file
  bool operator<(const Place& o) const {
    return std::tie(set, position.line, position.column) < std::tie(o.set, o.position.line, o.position.column);
  }
};

struct Assignment {
  const Field* field;
  std::string key;  // name in messages: trace.rays, transmitter.name
  size_t element;   // index in an array of tables
  const toml::node* value;
  Place place;
};

const Table* find_table(std::string_view name) {
  for (const Table& table : tables())
    if (table.name == name) return &table;
  return nullptr;
}

const Field* find_field(const Table& table, std::string_view name) {
  for (const Field& field : table.fields)
    if (field.name == name) return &field;
  return nullptr;
}

std::vector<std::string> known_keys() {
  std::vector<std::string> keys;
  for (const Table& table : tables()) {
    keys.push_back(table.name);
    for (const Field& field : table.fields) keys.push_back(table.name + "." + field.name);
  }
  return keys;
}

// Returns the nearest key of the same table, or else of all tables.
std::string key_hint(const std::string& key) {
  const size_t dot = key.rfind('.');
  if (const Table* table = dot == key.npos ? nullptr : find_table(key.substr(0, key.find('.')))) {
    std::vector<std::string> names;
    for (const Field& field : table->fields) names.push_back(field.name);
    if (const std::string found = nearest_word(key.substr(dot + 1), names); !found.empty())
      return fmt::format("; did you mean \"{}.{}\"?", table->name, found);
  }
  return spelling_hint(key, known_keys());
}

// Says what to write instead of --set TABLE=VALUE.
std::string whole_table_words(const Table& table) {
  if (table.append)
    return fmt::format(
        "--set changes one key of a [[{0}]] that the file has: write {0}.INDEX.KEY=VALUE, such as {0}.0.{1}=...; "
        "to add a [[{0}]], write it into the file",
        table.name, table.fields[0].name);
  return fmt::format("{0} is a table: set one of its keys, {0}.KEY=VALUE, such as {0}.{1}=...", table.name,
                     table.fields[0].name);
}

bool is_aliases(const Field& field) {
  Config sample = prototype();
  return std::holds_alternative<Aliases*>(field.slot(sample, 0));
}

class Parser {
 public:
  Parser(std::string file, const std::vector<std::string>& sets)
      : file_(std::move(file)), folder_(fs::path(file_).parent_path()), sets_(sets) {}

  Config parse(std::string_view text) {
    try {
      document_ = toml::parse(text, file_);
    } catch (const toml::parse_error& e) {
      if (e.description().find("utf-8") != std::string_view::npos)
        throw ConfigError(file_ +
                          ": this is no text, and a configuration is a text in TOML; `wavetracer init` prints one");
      const bool escape = e.description().find("escape") != std::string_view::npos;
      fail(place(e.source()),
           fmt::format("{}{}", e.description(), escape ? "; write / instead of \\ between the names of folders" : ""));
      finish();
    }
    read_document();
    for (size_t i = 0; i < sets_.size(); ++i) read_set(i);
    config_.output.directory = resolved_path("", config_.output.directory);  // the default is relative, too
    for (const auto& [path, assignment] : assignments_) store(assignment);
    take_first_carrier();
    for (const auto& [key, said] : retired_)
      if (!said.first->is_boolean() || said.first->as_boolean()->get()) fail(said.second, find_retired(key)->advice);
    finish();
    check_whole();
    finish();
    config_.receiver_grids = one_of_each_height(config_.receiver_grids);
    config_.file = file_;
    config_.text = echoed_config(config_);
    return std::move(config_);
  }

 private:
  std::string file_;
  fs::path folder_;  // the folder from which relative paths of the file start
  const std::vector<std::string>& sets_;
  toml::table document_;
  std::deque<toml::table> set_documents_;
  Config config_;
  std::map<std::string, Assignment> assignments_;                            // by unique path: transmitter.0.name
  std::map<std::string_view, std::pair<const toml::node*, Place>> retired_;  // by key
  // Positions of [[transmitter]] and other arrays of tables.
  std::map<std::string, std::vector<toml::source_position>> elements_;
  std::vector<std::pair<Place, std::string>> problems_;

  static Place place(const toml::source_region& region) { return {region.begin, 0}; }
  void fail(const Place& where, std::string what) { problems_.emplace_back(where, std::move(what)); }

  std::string said(const Place& p) const {
    if (p.set > 0) return "--set " + sets_[p.set - 1];
    return fmt::format("{}:{}:{}", file_.empty() ? "config" : file_, std::max(p.position.line, 1u),
                       std::max(p.position.column, 1u));
  }

  // Throws if there are problems, in the order of the file.
  void finish() {
    if (problems_.empty()) return;
    std::stable_sort(problems_.begin(), problems_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string message;
    for (const auto& [where, what] : problems_) message += (message.empty() ? "" : "\n") + said(where) + ": " + what;
    throw ConfigError(message);
  }

  void unknown(const Place& where, const std::string& key) {
    fail(where, fmt::format("unknown key \"{}\"{}", key, key_hint(key)));
  }

  // The last value of a retired key counts: false is accepted and has no effect.
  void retired_or_unknown(const Place& where, const std::string& key, const toml::node& value) {
    if (const RetiredKey* const retired = find_retired(key))
      retired_.insert_or_assign(retired->key, std::pair(&value, where));
    else
      unknown(where, key);
  }

  void read_document() {
    for (const auto& [name, node] : document_) {
      const Table* table = find_table(name.str());
      if (!table) {
        unknown(place(name.source()), std::string(name.str()));
      } else if (table->append) {
        read_array(*table, node);
      } else if (const toml::table* body = node.as_table()) {
        read_table(*table, *body, table->name, 0);
      } else {
        fail(place(node.source()), fmt::format("{0} must be a table: write [{0}]", table->name));
      }
    }
  }

  void read_array(const Table& table, const toml::node& node) {
    const toml::array* array = node.as_array();
    const bool of_tables = array && std::all_of(array->begin(), array->end(), [](auto& n) { return n.is_table(); });
    if (!of_tables) return fail(place(node.source()), fmt::format("write [[{}]], one table per element", table.name));
    for (const toml::node& element : *array) {
      const size_t i = table.append(config_);
      elements_[table.name].push_back(element.source().begin);
      read_table(table, *element.as_table(), fmt::format("{}.{}", table.name, i), i);
    }
  }

  void read_table(const Table& table, const toml::table& body, const std::string& path, size_t element) {
    for (const auto& [name, node] : body) {
      const std::string key = table.name + "." + std::string(name.str());
      const Field* field = find_field(table, name.str());
      if (!field) {
        retired_or_unknown(place(name.source()), key, node);
      } else if (!is_aliases(*field)) {
        assign_later(path + "." + field->name, {field, key, element, &node, place(node.source())});
      } else if (const toml::table* entries = node.as_table()) {
        for (const auto& [from, to] : *entries) {
          const std::string entry = key + "." + std::string(from.str());
          assign_later(entry, {field, entry, element, &to, place(to.source())});
        }
      } else {
        fail(place(node.source()), fmt::format("{0} must be a table: write [{0}]", key));
      }
    }
  }

  void assign_later(const std::string& path, Assignment assignment) {
    assignments_.insert_or_assign(path, std::move(assignment));
  }

  // Reads --set key=value. Keys in arrays of tables carry an index: transmitter.0.position_m.
  void read_set(size_t index) {
    const std::string& text = sets_[index];
    const Place where{{}, index + 1};
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) return fail(where, "write it as key=value, such as trace.rays=1e5");
    const std::string key = text.substr(0, equals);
    const size_t dot = key.find('.');
    const Table* table = find_table(key.substr(0, dot));
    if (!table) return unknown(where, key);
    if (dot == std::string::npos) return fail(where, whole_table_words(*table));
    std::string name = key.substr(dot + 1);
    size_t element = 0;
    if (table->append) {
      const size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
      const size_t count = elements_[table->name].size();
      if (digits == 0 || digits > 6 || name.substr(digits, 1) != ".")
        return fail(where, fmt::format("write {0}.INDEX.KEY, such as {0}.0.{1}", table->name, table->fields[0].name));
      element = std::stoul(name.substr(0, digits));
      name = name.substr(digits + 1);
      if (element >= count)
        return fail(where, fmt::format("the file has {} [[{}]], counted from 0", count, table->name));
    }
    const Field* field = find_field(*table, name);
    if (!field) {  // it is one entry of a table of strings: scene.material_alias.NAME
      const Field* aliases = find_field(*table, name.substr(0, name.find('.')));
      if (aliases && name.find('.') != std::string::npos && is_aliases(*aliases)) field = aliases;
    } else if (is_aliases(*field)) {
      return fail(where, fmt::format("write {}.NAME=MATERIAL", key));
    }
    const toml::node* const value = parse_value(text.substr(equals + 1), where);
    if (!value) return;
    if (!field)
      retired_or_unknown(where, table->name + "." + name, *value);
    else
      assign_later(key, {field, table->name + "." + name, element, value, where});
  }

  // Parses the value as TOML; other text is taken as a string, unless it begins like a TOML string, array or table.
  const toml::node* parse_value(const std::string& text, const Place& where) {
    try {
      set_documents_.push_back(toml::parse("value = " + text));
      if (set_documents_.back().size() == 1) return set_documents_.back().get("value");
    } catch (const toml::parse_error& e) {
      if (text.find_first_of("\"'[{") == 0) {
        fail(where, std::string(e.description()));
        return nullptr;
      }
    }
    set_documents_.push_back(toml::table{{"value", text}});
    return set_documents_.back().get("value");
  }

  void store(const Assignment& a) {
    const Slot slot = a.field->slot(config_, a.element);
    const std::string problem = assign(*a.field, a.key, slot, *a.value, a.place.set > 0 ? fs::path() : folder_);
    if (!problem.empty()) fail(a.place, problem);
  }

  // If there are several carriers, the first one is the main carrier.
  void take_first_carrier() {
    RadioConfig& radio = config_.radio;
    if (radio.frequencies_hz.empty()) return;
    const double first_hz = radio.frequencies_hz.front();
    if (assignments_.contains("radio.frequency_hz") && radio.frequency_hz != first_hz)
      fail(place_of("radio.frequency_hz"),
           fmt::format("radio.frequency_hz = {} is not the first of radio.frequencies_hz, {}: remove one of the keys",
                       radio.frequency_hz, first_hz));
    radio.frequency_hz = first_hz;
  }

  // Returns the place of a key (transmitter.0.name), else of its table (transmitter.0), else the head of the file.
  Place place_of(const std::string& path) const {
    const auto found = assignments_.find(path);
    if (found != assignments_.end()) return found->second.place;
    const size_t dot = path.find('.');
    const std::string table = path.substr(0, dot);
    if (const auto places = elements_.find(table); places != elements_.end() && dot != std::string::npos)
      return {places->second[std::stoul(path.substr(dot + 1))], 0};
    const toml::node* node = document_.get(table);
    return node && node->is_table() ? place(node->source()) : Place{};
  }

  void check_required(const Table& table, const Field& field, size_t i, const Place& where) {
    const bool given = assignments_.contains(fmt::format("{}.{}.{}", table.name, i, field.name));
    const bool other = replaced(table, field, config_, i);
    if (given && other)
      fail(place_of(fmt::format("{}.{}.{}", table.name, i, field.instead)),
           fmt::format("[[{}]] has both {} and {}: remove one of them", table.name, field.name, field.instead));
    if (!given && !other)
      fail(where, fmt::format("[[{}]] has no {}: give it {}{}", table.name, field.name, accepted(field),
                              field.instead.empty() ? "" : fmt::format(", or give {}", field.instead)));
  }

  // Checks what needs the whole configuration: missing keys, and keys that exclude each other.
  void check_whole() {
    for (const Table& table : tables()) {
      const auto places = elements_.find(table.name);
      if (places == elements_.end()) continue;
      for (size_t i = 0; i < places->second.size(); ++i)
        for (const Field& field : table.fields)
          if (field.required) check_required(table, field, i, {places->second[i], 0});
    }
    for (const Contradiction& found : contradictions(config_)) {
      Place where;
      for (const std::string& key : found.keys) where = std::max(where, place_of(key));
      fail(where, found.what);
    }
  }
};

}  // namespace

Config parse_config(std::string_view toml, const std::string& file_name, const std::vector<std::string>& sets) {
  return Parser(file_name, sets).parse(toml);
}

Config load_config(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  constexpr uint64_t most_bytes = uint64_t{64} << 20;
  const auto fail = [&](const std::string& why) {
    throw ConfigError(fmt::format("{}: cannot be read as a config file: {}; `wavetracer init` prints one to start from",
                                  file.string(), why));
  };
  if (const std::string problem = input_file_problem(file, "a configuration", most_bytes); !problem.empty())
    fail(problem);
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("you have no permission to read it");
  std::ostringstream text;
  if (!(text << in.rdbuf())) fail("it is empty");
  return parse_config(text.str(), file.string(), sets);
}

}  // namespace wavetracer
