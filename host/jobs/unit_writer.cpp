// SPDX-License-Identifier: Apache-2.0
// The caller and the thread share mail; the thread alone works at the desk until it is idle.
// Objects that a Run refers to must not change while frames are computed.
#include "jobs/unit_writer.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>
#include <utility>
#include "base/digits.hpp"

namespace wavetracer {
namespace {

constexpr size_t most_waiting_bytes = size_t{1} << 26;

size_t bytes_of(const RadarRows& rows) {
  size_t out = 0;
  for (const RadarRow& row : rows)
    out += row.cube.size() * sizeof row.cube[0] + row.power_dbm.size() * sizeof row.power_dbm[0];
  return out;
}

// Estimates the memory of a frame.
size_t bytes_of(const FrameResult& frame) {
  constexpr size_t path = 180, vertex = 33, waypoint = 53, entry = 36, beam = 24, fields = 80;
  const WorldState& world = frame.world;
  size_t radars = 0;
  for (const RadarRows& radar : frame.radars) radars += bytes_of(radar);
  return radars + frame.paths.size() * path + frame.paths.vertex_position_m.size() * vertex +
         frame.waypoints.size() * waypoint + frame.cache_entries.size() * entry +
         frame.responses.h.size() * sizeof frame.responses.h[0] + frame.beams.size() * beam +
         frame.carriers.size() * frame.paths.size() * fields + world.links.size() * sizeof(Link) +
         world.instances.size() * sizeof(Placement) +
         (world.transmitters.size() + world.receivers.size()) * sizeof(EndState);
}

// Does the same for a request; zero unless it brings a frame.
size_t bytes_in(const auto& request) {
  const auto* frame = std::get_if<FrameResult>(&request);
  return frame ? bytes_of(*frame) : 0;
}

}  // namespace

UnitWriter::UnitWriter(const Run& run, Shards& shards, Progress& progress)
    : run_(run), shards_(shards), progress_(progress) {
  thread_ = std::thread([this] { work(); });
}

UnitWriter::~UnitWriter() {
  mail_.with([](Mail& mail) { mail.requests.emplace_back(Quit{}); });
  thread_.join();
}

void UnitWriter::follow(std::unique_ptr<MergeAhead> ahead) { request(Follow{std::move(ahead)}); }

void UnitWriter::look_ahead() { request(Look{}); }

void UnitWriter::begin(const Unit& unit) { request(Begin{unit}); }

void UnitWriter::add(FrameResult frame) { request(std::move(frame)); }

std::optional<FrameResult> UnitWriter::take_written() {
  return mail_.with([](Mail& mail) { return std::exchange(mail.written, {}); });
}

void UnitWriter::end() {
  const auto none_ends = [](const Mail& mail) {
    return mail.news.failure || std::ranges::none_of(mail.requests, [](const Request& request) {
             return std::holds_alternative<End>(request);
           });
  };
  mail_.when(none_ends, [](Mail&) {});
  request(End{});
  look_ahead();
}

void UnitWriter::drop() { request(Drop{}); }

void UnitWriter::finish() {
  owner_.check("unit writer");
  collect(mail_.when([](const Mail& mail) { return mail.requests.empty(); }, take_news));
}

std::unique_ptr<OpenUnit> UnitWriter::take_unfinished() {
  finish();
  return desk_.with([](Desk& desk) { return std::move(desk.open); });
}

std::unique_ptr<MergeAhead> UnitWriter::take_ahead() {
  finish();
  return desk_.with([](Desk& desk) { return std::move(desk.ahead); });
}

UnitWriter::News UnitWriter::take_news(Mail& mail) { return {std::exchange(mail.news.written, {}), mail.news.failure}; }

// Units written so far count as finished from here on; throws the exception of the thread.
void UnitWriter::collect(const News& news) {
  for (const Shard& shard : news.written) {
    shards_.finish(shard);
    progress_.line(fmt::format("{}: {} paths", unit_words(shard.unit), grouped(shard.totals.counts.paths)));
  }
  if (news.failure) std::rethrow_exception(news.failure);
}

void UnitWriter::request(Request request) {
  owner_.check("unit writer");
  collect(mail_.when([](const Mail& mail) { return mail.frame_bytes <= most_waiting_bytes; }, take_news));
  mail_.with([&](Mail& mail) {
    mail.frame_bytes += bytes_in(request);
    mail.requests.push_back(std::move(request));
  });
}

void UnitWriter::work() {
  for (;;) {
    bool failed = false;
    // An empty request of the same kind stays in the mail until this one is done.
    Request first = mail_.when([](const Mail& mail) { return !mail.requests.empty(); },
                               [&](Mail& mail) {
                                 failed = mail.news.failure != nullptr;
                                 return std::move(mail.requests.front());
                               });
    if (std::holds_alternative<Quit>(first)) return;
    const size_t bytes = bytes_in(first);
    if (!failed) perform(first);
    std::optional<FrameResult> written;
    if (auto* frame = std::get_if<FrameResult>(&first)) written = std::move(*frame);
    first = Look{};
    mail_.with([&](Mail& mail) {
      mail.requests.pop_front();
      mail.frame_bytes -= bytes;
      if (written) std::swap(mail.written, written);  // the memory of an earlier frame is freed
    });
  }
}

void UnitWriter::perform(Request& request) {
  try {
    desk_.with([&](Desk& desk) { std::visit([&](auto& what) { perform(desk, what); }, request); });
  } catch (...) {
    mail_.with([](Mail& mail) { mail.news.failure = std::current_exception(); });
  }
}

void UnitWriter::perform(Desk& desk, Follow& request) { desk.ahead = std::move(request.ahead); }

void UnitWriter::perform(Desk& desk, Look&) {
  if (desk.ahead) desk.ahead->look();
}

void UnitWriter::perform(Desk& desk, Begin& request) {
  if (desk.open) throw std::logic_error("unit writer: a unit was begun before the one before was ended");
  desk.open = shards_.open(run_, request.unit);
}

void UnitWriter::perform(Desk& desk, FrameResult& frame) {
  if (!desk.open) throw std::logic_error("unit writer: a frame came without a unit");
  desk.open->add(frame);
}

void UnitWriter::perform(Desk& desk, End&) {
  if (!desk.open) throw std::logic_error("unit writer: no unit was begun that could end");
  Shard shard = shards_.close(*desk.open);
  desk.open.reset();
  mail_.with([&](Mail& mail) { mail.news.written.push_back(std::move(shard)); });
}

void UnitWriter::perform(Desk& desk, Drop&) { desk.open.reset(); }

}  // namespace wavetracer
