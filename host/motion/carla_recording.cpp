// SPDX-License-Identifier: Apache-2.0
// Recordings of CARLA as its server writes them: a header, then packets, each with its kind and length. The format is
// that of CARLA's ref_recorder_binary_file_format.md; numbers have the lowest byte first.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "motion/carla_actors.hpp"
#include "motion/readers.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view magic("\x0E\0CARLA_RECORDER", 16);
constexpr size_t version_bytes = 2, longest_packet = size_t{1} << 26;

enum Packet : uint8_t { frame_start = 0, event_add = 2, position = 6, bounding_box = 13 };

// Reads the numbers and texts of a packet from its beginning on; throws nothing, but counts what is missing.
class PacketReader {
 public:
  explicit PacketReader(std::string_view data) : rest_(data) {}

  template <class T>
  T number() {
    T out{};
    if (rest_.size() < sizeof out) {
      complete_ = false;
      rest_ = {};
      return out;
    }
    std::memcpy(&out, rest_.data(), sizeof out);
    rest_.remove_prefix(sizeof out);
    return out;
  }
  glm::dvec3 vector() {
    const double x = number<float>(), y = number<float>();
    return {x, y, number<float>()};
  }
  std::string_view text() {
    const size_t size = number<uint16_t>();
    complete_ = complete_ && size <= rest_.size();
    const std::string_view out = rest_.substr(0, size);
    rest_.remove_prefix(out.size());
    return out;
  }
  // Tells whether all that was read was there, and nothing is left.
  bool whole() const { return complete_ && rest_.empty(); }
  bool complete() const { return complete_; }

 private:
  std::string_view rest_;
  bool complete_ = true;
};

bool is_finite_vector(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

class RecorderReader {
 public:
  RecorderReader(ByteStream& stream, const TrajectoryOptions& options)
      : stream_(stream), tracks_(stream.file(), options) {}

  Trajectories read() {
    read_header();
    while (next_packet()) {
      PacketReader packet(data_);
      if (kind_ == frame_start) start_frame(packet);
      if (kind_ == event_add) create(packet);
      if (kind_ == position) place(packet);
      if (kind_ == bounding_box) box(packet);
      if (is_read(kind_) && !packet.whole())
        fail(
            fmt::format("has a packet of kind {} with {} bytes, which are not those of its entries: the file is "
                        "damaged, or of a version of CARLA that is not known here; give the text of "
                        "show_recorder_file_info(file, show_all=True) instead",
                        kind_, data_.size()));
    }
    return tracks_.finish("the recording ended before the first frame");
  }

 private:
  static bool is_read(uint8_t kind) {
    return kind == frame_start || kind == event_add || kind == position || kind == bounding_box;
  }
  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}: frame {} {}", stream_.file(), frame_, what));
  }

  // Appends at most this many bytes to `to`, or drops them without it; returns their number.
  size_t take(size_t count, std::string* to) {
    size_t taken = 0;
    while (taken < count) {
      if (rest_.empty()) rest_ = stream_.next();
      if (rest_.empty()) break;
      const std::string_view part = rest_.substr(0, count - taken);
      if (to) *to += part;
      rest_.remove_prefix(part.size());
      taken += part.size();
    }
    return taken;
  }

  // The header has the version, the magic text, the date, and the name of the map.
  void read_header() {
    constexpr size_t date_bytes = 8;
    std::string head, length;
    take(version_bytes + magic.size() + date_bytes, &head);
    take(sizeof(uint16_t), &length);
    const size_t map = PacketReader(length).number<uint16_t>();
    if (take(map, nullptr) < map)
      throw InputError(fmt::format("{}: the file ends inside of its header: copy it again", stream_.file()));
  }

  // Reads the next packet; the data of kinds that do not count are dropped. The last packet of a server that was killed
  // is incomplete.
  bool next_packet() {
    std::string head;
    const size_t got = take(sizeof(uint8_t) + sizeof(uint32_t), &head);
    if (got == 0) return false;
    PacketReader reader(head);
    kind_ = reader.number<uint8_t>();
    const size_t size = reader.number<uint32_t>();
    data_.clear();
    if (reader.complete() && is_read(kind_) && size > longest_packet)
      fail(fmt::format("has a packet of {} bytes: the file is damaged", size));
    if (reader.complete() && take(size, is_read(kind_) ? &data_ : nullptr) == size) return true;
    tracks_.warn(
        fmt::format("{}: the recording ends inside of a packet of frame {}, which is left out; was CARLA "
                    "killed while it recorded?",
                    stream_.file(), frame_));
    return false;
  }

  void start_frame(PacketReader& packet) {
    frame_ = packet.number<uint64_t>();
    packet.number<double>();  // its duration
    const double time_s = packet.number<double>();
    if (!std::isfinite(time_s) || (time_s_ && time_s < *time_s_))
      fail(fmt::format("is at {} s, before the frame ahead of it: the file is damaged", time_s));
    if (time_s_ && time_s == *time_s_) fail(fmt::format("is at {} s, as the frame ahead of it", time_s));
    time_s_ = time_s;
    tracks_.begin_frame(time_s);
  }

  void create(PacketReader& packet) {
    for (size_t left = packet.number<uint16_t>(); left > 0 && packet.complete(); --left) {
      const auto number = packet.number<uint32_t>();
      packet.number<uint8_t>();   // its type: the blueprint says more
      packet.vector();            // its location, which the positions repeat
      packet.vector();            // its rotation
      packet.number<uint32_t>();  // the number of its blueprint
      CarlaActor& actor = tracks_.create(number, std::string(packet.text()));
      for (size_t attributes = packet.number<uint16_t>(); attributes > 0 && packet.complete(); --attributes) {
        packet.number<uint8_t>();  // its type
        const std::string_view key = packet.text();
        actor.attribute(key, packet.text());
      }
    }
  }

  void place(PacketReader& packet) {
    for (size_t left = packet.number<uint16_t>(); left > 0 && packet.complete(); --left) {
      const auto number = packet.number<uint32_t>();
      const glm::dvec3 location = packet.vector(), rotation = packet.vector();
      if (!packet.complete() || !tracks_.moving(number)) continue;
      if (!time_s_) fail("has positions, but no frame has begun");
      if (!is_finite_vector(location) || !is_finite_vector(rotation))
        fail(fmt::format("has a position of actor {} that is not finite", number));
      tracks_.add({number, frame_, *time_s_, location, rotation});
    }
  }

  // Actors without a body, such as sensors, have boxes that are not finite.
  void box(PacketReader& packet) {
    for (size_t left = packet.number<uint16_t>(); left > 0 && packet.complete(); --left) {
      const auto number = packet.number<uint32_t>();
      const glm::dvec3 centre = packet.vector(), half = packet.vector();
      CarlaActor* const actor = tracks_.moving(number);
      if (actor && is_finite_vector(centre) && is_finite_vector(half)) actor->box(centre, half);
    }
  }

  ByteStream& stream_;
  CarlaTracks tracks_;
  std::string_view rest_;  // unread part of the chunk
  std::string data_;       // the bytes of the packet
  uint8_t kind_ = 0;       // the kind of the packet
  std::optional<double> time_s_;
  uint64_t frame_ = 0;
};

}  // namespace

bool is_carla_recorder_file(std::string_view start) {
  return start.size() > version_bytes && start.substr(version_bytes).starts_with(magic);
}

Trajectories read_carla_recorder_file(ByteStream& stream, const TrajectoryOptions& options) {
  return RecorderReader(stream, options).read();
}

}  // namespace wavetracer
