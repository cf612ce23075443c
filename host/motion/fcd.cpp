// SPDX-License-Identifier: Apache-2.0
// Turns XML elements of FCD into samples, as fcd_samples.hpp says.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "motion/fcd_samples.hpp"
#include "motion/input_text.hpp"
#include "motion/xml_stream.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

class FcdReader : private XmlStream {
 public:
  FcdReader(ByteStream& stream, const TrajectoryOptions& options)
      : XmlStream(stream, "an FCD output"), samples_(stream.file(), options) {}

  Trajectories read() {
    parse_all(
        "the file ends before </fcd-export>: let sumo finish, or cut off the last <timestep> and close the element");
    if (!samples_.started())
      throw InputError(fmt::format("{}: the file has no <timestep>, so nothing would move", file()));
    return samples_.finish();
  }

 private:
  enum class Level { document, root, timestep, vehicle };

  void end(std::string_view) override { --depth_; }

  void start(std::string_view name, Attributes attributes) override {
    switch (static_cast<Level>(std::min(depth_++, 3))) {
      case Level::document:
        if (name == "fcd-export") return;
        fail(fmt::format(
            "the root element is <{}>, but that of a trajectory file is <fcd-export>: run sumo with --fcd-output FILE",
            name));
      case Level::root:
        if (name != "timestep") fail(fmt::format("<{}> is outside of a <timestep>", name));
        return start_timestep(attributes);
      case Level::timestep:
        for (const FcdKind* kind : {&fcd_vehicle, &fcd_person, &fcd_container})
          if (name == kind->name) return add(*kind, attributes);
        if (unknown_.emplace(name).second) {
          samples_.warn(fmt::format("{}:{}: <{}> is unknown and was skipped", file(), line(), name));
        }
        return;
      case Level::vehicle:
        if (name == "person" || name == "container") samples_.add_rider();
    }
  }

  // SUMO begins a file with its configuration in a comment, which leaves out options at their defaults.
  void comment(std::string_view text) override {
    constexpr std::string_view key = "<fcd-output.geo value=\"";
    const size_t at = text.find(key);
    if (at == text.npos) return;
    text.remove_prefix(at + key.size());
    const std::string value = lower_case(text.substr(0, text.find('"')));
    // SUMO's options use these words for true.
    if (value == "true" || value == "1" || value == "yes" || value == "on" || value == "t" || value == "x") {
      samples_.in_degrees(line());
    }
  }

  void start_timestep(Attributes attributes) {
    const XML_Char* const text = find(attributes, "time");
    if (!text) fail("<timestep> has no attribute 'time'");
    samples_.start(text, line());
  }

  void add(const FcdKind& kind, Attributes attributes) {
    const XML_Char* const id = find(attributes, "id");
    if (!id) fail(fmt::format("<{}> has no attribute 'id'", kind.name));
    samples_.add(kind, id, fmt::format("<{} id=\"{}\">", kind.name, id), line(),
                 [&](std::string_view attribute) -> std::optional<std::string_view> {
                   const XML_Char* const text = find(attributes, attribute);
                   return text ? std::optional<std::string_view>(text) : std::nullopt;
                 });
  }

  FcdSamples samples_;
  int depth_ = 0;  // number of open elements
  std::set<std::string, std::less<>> unknown_;
};

}  // namespace

Trajectories read_fcd(ByteStream& stream, const TrajectoryOptions& options) {
  return FcdReader(stream, options).read();
}

}  // namespace wavetracer
