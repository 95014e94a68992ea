// Every file in tests/io/malformed against what lies beside it in NAME.expect:
//
//   kind: thrust | motor | pendulum | flight | vehicle | map | map_on_flight | campaign
//   error: the whole message, {file} for the file's path       exit: its exit status, 2 where none is named
//   warning: a code    notice: a part of a notice    rows: their number    value: signal row number (or nan)
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "ident/core/error.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/csv/read_table.h"
#include "ident/io/csv/table_schemas.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(IDENT_SOURCE_DIR) / "tests/io/malformed";

/// What reading a file gave, whatever its kind.
struct Seen {
  std::optional<std::string> error;
  int exit = 0;
  std::size_t rows = 0;
  std::vector<Warning> warnings;
  std::vector<std::string> notices;
  std::map<std::string, std::vector<double>> signals;
};

Seen from_table(const NumberTable& table) {
  Seen seen{.rows = table.rows(), .warnings = table.warnings, .notices = table.notices};
  for (const Column& column : table.columns) seen.signals[column.name] = column.values;
  return seen;
}

Seen from_log(const FlightLog& log) {
  Seen seen{.rows = log.rows(), .warnings = log.warnings, .notices = log.notices};
  const auto take = [&](const auto& group, std::initializer_list<const char*> names) {
    std::size_t i = 0;
    for (const char* name : names) seen.signals[name] = group[i++];
  };
  seen.signals["t"] = log.t;
  take(log.w_B, {"p", "q", "r"});
  take(log.f_B, {"ax", "ay", "az"});
  take(log.q_WB, {"qw", "qx", "qy", "qz"});
  take(log.v_W, {"vx", "vy", "vz"});
  if (log.Omega.size() == 4) take(log.Omega, {"omega1", "omega2", "omega3", "omega4"});
  if (log.delta.size() == 4) take(log.delta, {"delta1", "delta2", "delta3", "delta4"});
  return seen;
}

Vehicle four_rotors() {
  Vehicle vehicle;
  vehicle.name = "quad";
  vehicle.rotors = layout_rotors("x", 0.1, 0.0);
  return vehicle;
}

/// A campaign is found in a folder under its own name.
Seen read_as_campaign(const fs::path& path) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("ident-campaign-{}", ::getpid());
  fs::create_directories(folder);
  fs::copy_file(path, folder / "ident.yaml", fs::copy_options::overwrite_existing);
  try {
    read_campaign(folder.string());
  } catch (...) {
    fs::remove_all(folder);
    throw;
  }
  fs::remove_all(folder);
  return {};
}

Seen read_as(const std::string& kind, const fs::path& path) {
  if (kind == "thrust") return from_table(read_table(path, thrust_schema()));
  if (kind == "motor") return from_table(read_table(path, motor_schema()));
  if (kind == "pendulum") return from_table(read_table(path, pendulum_schema()));
  if (kind == "flight") return from_log(read_flight_log(path, four_rotors(), {}));
  if (kind == "vehicle") return {.warnings = read_vehicle(path).warnings};
  if (kind == "map") return read_log_map(path), Seen{};
  if (kind == "map_on_flight")
    return from_log(read_flight_log(kFolder / "good_flight.csv", four_rotors(), read_log_map(path)));
  if (kind == "campaign") return read_as_campaign(path);
  throw std::logic_error("unknown kind " + kind);
}

Seen look(const std::string& kind, const fs::path& path) {
  try {
    return read_as(kind, path);
  } catch (const Error& error) {
    return {.error = error.what(), .exit = static_cast<int>(error.status())};
  }
}

std::multimap<std::string, std::string> read_expectation(const fs::path& path) {
  std::multimap<std::string, std::string> entries;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) throw std::logic_error("not 'key: value': " + line);
    entries.emplace(line.substr(0, colon), line.substr(colon + 2));
  }
  return entries;
}

/// Message without the folders of this machine.
std::string placed(std::string message, const fs::path& path) {
  const std::string campaign =
      (fs::temp_directory_path() / fmt::format("ident-campaign-{}", ::getpid())).string();
  for (const auto& [from, to] : {std::pair(path.string(), std::string("{file}")),
                                 {kFolder.string() + "/", ""},
                                 {campaign + "/ident.yaml", "{file}"},
                                 {campaign + "/", ""}})
    for (std::size_t at = 0; (at = message.find(from, at)) != std::string::npos; at += to.size())
      message.replace(at, from.size(), to);
  return message;
}

void expect_value(const Seen& seen, const std::string& text) {
  std::istringstream words(text);
  std::string name, number;
  std::size_t row = 0;
  words >> name >> row >> number;
  ASSERT_TRUE(seen.signals.contains(name)) << name;
  const std::vector<double>& values = seen.signals.at(name);
  ASSERT_LE(row, values.size()) << text;
  const double expected = number == "nan" ? kNaN : std::stod(number);
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(values[row - 1])) << text << ", got " << values[row - 1];
  } else {
    EXPECT_NEAR(values[row - 1], expected, 1e-4 * std::abs(expected)) << text;
  }
}

bool has_warning(const Seen& seen, const std::string& code) {
  return std::ranges::any_of(seen.warnings, [&](const Warning& w) { return w.code == code; });
}

bool has_notice(const Seen& seen, const std::string& part) {
  return std::ranges::any_of(seen.notices, [&](const std::string& n) { return n.find(part) != n.npos; });
}

class MalformedInput : public testing::TestWithParam<std::string> {};

TEST_P(MalformedInput, GivesItsMessageOrTheRightNumber) {
  const fs::path path = kFolder / GetParam();
  const auto expected = read_expectation(path.string() + ".expect");
  const Seen seen = look(expected.find("kind")->second, path);
  const std::string got = placed(seen.error.value_or("no error"), path);
  if (const auto error = expected.find("error"); error != expected.end()) {
    EXPECT_EQ(got, error->second);
    const auto status = expected.find("exit");
    EXPECT_EQ(seen.exit, status == expected.end() ? 2 : std::stoi(status->second));
    return;
  }
  ASSERT_FALSE(seen.error) << got;
  for (const auto& [key, text] : expected) {
    if (key == "value") expect_value(seen, text);
    if (key == "rows") {
      EXPECT_EQ(seen.rows, std::stoul(text));
    } else if (key == "warning") {
      EXPECT_TRUE(has_warning(seen, text)) << text;
    } else if (key == "notice") {
      EXPECT_TRUE(has_notice(seen, text)) << text;
    }
  }
  if (!expected.contains("warning")) {
    EXPECT_TRUE(seen.warnings.empty()) << seen.warnings.front().message;
  }
}

std::vector<std::string> file_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".expect") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param.substr(0, info.param.rfind('.'));
  std::ranges::replace(name, '.', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(File, MalformedInput, testing::ValuesIn(file_names()), test_name);

TEST(MalformedInputs, AreAtLeastSixty) { EXPECT_GE(file_names().size(), 60u); }

}  // namespace
}  // namespace ident
