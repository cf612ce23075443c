// SPDX-License-Identifier: Apache-2.0
// protozero reads the fields in any order; other fields are skipped.
// One message at a time is in memory.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <protozero/pbf_reader.hpp>
#include <vector>

#include "motion/input_text.hpp"
#include "motion/osi_schema.hpp"
#include "motion/track_builder.hpp"
#include "motion/track_motion.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using protozero::data_view;
using protozero::pbf_reader;
using protozero::pbf_wire_type;

constexpr uint64_t longest_message = uint64_t{1} << 28;

// Visits the fields of a message; fields that visit does not take are skipped.
template <class Visit>
void visit_fields(const data_view& message, const Visit& visit) {
  pbf_reader reader(message);
  while (reader.next())
    if (!visit(reader)) reader.skip();
}

bool is_message(const pbf_reader& reader, uint32_t field) {
  return reader.tag() == field && reader.wire_type() == pbf_wire_type::length_delimited;
}
bool is_number(const pbf_reader& reader, uint32_t field) {
  return reader.tag() == field && reader.wire_type() == pbf_wire_type::varint;
}

// Returns the last occurrence of a field that should appear once.
std::optional<data_view> sub_message(const data_view& message, uint32_t field) {
  std::optional<data_view> out;
  visit_fields(message, [&](pbf_reader& reader) {
    if (!is_message(reader, field)) return false;
    out = reader.get_view();
    return true;
  });
  return out;
}

std::optional<uint64_t> sub_number(const data_view& message, uint32_t field) {
  std::optional<uint64_t> out;
  visit_fields(message, [&](pbf_reader& reader) {
    if (!is_number(reader, field)) return false;
    out = reader.get_uint64();
    return true;
  });
  return out;
}

// Reads three doubles; missing ones are 0.
glm::dvec3 triple(const data_view& message) {
  glm::dvec3 out(0);
  visit_fields(message, [&](pbf_reader& reader) {
    const uint32_t field = reader.tag();
    if (field > osi::triple::third || reader.wire_type() != pbf_wire_type::fixed64) return false;
    out[static_cast<int>(field) - 1] = reader.get_double();
    return true;
  });
  return out;
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); }

// Returns the GroundTruth of a SensorView, which is its field 7, or nothing if the message is a GroundTruth itself. To
// tell them apart: field 7 of a GroundTruth is a traffic light, whose field 2 holds messages; field 2 of a GroundTruth
// is a time, which holds numbers.
std::optional<data_view> inner_ground_truth(const data_view& message) {
  const auto inside = sub_message(message, osi::sensor_view::global_ground_truth);
  if (!inside) return {};
  const auto time = sub_message(*inside, osi::ground_truth::timestamp);
  if (!time) return {};
  bool numbers = true;
  visit_fields(*time, [&](pbf_reader& reader) {
    numbers = numbers && reader.wire_type() == pbf_wire_type::varint;
    return false;
  });
  return numbers ? inside : std::nullopt;
}

// The fields of a moving object.
struct OsiObject {
  std::optional<uint64_t> number;
  std::string id, type;
  std::optional<data_view> base;
};

OsiObject read_object(const data_view& message) {
  OsiObject out;
  uint64_t object = 0, vehicle = 0;
  visit_fields(message, [&](pbf_reader& reader) {
    if (is_message(reader, osi::moving_object::id)) {
      out.number = sub_number(reader.get_view(), osi::identifier::value);
    } else if (is_message(reader, osi::moving_object::base)) {
      out.base = reader.get_view();
    } else if (is_number(reader, osi::moving_object::type)) {
      object = reader.get_uint64();
    } else if (is_message(reader, osi::moving_object::vehicle_classification)) {
      vehicle = sub_number(reader.get_view(), osi::vehicle_classification::type).value_or(0);
    } else if (is_message(reader, osi::moving_object::source_reference)) {
      std::string type;
      std::vector<std::string> identifiers;
      visit_fields(reader.get_view(), [&](pbf_reader& of) {
        if (is_message(of, osi::external_reference::type)) return type = of.get_string(), true;
        if (is_message(of, osi::external_reference::identifier)) return identifiers.push_back(of.get_string()), true;
        return false;
      });
      if (type == osi::reference_type && identifiers.size() == 2) out.id = identifiers[0], out.type = identifiers[1];
    } else {
      return false;
    }
    return true;
  });
  if (out.id.empty()) out.id = fmt::format("{}", out.number.value_or(0));
  if (out.type.empty())
    out.type = object == osi::vehicle_object      ? osi::class_of_number(vehicle)
               : object == osi::pedestrian_object ? "pedestrian"
                                                  : "other";
  return out;
}

class OsiReader {
 public:
  OsiReader(ByteStream& stream, const TrajectoryOptions& options) : stream_(stream), tracks_(stream.file(), options) {}

  Trajectories read() {
    std::string message;
    while (next(message)) {
      ++messages_;
      try {
        add(data_view(message));
      } catch (const protozero::exception& error) {
        fail(fmt::format("is damaged, or no message of OSI ({})", error.what()));
      }
    }
    if (tracks_.tracks().empty())
      throw InputError(
          fmt::format("{}: {} messages, and no moving object in them: a trace of GroundTruth "
                      "or SensorView messages is needed",
                      stream_.file(), messages_));
    if (repeated_ > 0)
      tracks_.warn(
          fmt::format("{}: {} messages have the time of the one before them, as those of several sensors do: "
                      "the first of each counts",
                      stream_.file(), repeated_));
    if (tilted_ > 0)
      tracks_.warn(fmt::format("{}: {} samples roll by more than {} rad, which is left out", stream_.file(), tilted_,
                               most_roll_rad));
    return tracks_.finish(ReferencePoint::centre);
  }

