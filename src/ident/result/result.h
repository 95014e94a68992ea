// What a command found: parameters with intervals, findings, and the sections that show them; data only.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ident/result/correlation.h"
#include "ident/result/finding.h"
#include "ident/result/parameter.h"
#include "ident/result/section.h"

namespace ident {

/// A file that was read, so that a stranger can tell whether he has the same one.
struct InputFile {
  std::string path;
  std::string sha256;
};

/// Everything a command has to say. `to_json` is what `--json` prints; the report shows all of it.
struct Result {
  std::string schema = "ident.result/1";
  std::string command;
  std::vector<std::string> inputs;
  std::vector<Parameter> parameters;
  nlohmann::ordered_json fit = nlohmann::ordered_json::object();
  std::vector<Warning> warnings;
  nlohmann::ordered_json extra = nlohmann::ordered_json::object();  ///< merged into the top level
  std::string verdict;                                              ///< plain words, one paragraph
  std::vector<Section> sections;
  Correlation correlation;        ///< of the estimates
  Correlation prior_correlation;  ///< of what was known of them before
  std::vector<InputFile> files;
  std::vector<std::string> command_line;
  std::optional<std::uint64_t> seed;
  std::string version;  ///< of the ident that found it; empty for this one

  void warn(std::string code, std::string message) {
    warnings.push_back({std::move(code), std::move(message)});
  }
  const Parameter* find(const std::string& name) const;
  bool has_warning(const std::string& code) const;
};

/// The contract's JSON. Non-finite numbers become null on purpose ("not identified").
nlohmann::ordered_json to_json(const Result& result);

}  // namespace ident
