// Compares headers with the spellings that a schema knows.
#include "ident/io/csv/match_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "ident/core/error.h"

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
  Matcher(const std::string& path, const CsvReader& csv) : path_(path), csv_(csv) {
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
    for (const Alias& spelling : spellings(signal)) {
      auto at = find(spelling.header);
      if (!at && unit_factor("1", signal.dimension))
        at = find(spelling.header + "[1]");  // that unit, no index
      if (!at) continue;
      used_.insert(*at);
      const double unit =
          column_factor(path_, csv_.header_line(), csv_.header()[*at], signal.dimension, spelling.unit);
      return ChosenColumn{.name = signal.name,
                          .index = *at,
                          .unit = unit,
                          .is_time = signal.name == "t",
                          .is_fraction = signal.dimension == Dimension::fraction};
    }
    return std::nullopt;
  }

  std::optional<ChosenText> choose(const TextSignal& signal) {
    const auto at = find(signal.name);
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

 private:
  std::size_t index(std::vector<std::string>::const_iterator at) const {
    return static_cast<std::size_t>(at - keys_.begin());
  }

  const std::string& path_;
  const CsvReader& csv_;
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

HeaderMatch match_header(const std::string& path, const CsvReader& csv, const TableSchema& schema) {
  Matcher matcher(path, csv);
  HeaderMatch match;
  for (const Signal& signal : schema.signals)
    if (auto column = matcher.choose(signal)) match.columns.push_back(*column);
  for (const TextSignal& signal : schema.text)
    if (auto column = matcher.choose(signal)) match.text.push_back(*column);
  match.notices = matcher.notices();
  return match;
}

}  // namespace ident
