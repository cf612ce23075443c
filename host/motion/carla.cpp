// SPDX-License-Identifier: Apache-2.0
// Lines are recognised by their beginnings; other lines of a recording are skipped.
// An actor keeps its number; its box, if known, may come anywhere in the text.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "motion/input_text.hpp"
#include "motion/text_rows.hpp"
#include "motion/track_builder.hpp"
#include "motion/track_motion.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double centimetre = 0.01, degrees = std::numbers::pi / 180;

struct Actor {
  std::string blueprint, base_type, role;  // "vehicle.tesla.model3", "car", "hero"
  bool two_wheels = false;
  std::optional<glm::dvec3> box_centre_m, box_half_m;  // relative to its location: ahead, left, up
  bool moves() const { return blueprint.starts_with("vehicle.") || blueprint.starts_with("walker."); }
};

// The place of an actor, in CARLA's units.
struct CarlaSample {
  uint64_t actor, line;
  double time_s;
  glm::dvec3 location, rotation;  // roll, pitch, yaw
};

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
    uint64_t heroes = 0;
    for (const auto& [number, actor] : actors_) heroes += actor.role == "hero";
    for (const CarlaSample& sample : samples_) add(sample, heroes == 1);
    if (samples_.empty())
      throw InputError(fmt::format(
          "{}: the text has no positions of vehicles; call show_recorder_file_info with show_all=True", lines_.file()));
    if (unsized_ > 0)
      tracks_.warn(
          fmt::format("{}: {} samples are of actors without a bounding box, which have the size of their class: "
                      "start the recording with additional_data=True",
                      lines_.file(), unsized_));
    return tracks_.finish(ReferencePoint::centre);
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
      lines_.fail(fmt::format(
          "time does not go on, from {} s in line {} to {} s: the text has six digits only, so cut long recordings",
          *time_s_, frame_line_, time_s));
    time_s_ = time_s;
    frame_line_ = lines_.number();
  }

  void create(Scanner& scan) {
    Actor& actor = actors_[scan.actor(":")];
    scan.expect(": ");
    actor.blueprint = scan.until(" ");
    created_ = &actor;
  }

  void attribute(std::string_view text) {
    const size_t equals = text.find(" = ");
    if (equals == text.npos) return;
    const std::string_view key = text.substr(0, equals), value = text.substr(equals + 3);
    if (key == "base_type") created_->base_type = lower_case(value);
    if (key == "role_name") created_->role = value;
    if (key == "number_of_wheels") created_->two_wheels = value == "2";
  }

  void of_actor(Scanner& scan) {
    const uint64_t number = scan.actor(" ");
    scan.expect(" ");
    const auto actor = actors_.find(number);
    if (actor == actors_.end() || !actor->second.moves()) return;
    if (scan.skip("Location: ")) {
      if (!time_s_) lines_.fail("a position comes before the first frame");
      const glm::dvec3 location = scan.vector();
      scan.expect(" Rotation: ");
      samples_.push_back({number, lines_.number(), *time_s_, location, scan.vector()});
    } else if (scan.skip("origin: ")) {
      const auto metres = [](const glm::dvec3& v) { return centimetre * glm::dvec3(v.x, -v.y, v.z); };
      actor->second.box_centre_m = metres(scan.vector());
      scan.expect(" extension: ");
      actor->second.box_half_m = centimetre * scan.vector();
    }
  }

  static std::string_view type_of(const Actor& actor) {
    if (actor.blueprint.starts_with("walker.")) return "pedestrian";
    if (!actor.base_type.empty()) return actor.base_type;
    return actor.two_wheels ? "motorcycle" : "passenger";
  }

  void add(const CarlaSample& from, bool one_hero) {
    const Actor& actor = actors_.at(from.actor);
    Sample sample;
    sample.time_s = from.time_s;
    sample.position_m = centimetre * glm::dvec3(from.location.x, -from.location.y, from.location.z);
    sample.yaw_rad = -degrees * std::remainder(from.rotation.z, 360.0);
    sample.pitch_rad = degrees * std::remainder(from.rotation.y, 360.0);
    std::optional<glm::dvec3> size_m;
    if (actor.box_half_m && is_size(2.0 * *actor.box_half_m)) {
      size_m = 2.0 * *actor.box_half_m;
      const glm::dvec3 arm_m = *actor.box_centre_m - glm::dvec3(0, 0, actor.box_half_m->z);
      sample.position_m += turned_arm(arm_m, sample.yaw_rad, sample.pitch_rad);
    } else {
      ++unsized_;
    }
    const std::string id = one_hero && actor.role == "hero" ? "hero" : fmt::format("{}", from.actor);
    tracks_.add(id, type_of(actor), sample, from.line, fmt::format("actor {}", from.actor), size_m);
  }

  TextLines lines_;
  TrackBuilder tracks_;
  std::map<uint64_t, Actor> actors_;
  std::vector<CarlaSample> samples_;
  Actor* created_ = nullptr;  // the actor whose attributes follow
  std::optional<double> time_s_;
  uint64_t frame_line_ = 0, unsized_ = 0;
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
