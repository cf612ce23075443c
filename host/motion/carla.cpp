// SPDX-License-Identifier: Apache-2.0
// Recordings as text: lines are recognised by their beginnings; other lines are skipped.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "motion/carla_actors.hpp"
#include "motion/input_text.hpp"
#include "motion/text_rows.hpp"

namespace wavetracer {
namespace {

// Reads a line from its beginning on.
class Scanner {
 public:
  Scanner(const TextLines& lines, std::string_view text) : lines_(lines), rest_(text) {}

  bool skip(std::string_view words) {
    if (!rest_.starts_with(words)) return false;
    rest_.remove_prefix(words.size());
    return true;
  }
  void expect(std::string_view words) {
    if (!skip(words)) lines_.fail(fmt::format("'{}' is expected where the line has '{}'", words, rest_.substr(0, 40)));
  }
  // Returns the text before one of the characters.
  std::string_view until(std::string_view ends) {
    const std::string_view out = rest_.substr(0, rest_.find_first_of(ends));
    rest_.remove_prefix(out.size());
    return out;
  }
  double number(std::string_view ends) {
    const std::string_view text = until(ends);
    const std::optional<double> value = finite_number(text);
    if (!value) lines_.fail(fmt::format("'{}' is not a finite number", text));
    return *value;
  }
  uint64_t actor(std::string_view ends) {
    const double value = number(ends);
    if (!(value >= 0 && value <= 0xFFFFFFFFp0 && value == std::floor(value)))
      lines_.fail(fmt::format("{} is not the number of an actor", value));
    return static_cast<uint64_t>(value);
  }
  glm::dvec3 vector() {  // Reads "(1, 2, 3)".
    glm::dvec3 out;
    expect("(");
    for (int axis = 0; axis < 3; ++axis) {
      out[axis] = number(",)");
      expect(axis < 2 ? "," : ")");
    }
    return out;
  }

 private:
  const TextLines& lines_;
  std::string_view rest_;
};

class CarlaReader {
 public:
  CarlaReader(ByteStream& stream, const TrajectoryOptions& options) : lines_(stream), tracks_(stream.file(), options) {}

  Trajectories read() {
    while (lines_.next()) read_line(lines_.line());
    return tracks_.finish("call show_recorder_file_info with show_all=True");
  }

 private:
  void read_line(std::string_view line) {
    Scanner scan(lines_, line);
    if (scan.skip("Frame ")) return start_frame(scan);
    if (scan.skip(" Create ")) return create(scan);
    if (scan.skip("  Id: ")) return of_actor(scan);
    if (scan.skip("  ") && created_) attribute(trimmed(line));
    if (!line.starts_with("  ")) created_ = nullptr;
  }

  void start_frame(Scanner& scan) {
    created_ = nullptr;
    scan.until(" ");
    scan.expect(" at ");
    const double time_s = scan.number(" ");
    if (time_s_ && time_s <= *time_s_)
      lines_.fail(
          fmt::format("time does not go on, from {} s in line {} to {} s: the text has six digits only; give the "
                      "recording itself instead, the file that start_recorder has written",
                      *time_s_, frame_line_, time_s));
    time_s_ = time_s;
    frame_line_ = lines_.number();
    tracks_.begin_frame(time_s);
  }

  void create(Scanner& scan) {
    const uint64_t number = scan.actor(":");
    scan.expect(": ");
    created_ = &tracks_.create(number, std::string(scan.until(" ")));
  }

  void attribute(std::string_view text) {
    const size_t equals = text.find(" = ");
    if (equals != text.npos) created_->attribute(text.substr(0, equals), text.substr(equals + 3));
  }

  void of_actor(Scanner& scan) {
    const uint64_t number = scan.actor(" ");
    scan.expect(" ");
    CarlaActor* const actor = tracks_.moving(number);
    if (!actor) return;
    if (scan.skip("Location: ")) {
      if (!time_s_) lines_.fail("a position comes before the first frame");
      const glm::dvec3 location = scan.vector();
      scan.expect(" Rotation: ");
      tracks_.add({number, lines_.number(), *time_s_, location, scan.vector()});
    } else if (scan.skip("origin: ")) {
      const glm::dvec3 centre = scan.vector();
      scan.expect(" extension: ");
      actor->box(centre, scan.vector());
    }
  }

  TextLines lines_;
  CarlaTracks tracks_;
  CarlaActor* created_ = nullptr;  // the actor whose attributes follow
  std::optional<double> time_s_;
  uint64_t frame_line_ = 0;
};

}  // namespace

bool is_carla_recording(std::string_view start) {
  const size_t line = start.find('\n');
  return start.starts_with("Version: ") && line != start.npos && start.substr(line + 1).starts_with("Map: ");
}

Trajectories read_carla(ByteStream& stream, const TrajectoryOptions& options) {
  return CarlaReader(stream, options).read();
}

}  // namespace wavetracer
