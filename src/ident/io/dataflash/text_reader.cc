// Reads DataFlash logs that were written as text.
#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <map>

#include "ident/io/dataflash/facts.h"
#include "ident/io/dataflash/layout.h"
#include "ident/io/dataflash/text_format.h"
#include "ident/io/packed/damage.h"

namespace ident {
namespace {

using dataflash::Layout;

constexpr std::string_view kFirst = "FMT, 128, 89, FMT";

struct Kind {
  Layout layout;
  std::vector<std::vector<double>> values;  ///< of each number
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

/// Cells behind a comma; the last of `most` keeps further commas.
std::vector<std::string_view> cells_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t comma =
        cells.size() + 1 == most ? line.size() : std::min(line.find(',', at), line.size());
    cells.push_back(trimmed(line.substr(at, comma - at)));
    at = comma + 1;
  }
  return cells;
}

std::optional<double> number(std::string_view cell) {
  double value = 0.0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || stop != cell.data() + cell.size()) return std::nullopt;
  return value;
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), damage_(out_.damage) {
    out_.file = file;
    out_.format = "dataflash_text";
  }

  LogStreams run() {
    for (std::size_t at = 0; at < bytes_.size();) {
      const std::size_t end = std::min(bytes_.find('\n', at), bytes_.size());
      const std::string_view line = trimmed(bytes_.substr(at, end - at));
      const bool is_whole = end < bytes_.size();
      if (!line.empty() && !take_line(line) && is_whole && !kinds_.empty())
        damage_.add(at, fmt::format("'{}' is no message", line.substr(0, 40)));
      at = end + 1;
    }
    for (const std::string& name : order_) make_stream(kinds_.at(name));
    damage_.close();
    return std::move(out_);
  }

 private:
  bool take_line(std::string_view line) {
    const std::string_view name = trimmed(line.substr(0, line.find(',')));
    if (name == "FMT") return take_format(cells_of(line, 6));
    const auto kind = kinds_.find(name);
    if (kind == kinds_.end()) return false;
    const Layout& layout = kind->second.layout;
    const std::vector<std::string_view> cells = cells_of(line, layout.columns + 1);
    if (cells.size() != layout.columns + 1) return false;
    if (!take_numbers(kind->second, cells)) return false;
    if (name == "PARM") take_parameter(layout, cells);
    if (name == "MSG") facts_.take_message(cells.back());
    return true;
  }

  /// `FMT, kind, length, name, letters, columns`.
  bool take_format(const std::vector<std::string_view>& cells) {
    if (cells.size() < 6) return false;
    std::optional<Layout> layout = dataflash::make_layout(cells[3], cells[4], cells[5], 0);
    if (!layout) return false;
    const std::string name(cells[3]);
    if (name == "FMT" || kinds_.contains(name)) return true;
    const std::size_t numbers = layout->fields.size();
    kinds_.emplace(name, Kind{std::move(*layout), std::vector<std::vector<double>>(numbers)});
    order_.push_back(name);
    return true;
  }

  /// Modes of flight are words in some logs: not a number.
  static bool take_numbers(Kind& kind, const std::vector<std::string_view>& cells) {
    std::vector<double> row;
    for (std::size_t i = 0; i < kind.layout.fields.size(); ++i) {
      const PackedField& field = kind.layout.fields[i];
      const std::optional<double> value = number(cells[1 + kind.layout.place[i]]);
      if (!value && field.name != "Mode") return false;
      row.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    for (std::size_t i = 0; i < row.size(); ++i) kind.values[i].push_back(row[i]);
    return true;
  }

  void take_parameter(const Layout& layout, const std::vector<std::string_view>& cells) {
    // Columns are TimeUS, Name, Value or, before 3.3, Name, Value; newer ones add a default.
    const std::size_t name = layout.field("TimeUS") ? 2 : 1;
    if (cells.size() < name + 2) return;
    const std::optional<double> value = number(cells[name + 1]), time = number(cells[1]);
    if (!value) return;
    facts_.take_parameter(cells[name], *value,
                          name == 2 && time ? std::optional(*time * 1e-6) : std::nullopt);
  }

  void make_stream(Kind& kind) {
    if (kind.values.empty() || kind.values.front().empty()) return;
    LogStream stream;
    stream.name = kind.layout.name;
    for (std::size_t i = 0; i < kind.values.size(); ++i)
      stream.fields.push_back({kind.layout.fields[i].name, "", 1.0, std::move(kind.values[i])});
    const dataflash::Clock clock = dataflash::clock_of(kind.layout);
    if (!clock.field.empty()) set_clock(stream, clock.field, 0, clock.unit);
    out_.streams.push_back(std::move(stream));
  }

  std::string_view bytes_;
  LogStreams out_;
  DamageNotes damage_;
  dataflash::Facts facts_{out_};
  std::map<std::string, Kind, std::less<>> kinds_;
  std::vector<std::string> order_;
};

}  // namespace

bool DataflashTextFormat::recognises(std::string_view first) {
  return first.find(kFirst) != std::string_view::npos && first.find('\0') == std::string_view::npos;
}

LogStreams DataflashTextFormat::read(std::string_view bytes, const std::string& file) {
  return Reader(bytes, file).run();
}

}  // namespace ident
