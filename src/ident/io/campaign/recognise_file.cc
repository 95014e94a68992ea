// Tries the readers of all formats, the surest signs first.
#include "ident/io/campaign/recognise_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "ident/core/error.h"
#include "ident/io/csv/match_header.h"
#include "ident/io/csv/propeller_data.h"
#include "ident/io/csv/table_checks.h"
#include "ident/io/csv/table_schemas.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/file/whole_file.h"
#include "ident/io/file/yaml_value.h"
#include "ident/io/log/log_columns.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/profiles.h"
#include "ident/io/log_formats/read_log_streams.h"
#include "ident/io/log_formats/refusals.h"
#include "ident/io/simulators/simulators.h"
#include "ident/io/vehicle/vehicle_read.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestText = 16u << 20;  // as vehicles are read
constexpr std::size_t kLargestYaml = 1u << 20;   // no vehicle, map or campaign is larger
constexpr const char* kNothing = "no log, bench file, map, vehicle or simulator's file";

struct BenchKind {
  FileKind kind;
  TableSchema (*schema)();
  const char* what;
};
// A stand's sweep holds time and commands as well: the thrust in it says what it is.
constexpr std::array kBenchKinds{
    BenchKind{FileKind::inertia, &pendulum_schema, "periods of a pendulum"},
    BenchKind{FileKind::thrust, &thrust_schema, "thrust sweep"},
    BenchKind{FileKind::motor, &motor_schema, "motor steps"},
};

/// Throws InputError where the header is not of that kind, or is with an unknown unit.
void expect_kind(const std::string& path, const CsvReader& csv, const TableSchema& schema) {
  const HeaderMatch match = match_header(path, csv, schema);
  std::vector<std::string> names;
  for (const ChosenColumn& column : match.columns) names.push_back(column.name);
  for (const ChosenText& column : match.text) names.push_back(column.name);
  expect_columns(path, csv.header_line(), csv.header(), names, schema);
}

bool is_kind(const std::string& path, const CsvReader& csv, const TableSchema& schema) {
  try {
    expect_kind(path, csv, schema);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// JSON and XML have commas and numbers as well.
bool is_markup(const std::string& path) {
  const std::string first = first_bytes(path, 64);
  const std::size_t at = first.find_first_not_of(" \t\r\n");
  return at != std::string::npos && (first[at] == '{' || first[at] == '<');
}

/// Whether below a header of several names stands a row of as many cells, half of them numbers.
bool has_numbers(CsvReader& csv) {
  std::vector<std::string_view> cells;
  if (csv.header().size() < 2 || !csv.next_row(cells) || csv.is_short_row()) return false;
  return 2 * std::ranges::count_if(cells, looks_like_number) >= std::ssize(cells);
}

FoundFile flight_or_table(const std::string& path, const CsvReader& csv) {
  Vehicle any;
  any.command = CommandRange{1000, 2000};  // us: whatever it is
  try {
    choose_log_columns(path, csv, any, map_for_header(csv.header()));
    return {path, FileKind::flight_log, "flight log"};
  } catch (const InputError& error) {
    return {path, FileKind::table,
            "a table, but of no bench, and no flight log without a map: " + without_name(error.what(), path)};
  }
}

/// Nothing where the file is no table at all.
std::optional<FoundFile> recognised_table(const std::string& path) {
  try {
    CsvReader csv(path);
    for (const BenchKind& one : kBenchKinds)
      if (is_kind(path, csv, one.schema())) return FoundFile{path, one.kind, one.what};
    CsvReader again(path);
    if (read_propeller_data(path, again))
      return FoundFile{path, FileKind::thrust, "thrust sweep (coefficients of a propeller)"};
    if (is_markup(path) || !has_numbers(csv)) return std::nullopt;
    return flight_or_table(path, csv);
  } catch (const Error&) {
    return std::nullopt;  // the reader of texts tells what it is
  }
}

bool has_any(const YamlValue& file, std::initializer_list<const char*> keys) {
  return std::ranges::any_of(keys, [&](const char* key) { return file.has(key); });
}

std::optional<FoundFile> recognised_yaml(const std::string& path, const std::string& text) {
  const YamlValue file = parse_yaml(text, path);
  if (!file.is_map()) return std::nullopt;
  if (file.has("vehicle") && has_any(file, {"logs", "thrust", "motor", "inertia", "parameters"}))
    return FoundFile{path, FileKind::other, "a campaign file: rename it to ident.yaml to work with it"};
  if (has_any(file, {"columns", "windows"})) {
    parse_log_map(text, path);
    return FoundFile{path, FileKind::map, "map of columns"};
  }
  if (!has_any(file, {"rotors", "layout", "mass", "parameters"})) return std::nullopt;
  if (vehicle_from(file).rotors.empty()) return FoundFile{path, FileKind::parameters, "parameter file"};
  return FoundFile{path, FileKind::vehicle, "vehicle file"};
}

/// Whether a text that cannot be read was meant as a vehicle file.
bool looks_like_vehicle(const std::string& text) {
  return std::ranges::any_of(std::array{"rotors:", "layout:", "mass:"}, [&](const char* key) {
    return text.starts_with(key) || text.find(std::string("\n") + key) != std::string::npos;
  });
}

FoundFile recognised_text(const std::string& path) {
  const std::string text = read_bytes(path, kLargestText);
  if (const SimulatorFormat* format = recognised_simulator(text))
    return {path, FileKind::simulator, fmt::format("vehicle of a simulator ({})", format->meaning)};
  if (text.size() > kLargestYaml) return {path, FileKind::other, kNothing};
  try {
    if (std::optional<FoundFile> found = recognised_yaml(path, text)) return *std::move(found);
  } catch (const Error&) {
    if (looks_like_vehicle(text)) throw;
  }
  return {path, FileKind::other, kNothing};
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

}  // namespace

FoundFile recognise_file(const std::string& path) {
  try {
    if (const std::string_view format = log_format_of_file(path); !format.empty())
      return {path, FileKind::autopilot_log, fmt::format("log of an autopilot ({})", format)};
    refuse_no_log(first_bytes(path, kRecognisedFrom), path);
    const std::optional<FoundFile> table = recognised_table(path);
    const bool only_table = table && fs::file_size(path) > kLargestYaml;
    if (table && (only_table || table->kind != FileKind::table)) return *table;
    FoundFile text = recognised_text(path);
    return table && text.what == kNothing ? *table : text;
  } catch (const Error& error) {
    return {path, FileKind::other, without_name(error.what(), path)};
  }
}

std::vector<std::string> files_of_folder(const std::string& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder, 0, "", "there is no such folder");
  std::vector<std::string> files;
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator at(folder, skip), end; at != end; ++at) {
    const bool is_campaign = at->is_directory() && fs::exists(at->path() / "ident.yaml");
    if (is_hidden(at->path()) || is_campaign) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file()) {
      files.push_back(at->path().lexically_normal().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

std::string without_name(const std::string& message, const std::string& path) {
  const std::string start = path + ':';
  if (!message.starts_with(start)) return message;
  const std::size_t blank = message.find_first_not_of(' ', start.size());
  return blank == std::string::npos ? message : message.substr(blank);
}

}  // namespace ident