 private:
  static constexpr double most_roll_rad = 0.02;

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}: message {} {}", stream_.file(), messages_, what));
  }

  // Appends at most this many bytes; returns how many it appended.
  size_t take(uint64_t count, std::string& to) {
    const size_t before = to.size();
    while (to.size() - before < count) {
      if (rest_.empty()) rest_ = stream_.next();
      if (rest_.empty()) break;
      const std::string_view part = rest_.substr(0, count - (to.size() - before));
      to += part;
      rest_.remove_prefix(part.size());
    }
    return to.size() - before;
  }

  bool next(std::string& message) {
    std::string head;
    if (take(4, head) == 0) return false;
    uint64_t length = 0;
    for (size_t k = head.size(); k-- > 0;) length = length << 8 | static_cast<unsigned char>(head[k]);
    message.clear();
    if (length > longest_message)
      throw InputError(fmt::format("{}: message {} would have {} bytes: the file is damaged, or no binary trace of OSI",
                                   stream_.file(), messages_ + 1, length));
    if (head.size() < 4 || take(length, message) < length)
      throw InputError(fmt::format("{}: the file ends inside of message {}: it is incomplete; copy it again",
                                   stream_.file(), messages_ + 1));
    return true;
  }

  void add(const data_view& message) {
    const std::optional<data_view> inner = inner_ground_truth(message);
    const data_view truth = inner.value_or(message);
    const auto time = sub_message(truth, osi::ground_truth::timestamp);
    if (!time) fail("has no timestamp");
    const double time_s = seconds_of(*time);
    if (time_s_ && time_s == *time_s_) {
      ++repeated_;
      return;
    }
    if (time_s_ && time_s < *time_s_)
      fail(fmt::format("goes back in time, from {} to {} s: a trace must contain one run", *time_s_, time_s));
    time_s_ = time_s;
    visit_fields(truth, [&](pbf_reader& reader) {
      if (!is_message(reader, osi::ground_truth::moving_object)) return false;
      add_object(reader.get_view());
      return true;
    });
  }

  double seconds_of(const data_view& time) const {
    const auto whole = static_cast<int64_t>(sub_number(time, osi::timestamp::seconds).value_or(0));
    const uint64_t nanos = sub_number(time, osi::timestamp::nanos).value_or(0);
    if (nanos >= 1000000000 || std::abs(static_cast<double>(whole)) > 1e12)
      fail(fmt::format("has the time {} s and {} ns, which is none", whole, nanos));
    return static_cast<double>(whole) + 1e-9 * static_cast<double>(nanos);
  }

  void add_object(const data_view& message) {
    const OsiObject object = read_object(message);
    if (!object.number) fail("has a moving object without an id");
    const std::string what = fmt::format("moving object {}", *object.number);
    const auto position = object.base ? sub_message(*object.base, osi::base_moving::position) : std::nullopt;
    if (!position) fail(fmt::format("has no position of {}", what));
    const auto part = [&](uint32_t field) {
      const auto found = sub_message(*object.base, field);
      const auto out = found ? std::optional(triple(*found)) : std::nullopt;
      if (out && !is_finite(*out)) fail(fmt::format("has numbers of {} that are not finite", what));
      return out;
    };
    Sample sample;
    sample.time_s = *time_s_;
    sample.position_m = *part(osi::base_moving::position);
    auto size_m = part(osi::base_moving::dimension);
    if (size_m && !is_size(*size_m)) size_m.reset();
    glm::dvec3 up(0, 0, 1);
    if (const auto turn = part(osi::base_moving::orientation)) {
      tilted_ += std::abs(std::remainder(turn->x, 2 * std::numbers::pi)) > most_roll_rad;
      sample.yaw_rad = std::remainder(turn->z, 2 * std::numbers::pi);
      sample.pitch_rad = -std::remainder(turn->y, 2 * std::numbers::pi);
      if (const auto velocity = part(osi::base_moving::velocity))
        sample.speed_m_s = glm::dot(*velocity, heading(sample.yaw_rad, sample.pitch_rad));
      up = turned_arm({0, 0, 1}, sample.yaw_rad, sample.pitch_rad);
    }
    const auto known = sumo_type(object.type);
    sample.position_m -= 0.5 * (size_m ? size_m->z : known ? known->height_m : 0) * up;
    tracks_.add(object.id, object.type, sample, messages_, what, size_m);
  }

  ByteStream& stream_;
  TrackBuilder tracks_;
  std::string_view rest_;  // unread part of the chunk
  std::optional<double> time_s_;
  uint64_t messages_ = 0, repeated_ = 0, tilted_ = 0;
};

}  // namespace

// The file begins with a length below 16 MiB, then a field numbered at most 7 that is a message. No text begins like
// this.
bool is_osi_trace(std::string_view start) {
  if (start.size() < 5 || start[3] != 0) return false;
  const auto tag = static_cast<unsigned char>(start[4]);
  return (tag & 7) == 2 && tag >> 3 >= 1 && tag >> 3 <= 7;
}

Trajectories read_osi(ByteStream& stream, const TrajectoryOptions& options) {
  return OsiReader(stream, options).read();
}

}  // namespace wavetracer
