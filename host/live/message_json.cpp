// SPDX-License-Identifier: Apache-2.0
// nlohmann's parser reports events, and values are built here: with its callback it would build them itself, and take
// time that grows as the square of the number of objects in an array.
#include "live/message_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "live/message.hpp"

namespace wavetracer::live {
namespace {

using nlohmann::json;

constexpr size_t max_depth = 4;     // levels: message, vehicles, vehicle, vector
constexpr size_t max_entries = 16;  // limit for arrays and objects except "vehicles"

// Depth, numbers of entries and repeated keys are checked before a value is built.
class MessageReader : public nlohmann::json_sax<json> {
 public:
  explicit MessageReader(size_t max_vehicles) : max_vehicles_(max_vehicles) {}

  json take() { return std::move(message_); }
  // Returns the number of the frame, once it was read.
  std::optional<uint64_t> frame() const { return frame_ <= max_frame ? frame_ : std::nullopt; }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override {
    if (open_.size() == 1 && key_ == "frame") frame_ = value;
    return add(value);
  }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // JSON has no binary values
  bool start_object(size_t) override { return start(json::object()); }
  bool start_array(size_t) override { return start(json::array()); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }

  bool key(string_t& name) override {
    if (!open_.back().keys.insert(name).second) refuse("bad_json", "the key " + in_quotes(name) + " occurs twice");
    if (open_.size() == 1) key_ = name;
    count_entry();
    open_.back().key = std::move(name);
    return true;
  }

  bool parse_error(size_t, const std::string&, const json::exception& error) override {
    // nlohmann's texts begin with [json.exception...] and may quote bytes that are not UTF-8.
    problem_ = error.what();
    if (const size_t end = problem_.find("] "); end != problem_.npos) problem_.erase(0, end + 2);
    for (char& c : problem_)
      if (c < ' ' || c > '~') c = '?';
    return false;
  }
  // Returns why the text is no JSON.
  std::string problem() const { return problem_.substr(0, 300); }

 private:
  struct Open {
    json* value;
    size_t entries = 0;
    std::set<std::string> keys = {};
    std::string key = {};  // the key whose value comes next
  };

  // Stores the value and returns its place, which is valid until the object around it gets the next one.
  json* place(json value) {
    if (open_.empty()) return &(message_ = std::move(value));
    Open& around = open_.back();
    if (around.value->is_object()) return &((*around.value)[around.key] = std::move(value));
    count_entry();
    around.value->push_back(std::move(value));
    return &around.value->back();
  }
  bool add(json value) {
    place(std::move(value));
    return true;
  }
  bool start(json value) {
    if (open_.size() >= max_depth)
      refuse("bad_json", fmt::format("arrays and objects are nested deeper than {} levels", max_depth));
    open_.push_back({place(std::move(value))});
    return true;
  }
  bool end() {
    open_.pop_back();
    return true;
  }
  // The limit for vehicles is max_vehicles, for any other list more than the protocol needs.
  void count_entry() {
    const size_t count = ++open_.back().entries;
    const bool vehicles = open_.size() == 2 && open_.back().value->is_array() && key_ == "vehicles";
    if (vehicles && count > max_vehicles_)
      refuse("no_place", fmt::format("frame: more than {} vehicles, which is the total count of all types: "
                                     "raise the counts of [[live_vehicle]]",
                                     max_vehicles_));
    if (!vehicles && count > max_entries)
      refuse("bad_json",
             fmt::format("an array or object has more than {} entries, and is not \"vehicles\"", max_entries));
  }

  size_t max_vehicles_;
  json message_;
  std::vector<Open> open_;  // open objects and arrays, from the message inwards
  std::string key_;         // key of the message
  std::string problem_;
  std::optional<uint64_t> frame_;
};

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, max_quoted_bytes)) out += c >= ' ' && c < 127 && c != '"' ? c : '?';
  return "\"" + out + (text.size() > max_quoted_bytes ? "...\"" : "\"");
}

void refuse(const char* code, const std::string& text) { throw ProtocolError(code, text); }

json read_message_json(std::string_view line, size_t max_vehicles) {
  MessageReader reader(max_vehicles);
  bool whole = false;
  try {
    whole = json::sax_parse(line.begin(), line.end(), &reader);
  } catch (ProtocolError& error) {
    error.frame = reader.frame();
    throw;
  }
  if (!whole) refuse("bad_json", reader.problem());
  return reader.take();
}

}  // namespace wavetracer::live
