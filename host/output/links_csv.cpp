// Writes the figures of radio/links.hpp as comma-separated text, sorted by frame, transmitter, receiver.
// Text is made and written a frame at a time, so memory stays small.
#include "output/links_csv.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include "output/copy_pieces.hpp"
#include "radio/links.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view header =
    "time_s,tx,rx,paths,path_gain_db,mean_delay_s,rms_delay_spread_s,doppler_spread_hz,los,missed_power_share\n";

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

// A field as RFC 4180, section 2, wants it: quoted where it holds a comma, a quote or a line end.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::vector<std::string> labels(const std::vector<RadioEnd>& ends) {
  std::vector<std::string> result;
  for (const RadioEnd& end : ends)
    result.push_back(end.name.empty() ? std::to_string(result.size()) : quoted(end.name));
  return result;
}

}  // namespace

LinksCsv::LinksCsv(const Run& run, const std::filesystem::path& path)
    : file_(path), tx_(labels(run.config.transmitters)), rx_(labels(run.config.receivers)) {
  file_.write(bytes(header));
}

void LinksCsv::add(const FrameResult& frame) {
  std::string text;
  for (const LinkFigures& link : link_figures(frame.paths, frame.frame, frame.world.links))
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{:d},{}\n", frame.world.time_s, tx_.at(link.tx),
                   rx_.at(link.rx), link.paths, link.path_gain_db, link.mean_delay_s, link.rms_delay_spread_s,
                   link.doppler_spread_hz, link.los, link.missed_power_share);
  file_.write(bytes(text));
}

PendingFile LinksCsv::finish() {
  file_.sync();
  return std::move(file_);
}

void join_links_csv(std::span<const std::filesystem::path> parts, PendingFile& file) {
  file.write(bytes(header));
  uint64_t end = header.size();
  Pieces pieces;
  for (const std::filesystem::path& part : parts) {
    const uint64_t rows = std::max<uint64_t>(std::filesystem::file_size(part), header.size()) - header.size();
    pieces.push_back({{header.size(), end, rows}});
    end += rows;
  }
  file.reserve(end);
  copy_pieces(parts, pieces, file);
}

}  // namespace wavetracer
