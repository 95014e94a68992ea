// Chooses the columns of a flight log and counts its rotors.
#include "ident/io/log/log_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/io/csv/match_header.h"
#include "ident/io/log/log_signals.h"

namespace ident {
namespace {

class Chooser {
 public:
  Chooser(const std::string& path, const CsvReader& csv, const Vehicle& vehicle,
          const std::optional<LogMap>& map, LogContent content)
      : path_(path), csv_(csv), vehicle_(vehicle), map_(map), content_(content) {}

  LogColumns run() {
    out_.header_line = csv_.header_line();
    choose_mapped();
    choose_by_name();
    if (content_ == LogContent::motion) {
      expect_attitude();
      return std::move(out_);
    }
    count_rotors();
    expect_something_to_work_on();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& column, const std::string& what) const {
    throw InputError(path_, csv_.header_line(), column, what);
  }

  /// A column by its whole header, else by its header without unit.
  std::size_t mapped_index(const MappedColumn& mapped) const {
    const std::vector<std::string>& header = csv_.header();
    auto at = std::ranges::find(header, mapped.column);
    if (at == header.end())
      at = std::ranges::find_if(
          header, [&](const std::string& h) { return header_key(h) == header_key(mapped.column); });
    if (at == header.end())
      fail(mapped.column,
           fmt::format("the column is missing, which {}:{} names{}; the file has: {}", map_->file,
                       mapped.line, did_you_mean(mapped.column, header), column_list(header)));
    return static_cast<std::size_t>(at - header.begin());
  }

  /// Factor to SI of the map's unit, or of the header's where the map names none.
  double mapped_factor(const MappedColumn& mapped, std::size_t index, const Signal& signal) const {
    if (mapped.unit.empty())
      return column_factor(path_, csv_.header_line(), csv_.header()[index], signal.dimension, "");
    const std::optional<double> factor = unit_factor(mapped.unit, signal.dimension);
    if (!factor)
      throw InputError(map_->file, mapped.line, signal.name,
                       fmt::format("unit '{}' is not known for this signal; known: {}", mapped.unit,
                                   known_units(signal.dimension)));
    return *factor;
  }

  void choose_mapped() {
    if (!map_) return;
    for (const LogSignal& s : log_signals(kMostRotors)) {
      const auto at = map_->columns.find(s.signal.name);
      if (at == map_->columns.end() || !is_read(s.group, content_)) continue;
      spoken_for_.insert(s.group);
      const MappedColumn& mapped = at->second;
      if (mapped.column.empty()) continue;
      const std::size_t index = mapped_index(mapped);
      const bool is_time = s.group == LogGroup::time;
      out_.columns.push_back({.name = s.signal.name,
                              .index = index,
                              .unit = mapped_factor(mapped, index, s.signal),
                              .scale = mapped.scale,
                              .offset = mapped.offset,
                              .is_time = is_time});
      if (is_time) out_.time_unit_stated = !mapped.unit.empty() || mapped.scale != 1.0 || states_unit(index);
    }
  }

  bool states_unit(std::size_t index) const { return split_header(csv_.header()[index]).unit.has_value(); }

  void choose_by_name() {
    TableSchema schema;
    for (const LogSignal& s : log_signals(kMostRotors))
      if (!spoken_for_.contains(s.group) && is_read(s.group, content_)) schema.signals.push_back(s.signal);
    const HeaderMatch match = match_header(path_, csv_, schema);
    for (const ChosenColumn& column : match.columns) {
      if (column.is_time) out_.time_unit_stated = states_unit(column.index);
      out_.columns.push_back(column);
    }
    if (map_ && !match.columns.empty() && !map_->columns.empty()) {
      std::vector<std::string> names;
      for (const ChosenColumn& column : match.columns) names.push_back(column.name);
      out_.notices.push_back(
          fmt::format("{}: found under their own names, not in the map: {}", path_, fmt::join(names, ", ")));
    }
    if (!map_) out_.notices.insert(out_.notices.end(), match.notices.begin(), match.notices.end());
  }

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const ChosenColumn& column : out_.columns) list.push_back(column.name);
    return list;
  }

  /// Number of columns of a kind, all of 1..N; N has to be the vehicle's.
  int count(const std::string& prefix) const {
    const int n = highest_number(names(), prefix);
    const int rotors = static_cast<int>(vehicle_.rotors.size());
    if (n == 0) return 0;
    if (rotors > 0 && n != rotors)
      fail(fmt::format("{}1..{}{}", prefix, prefix, n),
           fmt::format("the log has {} of these columns, but {} has {} rotors", n, vehicle_title(), rotors));
    for (int i = 1; i <= n; ++i)
      if (!out_.has(fmt::format("{}{}", prefix, i)))
        fail(fmt::format("{}{}", prefix, i),
             fmt::format("the column is missing; the file has: {}", column_list(csv_.header())));
    return n;
  }

  std::string vehicle_title() const {
    return "the vehicle file " + (vehicle_.file.empty() ? "of " + vehicle_.name : vehicle_.file);
  }

  void count_rotors() {
    out_.commands = count("delta");
    out_.pulses = count("u");
    out_.speeds = count("omega");
    if (out_.pulses == 0 || out_.commands > 0) return;
    if (!vehicle_.command)
      fail("u1", fmt::format("pulse widths need 'command: {{min: .., max: ..}}' in {}", vehicle_title()));
  }

  void expect_attitude() const {
    const auto expect = [&](bool there, const char* columns) {
      if (!there)
        fail(columns,
             "missing: a recording of a motion needs it, and the file has: " + column_list(csv_.header()));
    };
    expect(out_.has("t"), "t");
    expect(out_.has("qw") || out_.has("phi"), "qw..qz or phi,theta,psi");
  }

  void expect_something_to_work_on() const {
    const std::string list = column_list(csv_.header());
    if (!out_.has("t")) fail("t", "the column is missing; a flight log needs it, and the file has: " + list);
    if (out_.commands + out_.pulses + out_.speeds == 0)
      fail("u1..uN or delta1..deltaN or omega1..omegaN",
           "the columns are missing: a flight log needs commands or rotor speeds, and the file has: " + list);
    for (const char* moving :
         {"p", "q", "r", "ax", "ay", "az", "qw", "phi", "theta", "psi", "vx", "vy", "vz"})
      if (out_.has(moving)) return;
    fail("p,q,r or ax,ay,az or qw..qz or phi,theta,psi or vx,vy,vz",
         "the columns are missing: a flight log needs something that moves, and the file has: " + list);
  }

  const std::string& path_;
  const CsvReader& csv_;
  const Vehicle& vehicle_;
  const std::optional<LogMap>& map_;
  LogContent content_;
  std::set<LogGroup> spoken_for_;
  LogColumns out_;
};

}  // namespace

bool LogColumns::has(const std::string& name) const {
  return std::ranges::find(columns, name, &ChosenColumn::name) != columns.end();
}

LogColumns choose_log_columns(const std::string& path, const CsvReader& csv, const Vehicle& vehicle,
                              const std::optional<LogMap>& map, LogContent content) {
  return Chooser(path, csv, vehicle, map, content).run();
}

}  // namespace ident
