// What the bench commands share: files named or from the campaign, tables read, estimates stored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/csv/read_table.h"

namespace ident::app {

/// Options `FILE...` and `--vehicle FILE` of a bench command.
struct BenchOptions {
  std::vector<std::string> files;
  std::string vehicle;
  std::string map;    ///< file
  std::string names;  ///< header of files that have none
};

/// Adds them; without a file the campaign's are taken.
void add_bench_options(CLI::App& cli, BenchOptions& options, const std::string& what_the_files_are);

/// What a bench command works on.
struct BenchInput {
  std::vector<NumberTable> tables;
  std::optional<Vehicle> vehicle;    ///< from --vehicle, else the campaign's where the folder has one
  std::optional<Campaign> campaign;  ///< set when the files came from it: results are stored there
};

/// Reads the files that were named, or those of the campaign (`listed` picks its list; `key` is its name in
/// ident.yaml). Throws UsageError when there are none. Files other than the tables go to context.used.
BenchInput bench_input(const BenchOptions& options, const TableSchema& schema, const std::string& key,
                       std::vector<std::string> Campaign::*listed, Context& context);

/// Stores the estimates in the campaign's parameter file when the files came from the campaign.
void store_in_campaign(const BenchInput& input, Result& result, Context& context);

}  // namespace ident::app
