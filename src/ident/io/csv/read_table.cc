// Reads the table of a bench file: dialect, header, numbers, checks.
#include "ident/io/csv/read_table.h"

#include "ident/io/csv/command_scale.h"
#include "ident/io/csv/csv_reader.h"
#include "ident/io/csv/match_header.h"
#include "ident/io/csv/propeller_data.h"
#include "ident/io/csv/read_columns.h"
#include "ident/io/csv/table_checks.h"

namespace ident {
namespace {

std::vector<std::string> names(const HeaderMatch& match) {
  std::vector<std::string> list;
  for (const ChosenColumn& column : match.columns) list.push_back(column.name);
  for (const ChosenText& column : match.text) list.push_back(column.name);
  return list;
}

void put_in_time_order(NumberTable& table) {
  const std::vector<double>* t = table.find("t");
  const TimeOrder order = time_order(table.file, *t, table.line);
  for (const Warning& warning : time_warnings(table.file, order)) table.warnings.push_back(warning);
  if (order.keep.size() < table.rows()) keep_rows(table, order.keep);
}

}  // namespace

NumberTable read_table(const std::string& path, const TableSchema& schema, const TableOptions& options) {
  CsvReader csv(path, options.names);
  if (schema.propeller_coefficients)
    if (auto table = read_propeller_data(path, csv)) return std::move(*table);
  const HeaderMatch match = match_header(path, csv, schema, options.map);
  expect_columns(path, csv.header_line(), csv.header(), names(match), schema);
  NumberTable table = read_columns(path, csv, match.columns, match.text);
  table.notices.insert(table.notices.end(), match.notices.begin(), match.notices.end());
  drop_empty_columns(table, schema);
  recognise_commands(table);
  expect_plausible(table, schema, csv.header_line());
  if (schema.time_ordered) put_in_time_order(table);
  return table;
}

}  // namespace ident
