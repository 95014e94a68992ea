// One map for all logs of a command, or one for each.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ident/result/result.h"
#include "support/run_program.h"

namespace ident {
namespace {

const std::string kSample = std::string(IDENT_SOURCE_DIR) + "/data/sample";
const std::vector<std::string> kLogs = {kSample + "/flight_eight.csv", kSample + "/flight_mixed.csv"};

ProgramRun flightlog(const std::vector<std::string>& logs, const std::vector<std::string>& maps,
                     const std::string& folder) {
  std::vector<std::string> arguments = {"flightlog", "--json", "--vehicle", kSample + "/falcon.yaml"};
  for (const std::string& map : maps) arguments.insert(arguments.end(), {"--map", map});
  arguments.insert(arguments.end(), logs.begin(), logs.end());
  return run_ident(arguments, folder);
}

/// Simulated windows, of 1 s each.
int windows_in(const ProgramRun& run) {
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out)["fit"]["windows"].get<int>();
}

TEST(Maps, EachLogHasItsOwnOrAllHaveTheSame) {
  const std::string folder = test_folder();
  const std::string early = write_text(folder, "early.yaml", "windows: [[2, 12]]\n"),
                    late = write_text(folder, "late.yaml", "windows: [[10, 14]]\n");
  const int ten = windows_in(flightlog({kLogs[0]}, {early}, folder)),
            four = windows_in(flightlog({kLogs[1]}, {late}, folder));
  EXPECT_GT(ten, four + 3);
  EXPECT_EQ(windows_in(flightlog(kLogs, {early, late}, folder)), ten + four);
  EXPECT_EQ(windows_in(flightlog(kLogs, {early}, folder)), 2 * ten);
}

TEST(Maps, OfAnotherNumberThanLogsAreRefused) {
  const std::string folder = test_folder();
  const std::string map = write_text(folder, "map.yaml", "windows: [[2, 12]]\n");
  const ProgramRun three = flightlog(kLogs, {map, map, map}, folder);
  EXPECT_EQ(three.status, 2);
  EXPECT_NE(three.err.find("--map is given 3 times for 2 logs"), std::string::npos) << three.err;
  const ProgramRun none = flightlog({}, {map}, folder);
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("--map is for the logs that stand beside it"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace ident
