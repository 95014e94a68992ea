// Collects the frames of one blackbox log as streams: `1:main`, `1:slow`, `1:gps`, `1:events`.
#include "ident/io/blackbox/log_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ident/io/blackbox/field_units.h"

namespace ident::blackbox {

namespace {

/// Columns of the CSV that blackbox_decode writes of main frames.
std::vector<ColumnKind> columns_of_main_stream(const Header& header) {
  std::vector<ColumnKind> columns = main_columns(header);
  if (header.I.find("amperageLatest") >= 0)
    columns.push_back({"energyCumulative (mAh)", "mAh", 1.0, Stored::int32});
  for (ColumnKind& kind : slow_columns(header)) columns.push_back(std::move(kind));
  return columns;
}

}  // namespace

LogRecorder::LogRecorder(const Header& header, ChargeCounter& charge)
    : header_(header),
      charge_(charge),
      amperage_(header.I.find("amperageLatest")),
      gps_time_(header.G.find("time")),
      main_(columns_of_main_stream(header)),
      slow_(slow_columns(header)),
      gps_(gps_columns(header)) {
  charge_.begin_log();
}

void LogRecorder::main_frame(const Row& row) {
  const std::int64_t time_us = row[1];
  if (main_.rows() == 0) first_time_us_ = time_us;
  if (gap_open_ && main_.rows() > 0) gaps_.push_back({seconds(last_time_us_), seconds(time_us)});
  gap_open_ = false;
  const auto out = main_.next_row();
  auto at = std::copy_n(row.begin(), header_.I.size(), out.begin());
  if (amperage_ >= 0) *at++ = charge_.charge_mAh(row[static_cast<std::size_t>(amperage_)], time_us);
  std::copy_n(last_slow_.begin(), header_.S.size(), at);
  main_t_.push_back(seconds(time_us));
  last_time_us_ = time_us;
}

void LogRecorder::slow_frame(const Row& row) {
  last_slow_ = row;
  if (header_.S.size() == 0) return;
  std::copy_n(row.begin(), header_.S.size(), slow_.next_row().begin());
  slow_t_.push_back(seconds(main_.rows() == 0 ? first_time_us_ : last_time_us_));
}

void LogRecorder::gps_frame(const Row& row) {
  if (header_.G.size() == 0) return;
  std::copy_n(row.begin(), header_.G.size(), gps_.next_row().begin());
  gps_t_.push_back(seconds(gps_time_ >= 0 ? row[static_cast<std::size_t>(gps_time_)] : last_time_us_));
}

void LogRecorder::event(const Event& event) {
  if (event.kind == EventKind::resume) gap_open_ = true;
  event_kinds_.push_back(static_cast<std::uint8_t>(event.kind));
  event_a_.push_back(event.a);
  event_b_.push_back(event.b);
  event_t_.push_back(seconds(last_time_us_));
}

void LogRecorder::synchronisation_lost(std::size_t byte, LossCause cause) {
  gap_open_ = true;
  if (cause == LossCause::damage && losses_++ == 0) first_loss_ = byte;
}

void LogRecorder::ends_early(std::size_t byte, std::string_view reason) {
  early_end_ = fmt::format("it ends at its byte {}: {}", byte, reason);
}

void LogRecorder::add_stream(LogStreams& streams, std::string name, std::string clock,
                             std::vector<double>& times, std::vector<StreamField> fields,
                             double begin) const {
  if (times.empty()) return;
  double last = begin;
  for (double& t : times)
    last = t = std::max(last, t + begin);  // before the first main frame there is no time
  streams.streams.push_back({std::move(name), std::move(clock), std::move(times), std::move(fields)});
}

double LogRecorder::add_to(LogStreams& streams, int number, double begin) {
  const double end = begin + seconds(last_time_us_);
  const std::string gps_clock = gps_time_ >= 0 ? "time (us)" : "";
  add_stream(streams, fmt::format("{}:main", number), header_.I.names[1] + " (us)", main_t_, main_.take(),
             begin);
  add_stream(streams, fmt::format("{}:slow", number), "", slow_t_, slow_.take(), begin);
  add_stream(streams, fmt::format("{}:gps", number), gps_clock, gps_t_, gps_.take(), begin);
  std::vector<StreamField> events;
  events.push_back({.name = "event", .unit = {}, .values = std::move(event_kinds_)});
  events.push_back({.name = "a", .unit = {}, .values = std::move(event_a_)});
  events.push_back({.name = "b", .unit = {}, .values = std::move(event_b_)});
  add_stream(streams, fmt::format("{}:events", number), "", event_t_, std::move(events), begin);
  for (const auto& [from, until] : gaps_) streams.dropouts.push_back({begin + from, begin + until});
  if (losses_ > 0)
    streams.damage.push_back(
        fmt::format("log {}: {} bytes or frames could not be read, the first at its byte {}; "
                    "main frames go on at the next intra frame",
                    number, losses_, first_loss_));
  if (!early_end_.empty()) streams.damage.push_back(fmt::format("log {}: {}", number, early_end_));
  return end;
}

}  // namespace ident::blackbox
