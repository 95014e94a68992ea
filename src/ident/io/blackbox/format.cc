// Reads blackbox files of Betaflight, INAV and Cleanflight (.bbl, .bfl, .txt): every log that a file holds.
#include "ident/io/blackbox/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "ident/core/error.h"
#include "ident/io/blackbox/derived_settings.h"
#include "ident/io/blackbox/header.h"
#include "ident/io/blackbox/header_checks.h"
#include "ident/io/blackbox/log_decoder.h"
#include "ident/io/blackbox/log_recorder.h"
#include "ident/io/blackbox/settings.h"

namespace ident {

namespace {

using namespace blackbox;

constexpr std::string_view start_line = "H Product:Blackbox flight data recorder by Nicholas Sherlock\n";

/// The bytes of each log: from its first header line to that of the next.
std::vector<std::span<const std::uint8_t>> split_logs(std::span<const std::uint8_t> bytes) {
  const std::boyer_moore_horspool_searcher search(start_line.begin(), start_line.end());
  std::vector<std::span<const std::uint8_t>> logs;
  auto begin = std::search(bytes.begin(), bytes.end(), search);
  while (begin != bytes.end()) {
    const auto next = std::search(begin + 1, bytes.end(), search);
    logs.emplace_back(begin, next);
    begin = next;
  }
  return logs;
}

void set_current_meter(const Header& header, ChargeCounter& charge) {
  int offset_mV = 0;
  int scale = 400;
  const std::string text(header.value("currentMeter"));
  if (std::sscanf(text.c_str(), "%d,%d", &offset_mV, &scale) < 2) offset_mV = 0, scale = 400;
  charge.set_meter(offset_mV, scale);
}

/// Reads the logs of a file one after the other.
class FileReader {
 public:
  explicit FileReader(LogStreams& streams) : streams_(streams) {}

  void read(std::span<const std::uint8_t> log, int number) {
    const Header header = read_header(log);
    if (const std::string reason = reason_against(header); !reason.empty()) {
      streams_.damage.push_back(fmt::format("log {}: {}", number, reason));
      return;
    }
    set_current_meter(header, charge_);
    LogRecorder recorder(header, charge_);
    LogDecoder(log, header).run(recorder);
    if (recorder.main_frames() == 0) {
      streams_.damage.push_back(fmt::format("log {}: no main frame could be read", number));
      return;
    }
    add_settings(header, ++logs_read_ == 1 ? 1 : number, streams_);
    if (logs_read_ == 1) add_derived_settings(header, streams_);
    const double begin = beginning_of(recorder.first_time_us());
    end_ = recorder.add_to(streams_, number, begin);
    clock_zero_us_ = recorder.first_time_us() - static_cast<std::int64_t>(1e6 * begin);
  }

 private:
  /// On the clock of the logs before it; behind their end where the clock started again.
  double beginning_of(std::int64_t first_time_us) const {
    if (logs_read_ == 1) return 0.0;
    return std::max(end_, 1e-6 * static_cast<double>(first_time_us - clock_zero_us_));
  }

  LogStreams& streams_;
  ChargeCounter charge_;
  int logs_read_ = 0;
  double end_ = 0.0;
  std::int64_t clock_zero_us_ = 0;
};

}  // namespace

bool BlackboxFormat::recognises(std::string_view first) { return first.starts_with("H Product:Blackbox"); }

LogStreams BlackboxFormat::read(std::string_view text, const std::string& file) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  LogStreams streams{.file = file, .format = "blackbox"};
  FileReader reader(streams);
  int number = 0;
  for (const auto& log : split_logs(bytes)) reader.read(log, ++number);
  if (number == 0) throw InputError(file, 0, "", "no blackbox log begins in it: its first line is damaged");
  if (streams.streams.empty())
    throw InputError(file, 0, "", "no blackbox log can be read: " + streams.damage.front());
  return streams;
}

}  // namespace ident
