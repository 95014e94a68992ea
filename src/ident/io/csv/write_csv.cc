// CSV text by columns.
#include "ident/io/csv/write_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace ident {
namespace {

/// A column ready to print: digits after the point (plain), or 0 significant digits meaning all.
struct Printed {
  std::string name;
  const std::vector<double>* values = nullptr;
  int decimals = 6;
  bool significant = false;  ///< `decimals` counts significant digits
  double scale = 1.0, offset = 0.0;
};

void print_cell(std::string& out, const Printed& column, std::size_t row, CsvDigits digits) {
  const double value = (*column.values)[row];
  if (std::isnan(value)) return;
  const double shown = column.scale * value + column.offset;
  auto to = std::back_inserter(out);
  if (digits == CsvDigits::full)
    fmt::format_to(to, "{}", shown);
  else if (column.significant)
    fmt::format_to(to, "{:.{}g}", shown, column.decimals);
  else
    fmt::format_to(to, "{:.{}f}", shown, column.decimals);
}

std::string comment_lines(const std::vector<std::string>& comments) {
  std::string out;
  for (const std::string& comment : comments) out += "# " + comment + "\n";
  return out;
}

/// u = min + delta (max - min), in us.
void add_commands(std::vector<Printed>& columns, const FlightLog& log, const Vehicle& vehicle) {
  for (std::size_t n = 0; n < log.delta.size(); ++n) {
    if (vehicle.command) {
      const CommandRange& range = *vehicle.command;
      columns.push_back({.name = fmt::format("u{}", n + 1),
                         .values = &log.delta[n],
                         .decimals = 7,
                         .significant = true,
                         .scale = range.max_us - range.min_us,
                         .offset = range.min_us});
    } else {
      columns.push_back({.name = fmt::format("delta{}", n + 1), .values = &log.delta[n]});
    }
  }
}

}  // namespace

std::string flight_log_to_csv(const FlightLog& log, const Vehicle& vehicle, CsvDigits digits,
                              const std::vector<std::string>& comments) {
  std::vector<Printed> columns = {{.name = "t", .values = &log.t}};
  add_commands(columns, log, vehicle);
  const auto add = [&](const std::string& name, const std::vector<double>& values, int decimals) {
    if (!values.empty()) columns.push_back({.name = name, .values = &values, .decimals = decimals});
  };
  for (std::size_t n = 0; n < log.Omega.size(); ++n) add(fmt::format("omega{}", n + 1), log.Omega[n], 3);
  const char* const rates[] = {"p", "q", "r"};
  const char* const force[] = {"ax", "ay", "az"};
  const char* const quaternion[] = {"qw", "qx", "qy", "qz"};
  const char* const place[] = {"x", "y", "z"};
  const char* const velocity[] = {"vx", "vy", "vz"};
  for (std::size_t k = 0; k < 3; ++k) add(rates[k], log.w_B[k], 5);
  for (std::size_t k = 0; k < 3; ++k) add(force[k], log.f_B[k], 4);
  for (std::size_t k = 0; k < 4; ++k) add(quaternion[k], log.q_WB[k], 6);
  for (std::size_t k = 0; k < 3; ++k) add(place[k], log.x_W[k], 5);
  for (std::size_t k = 0; k < 3; ++k) add(velocity[k], log.v_W[k], 5);
  add("vbat", log.vbat, 3);
  add("current", log.current, 3);
  std::string out = comment_lines(comments);
  for (std::size_t c = 0; c < columns.size(); ++c) out += (c ? "," : "") + columns[c].name;
  out += "\n";
  for (std::size_t row = 0; row < log.rows(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c) out += ',';
      print_cell(out, columns[c], row, digits);
    }
    out += '\n';
  }
  return out;
}

std::string table_to_csv(const NumberTable& table, CsvDigits digits,
                         const std::vector<std::string>& comments) {
  std::string out = comment_lines(comments), separator;
  for (const TextColumn& column : table.text) out += std::exchange(separator, ",") + column.name;
  for (const Column& column : table.columns) out += std::exchange(separator, ",") + column.name;
  out += "\n";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    separator.clear();
    for (const TextColumn& column : table.text) out += std::exchange(separator, ",") + column.values[row];
    for (const Column& column : table.columns) {
      out += std::exchange(separator, ",");
      print_cell(out, {.name = "", .values = &column.values, .decimals = 8, .significant = true}, row,
                 digits);
    }
    out += "\n";
  }
  return out;
}

}  // namespace ident
