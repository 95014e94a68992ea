// Compares headers with the spellings that a schema knows.
#include "ident/io/csv/match_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/io/csv/table_map.h"

namespace ident {
namespace {

constexpr std::size_t kListedColumns = 40;

/// Spellings of a signal in order of preference: its name, then the aliases.
std::vector<Alias> spellings(const Signal& signal) {
  std::vector<Alias> list = {{signal.name, ""}};
  list.insert(list.end(), signal.aliases.begin(), signal.aliases.end());
  return list;
}

class Matcher {
 public:
  Matcher(const std::string& path, const CsvReader& csv, const TableMap* map)
      : path_(path), csv_(csv), map_(map) {
    for (const std::string& header : csv.header()) keys_.push_back(header_key(header));
  }

  /// Column of a header; throws when it stands there twice.
  std::optional<std::size_t> find(const std::string& spelling) const {
    const std::string key = header_key(spelling);
    const auto at = std::ranges::find(keys_, key);
    if (at == keys_.end()) return std::nullopt;
    if (std::find(at + 1, keys_.end(), key) != keys_.end())
      throw InputError(path_, csv_.header_line(), csv_.header()[index(at)], "the column stands there twice");
    return index(at);
  }

  std::optional<ChosenColumn> choose(const Signal& signal) {
    if (map_ && map_->columns.contains(signal.name)) return mapped(signal, map_->columns.at(signal.name));
    for (const Alias& spelling : spellings(signal)) {
      auto at = find(spelling.header);
      if (!at && unit_factor("1", signal.dimension))
        at = find(spelling.header + "[1]");  // that unit, no index
      if (!at) continue;
      if (map_ && used_.contains(*at)) continue;  // the map says what that is
      used_.insert(*at);
      const double unit =
          column_factor(path_, csv_.header_line(), csv_.header()[*at], signal.dimension, spelling.unit);
      return ChosenColumn{.name = signal.name,
                          .index = *at,
                          .unit = unit,
                          .is_time = signal.name == "t",
                          .is_fraction = signal.dimension == Dimension::fraction};
    }
    return with_unit_in_name(signal);
  }

  std::optional<ChosenText> choose(const TextSignal& signal) {
    const bool is_mapped = map_ && map_->columns.contains(signal.name);
    const auto at = is_mapped ? named(map_->columns.at(signal.name)) : find(signal.name);
    if (!at) return std::nullopt;
    used_.insert(*at);
    return ChosenText{signal.name, *at, signal.words};
  }

  std::vector<std::string> notices() const {
    std::vector<std::string> ignored;
    for (std::size_t i = 0; i < keys_.size(); ++i)
      if (!used_.contains(i) && !keys_[i].empty()) ignored.push_back(csv_.header()[i]);
    if (ignored.empty()) return {};
    return {fmt::format("{}: ignored columns: {}", path_, column_list(ignored))};
  }

  /// Columns of the map first, so that nothing else takes them.
  void reserve(const TableSchema& schema) {
    if (!map_) return;
    for (const Signal& signal : schema.signals)
      if (const auto at = map_->columns.find(signal.name); at != map_->columns.end())
        used_.insert(*named(at->second));
  }

 private:
  /// A column that the map names, by its whole header or by its header without unit.
  std::optional<std::size_t> named(const TableColumn& column) const {
    const auto whole = std::ranges::find(csv_.header(), column.column);
    if (whole != csv_.header().end()) return static_cast<std::size_t>(whole - csv_.header().begin());
    if (const auto at = find(column.column)) return at;
    throw InputError(
        path_, csv_.header_line(), column.column,
        fmt::format("the column is missing, which {}:{} names{}; the file has: {}", map_->file, column.line,
                    did_you_mean(column.column, csv_.header()), column_list(csv_.header())));
  }

  ChosenColumn mapped(const Signal& signal, const TableColumn& column) {
    const std::size_t at = *named(column);
    used_.insert(at);
    double unit = 1.0;
    if (column.unit.empty()) {
      unit = column_factor(path_, csv_.header_line(), csv_.header()[at], signal.dimension, "");
    } else if (const auto factor = unit_factor(column.unit, signal.dimension)) {
      unit = *factor;
    } else {
      throw InputError(map_->file, column.line, signal.name,
                       fmt::format("unit '{}' is not known for this signal; known: {}", column.unit,
                                   known_units(signal.dimension)));
    }
    return {.name = signal.name,
            .index = at,
            .unit = unit,
            .scale = column.scale,
            .offset = column.offset,
            .is_time = signal.name == "t",
            .is_fraction = signal.dimension == Dimension::fraction};
  }

  /// `thrust_gf`: a spelling and a unit of the dimension.
  std::optional<ChosenColumn> with_unit_in_name(const Signal& signal) {
    for (const Alias& spelling : spellings(signal))
      for (std::size_t i = 0; i < keys_.size(); ++i) {
        const std::string start = header_key(spelling.header) + ' ';
        if (used_.contains(i) || !keys_[i].starts_with(start) || split_header(csv_.header()[i]).unit)
          continue;
        const std::string& header = csv_.header()[i];  // with capitals, which units may have
        const std::string unit = header.substr(header.find_last_of(" _") + 1);
        if (header_key(unit) != keys_[i].substr(start.size())) continue;
        const std::optional<double> factor = unit_factor(unit, signal.dimension);
        if (!factor) continue;
        used_.insert(i);
        return ChosenColumn{.name = signal.name,
                            .index = i,
                            .unit = *factor,
                            .is_time = signal.name == "t",
                            .is_fraction = signal.dimension == Dimension::fraction};
      }
    return std::nullopt;
  }

  std::size_t index(std::vector<std::string>::const_iterator at) const {
    return static_cast<std::size_t>(at - keys_.begin());
  }

  const std::string& path_;
  const CsvReader& csv_;
  const TableMap* map_;
  std::vector<std::string> keys_;
  std::set<std::size_t> used_;
};

}  // namespace

std::string header_key(std::string_view header) {
  std::string key;
  for (const char c : split_header(header).name) {
    const char plain = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (plain != ' ' || (!key.empty() && key.back() != ' ')) key += plain;
  }
  return key;
}

double column_factor(const std::string& path, long line, const std::string& header, Dimension dimension,
                     const std::string& default_unit) {
  const std::string unit = split_header(header).unit.value_or(default_unit);
  if (unit.empty()) return 1.0;
  const std::optional<double> factor = unit_factor(unit, dimension);
  if (!factor)
    throw InputError(
        path, line, header,
        fmt::format("unit '{}' is not known for this column; known: {}", unit, known_units(dimension)));
  return *factor;
}

std::string column_list(const std::vector<std::string>& header) {
  std::vector<std::string> names;
  std::ranges::copy_if(header, std::back_inserter(names),
                       [](const std::string& name) { return !name.empty(); });
  const std::size_t more = names.size() > kListedColumns ? names.size() - kListedColumns : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

HeaderMatch match_header(const std::string& path, const CsvReader& csv, const TableSchema& schema,
                         const TableMap* map) {
  Matcher matcher(path, csv, map);
  matcher.reserve(schema);
  HeaderMatch match;
  for (const Signal& signal : schema.signals)
    if (auto column = matcher.choose(signal)) match.columns.push_back(*column);
  for (const TextSignal& signal : schema.text)
    if (auto column = matcher.choose(signal)) match.text.push_back(*column);
  match.notices = matcher.notices();
  return match;
}

}  // namespace ident
